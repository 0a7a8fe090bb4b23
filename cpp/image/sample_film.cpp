#include "image/sample_film.h"

#include "base/bytes.h"

namespace mlt {
namespace {

/// Integral of f over the cell at distance d from the pixel, for d = 0 ... border.
std::vector<double> cell_weights(const Filter& filter, int border) {
  std::vector<double> weights;
  if (filter.is_box()) return {1};
  constexpr int steps = 4096;
  for (int d = 0; d <= border; ++d) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) sum += filter.eval(d - 0.5 + (i + 0.5) / steps);
    weights.push_back(sum / steps);
  }
  return weights;
}

}  // namespace

SampleFilm::SampleFilm(int width, int height, std::shared_ptr<const Filter> filter, int groups)
    : width_(width), height_(height), border_(filter_border(*filter)), filter_(std::move(filter)) {
  tiles_x_ = (width + 2 * border_ + tile_size - 1) / tile_size;
  tiles_y_ = (height + 2 * border_ + tile_size - 1) / tile_size;
  cell_weight_ = cell_weights(*filter_, border_);
  for (int g = 0; g < groups; ++g) {
    groups_.push_back(std::make_unique<Group>());
    groups_.back()->rgb.resize(size_t{3} * width * height);
    groups_.back()->samples.resize(tile_count());
  }
}

SampleFilm::Tile::Tile(const PixelRect& cells, const PixelRect& reach, const Filter& filter)
    : cells_(cells), reach_(reach), filter_(&filter), rgb_(size_t{3} * reach.width() * reach.height()) {}

void SampleFilm::Tile::add(const Vec2& raster, const Color& color) {
  mlt::splat(*filter_, raster, reach_, [&](int x, int y, double weight) {
    float* pixel = &rgb_[3 * (size_t(y - reach_.y0) * reach_.width() + (x - reach_.x0))];
    for (int c = 0; c < 3; ++c) pixel[c] += static_cast<float>(color[c] * weight);
  });
}

PixelRect SampleFilm::cells_of(int tile) const {
  const int x0 = (tile % tiles_x_) * tile_size - border_, y0 = (tile / tiles_x_) * tile_size - border_;
  return {x0, y0, std::min(x0 + tile_size, width_ + border_), std::min(y0 + tile_size, height_ + border_)};
}

PixelRect SampleFilm::reach_of(const PixelRect& cells) const {
  return {std::max(0, cells.x0 - border_), std::max(0, cells.y0 - border_),
          std::min(width_, cells.x1 + border_), std::min(height_, cells.y1 + border_)};
}

SampleFilm::Tile SampleFilm::begin(int tile) const {
  const PixelRect cells = cells_of(tile);
  return Tile(cells, reach_of(cells), *filter_);
}

void SampleFilm::commit(int group_index, uint64_t order, int tile, Tile&& data, int samples) {
  Group& group = *groups_[group_index];
  const std::lock_guard lock(group.mutex);
  group.pending.emplace(order, Pending{tile, samples, std::move(data)});
  for (auto it = group.pending.find(group.next); it != group.pending.end();
       it = group.pending.find(group.next)) {
    add(group, it->second);
    group.pending.erase(it);
    ++group.next;
  }
}

void SampleFilm::add(Group& group, const Pending& pending) {
  const PixelRect& reach = pending.data.reach_;
  const size_t row = size_t{3} * reach.width();
  for (int y = reach.y0; y < reach.y1; ++y) {
    const float* from = &pending.data.rgb_[(y - reach.y0) * row];
    float* to = &group.rgb[3 * (size_t(y) * width_ + reach.x0)];
    for (size_t i = 0; i < row; ++i) to[i] += from[i];
  }
  group.samples[pending.tile] += pending.samples;
  if (pending.data.splats_.empty()) return;
  group.light.resize(group.rgb.size());
  for (const Splat& one : pending.data.splats_)
    splat(*filter_, one.raster, {0, 0, width_, height_}, [&](int x, int y, double weight) {
      float* pixel = &group.light[3 * (size_t(y) * width_ + x)];
      for (int c = 0; c < 3; ++c) pixel[c] += static_cast<float>(one.color[c] * weight);
    });
}

Image SampleFilm::image() const {
  std::vector<const Group*> all;
  for (const auto& group : groups_) all.push_back(group.get());
  return develop(all);
}

Image SampleFilm::group_image(int group) const { return develop({groups_[group].get()}); }

uint64_t SampleFilm::passes(int group) const {
  const std::lock_guard lock(groups_[group]->mutex);
  const std::vector<uint64_t>& samples = groups_[group]->samples;
  return *std::min_element(samples.begin(), samples.end());
}

/// The weight that uniform samples of the cells are expected to have in each pixel.
std::vector<double> SampleFilm::expected_weights(const std::vector<uint64_t>& samples) const {
  std::vector<double> weights(size_t(width_) * height_);
  const auto expected = [&](int pixel, int begin, int end) {
    double sum = 0;
    for (int cell = std::max(begin, pixel - border_); cell < std::min(end, pixel + border_ + 1); ++cell)
      sum += cell_weight_[std::abs(cell - pixel)];
    return sum;
  };
  for (int tile = 0; tile < tile_count(); ++tile) {
    if (samples[tile] == 0) continue;
    const PixelRect cells = cells_of(tile), reach = reach_of(cells);
    std::vector<double> wx;
    for (int x = reach.x0; x < reach.x1; ++x) wx.push_back(expected(x, cells.x0, cells.x1));
    for (int y = reach.y0; y < reach.y1; ++y) {
      const double wy = samples[tile] * expected(y, cells.y0, cells.y1);
      for (int x = reach.x0; x < reach.x1; ++x) weights[size_t(y) * width_ + x] += wy * wx[x - reach.x0];
    }
  }
  return weights;
}

/// Importance integrates to 1 over the image, so a pixel is the pixel count times the mean.
double SampleFilm::splat_scale(const std::vector<uint64_t>& samples) const {
  double walks = 0;
  for (int tile = 0; tile < tile_count(); ++tile) {
    const PixelRect cells = cells_of(tile);
    walks += static_cast<double>(samples[tile]) * cells.width() * cells.height();
  }
  return walks > 0 ? static_cast<double>(width_) * height_ / walks : 0.0;
}

double SampleFilm::splat_scale() const {
  std::vector<uint64_t> samples(tile_count());
  for (const auto& group : groups_) {
    const std::lock_guard lock(group->mutex);
    for (size_t t = 0; t < samples.size(); ++t) samples[t] += group->samples[t];
  }
  return splat_scale(samples);
}

Image SampleFilm::develop(const std::vector<const Group*>& groups) const {
  std::vector<double> rgb(size_t{3} * width_ * height_), light;
  std::vector<uint64_t> samples(tile_count());
  for (const Group* group : groups) {
    const std::lock_guard lock(group->mutex);
    for (size_t i = 0; i < rgb.size(); ++i) rgb[i] += group->rgb[i];
    for (size_t t = 0; t < samples.size(); ++t) samples[t] += group->samples[t];
    light.resize(std::max(light.size(), group->light.size()));
    for (size_t i = 0; i < group->light.size(); ++i) light[i] += group->light[i];
  }
  const std::vector<double> weights = expected_weights(samples);
  const double light_scale = splat_scale(samples);
  Image image(width_, height_, 3);
  for (size_t i = 0; i < rgb.size(); ++i) {
    double value = weights[i / 3] > 0 ? rgb[i] / weights[i / 3] : 0.0;
    if (!light.empty()) value += light_scale * light[i];
    image.data[i] = static_cast<float>(value);
  }
  return image;
}

std::string SampleFilm::save() const {
  ByteWriter bytes;
  for (const auto& group : groups_) {
    const std::lock_guard lock(group->mutex);
    if (!group->pending.empty()) throw RenderError("a film cannot be saved while units are running");
    bytes.write(group->next);
    bytes.write(group->rgb);
    bytes.write(group->light);
    bytes.write(group->samples);
  }
  return bytes.take();
}

void SampleFilm::load(const std::string& saved) {
  ByteReader bytes(saved);
  std::vector<std::unique_ptr<Group>> groups;
  for (const auto& old : groups_) {
    groups.push_back(std::make_unique<Group>());
    Group& group = *groups.back();
    group.next = bytes.read<uint64_t>();
    bytes.read(group.rgb);
    bytes.read(group.light);
    bytes.read(group.samples);
    const bool light_fits = group.light.empty() || group.light.size() == old->rgb.size();
    if (group.rgb.size() != old->rgb.size() || !light_fits || group.samples.size() != old->samples.size())
      throw RenderError("the saved film has another size");
  }
  bytes.finish();
  groups_ = std::move(groups);
}

}  // namespace mlt
