#include "image/sample_film.h"

#include <algorithm>

namespace mlt {
namespace {

/// Padding behind the pixels of a tile, since whole vectors are added.
constexpr size_t spare_values = 8;

float* pixel(std::vector<float>& image, const PixelRect& reach, int x, int y) {
  return &image[3 * (size_t(y - reach.y0) * reach.width() + (x - reach.x0))];
}

}  // namespace

SampleFilm::SampleFilm(int width, int height, std::shared_ptr<const Filter> filter, int groups,
                       bool splats, bool around)
    : width_(width),
      height_(height),
      reach_(filter_border(*filter)),
      border_(around ? reach_ : 0),
      splats_(splats),
      filter_(std::move(filter)),
      edge_scale_(around ? EdgeScale() : EdgeScale(*filter_, width, height)),
      rows_(*filter_) {
  tiles_x_ = (width + 2 * border_ + tile_size - 1) / tile_size;
  tiles_y_ = (height + 2 * border_ + tile_size - 1) / tile_size;
  cell_weight_ = cell_weights(*filter_);
  std::vector<Strand> strands(splats ? 1 : tile_count());
  for (size_t i = 0; i < strands.size(); ++i) {
    strands[i].reach =
        splats ? PixelRect{0, 0, width, height} : reach_of(cells_of(static_cast<int>(i)));
    strands[i].samples.resize(splats ? tile_count() : 1);
    strands[i].sums.resize(strands[i].samples.size());
  }
  for (int g = 0; g < groups; ++g) {
    groups_.push_back(std::make_unique<Group>());
    groups_.back()->strands = strands;
  }
}

SampleFilm::Tile::Tile(const PixelRect& cells, const PixelRect& reach, const Filter& filter,
                       const FilterRows<float>& rows)
    : cells_(cells),
      reach_(reach),
      filter_(&filter),
      rows_(&rows),
      rgb_(size_t{3} * reach.width() * reach.height() + spare_values) {}

void SampleFilm::Tile::add(const Vec2& raster, const Color& color) {
  if (rows_->pixels() > 0 && add_whole(raster, color)) return;
  mlt::splat(*filter_, raster, color, reach_,
             [&](int x, int y, int count, const double* values, double weight) {
               float* to = pixel(rgb_, reach_, x, y);
               const int padded = whole_vectors(count);
               for (int i = 0; i < padded; ++i) to[i] += static_cast<float>(values[i] * weight);
             });
}

/// Adds in single precision, as the sums are. False, and nothing added, if the filter covers pixels
/// outside the tile.
bool SampleFilm::Tile::add_whole(const Vec2& raster, const Color& color) {
  const int n = rows_->pixels();
  const FilterRows<float>::Weights across = rows_->weights(raster.x),
                                   down = rows_->weights(raster.y);
  const int x = across.first, y = down.first;
  if (x < reach_.x0 || y < reach_.y0 || x + n > reach_.x1 || y + n > reach_.y1) return false;
  float row[3 * FilterRows<float>::most_pixels];
  const Vec3f value(color);
  for (int i = 0; i < FilterRows<float>::most_pixels; ++i)
    for (int c = 0; c < 3; ++c) row[3 * i + c] = value[c] * across.at[i];
  float* to = pixel(rgb_, reach_, x, y);
  const int vectors = whole_vectors(3 * n) / 8;
  for (int j = 0; j < n; ++j, to += 3 * reach_.width())
    for (int v = 0; v < vectors; ++v)
      for (int i = 0; i < 8; ++i) to[8 * v + i] += row[8 * v + i] * down.at[j];
  return true;
}

PixelRect SampleFilm::cells_of(int tile) const {
  const int x0 = (tile % tiles_x_) * tile_size - border_,
            y0 = (tile / tiles_x_) * tile_size - border_;
  return {x0, y0, std::min(x0 + tile_size, width_ + border_),
          std::min(y0 + tile_size, height_ + border_)};
}

PixelRect SampleFilm::reach_of(const PixelRect& cells) const {
  return {std::max(0, cells.x0 - reach_), std::max(0, cells.y0 - reach_),
          std::min(width_, cells.x1 + reach_), std::min(height_, cells.y1 + reach_)};
}

size_t SampleFilm::bytes_per_group() const {
  size_t samples = 0;
  for (const Strand& strand : groups_.front()->strands) samples += strand.size();
  return samples * sizeof(float) * (splats_ ? 2 : 1);
}

SampleFilm::Tile SampleFilm::begin(int tile) const {
  const PixelRect cells = cells_of(tile);
  return Tile(cells, reach_of(cells), *filter_, rows_);
}

void SampleFilm::commit(int group_index, uint64_t order, int tile, Tile&& data, int samples) {
  Group& group = *groups_[group_index];
  const std::lock_guard lock(group.mutex);
  Strand& strand = group.strands[splats_ ? 0 : tile];
  strand.pending.emplace(order / group.strands.size(), Pending{tile, samples, std::move(data)});
  for (auto it = strand.pending.find(strand.next); it != strand.pending.end();
       it = strand.pending.find(strand.next)) {
    add(strand, it->second);
    strand.pending.erase(it);
    ++strand.next;
  }
}

bool SampleFilm::has(int group_index, uint64_t order, int tile) const {
  const Group& group = *groups_[group_index];
  const std::lock_guard lock(group.mutex);
  return order / group.strands.size() < group.strands[splats_ ? 0 : tile].next;
}

void SampleFilm::add(Strand& strand, const Pending& pending) {
  const PixelRect &reach = pending.data.reach_, &all = strand.reach;
  const size_t row = size_t{3} * reach.width();
  strand.rgb.resize(strand.size());
  for (int y = reach.y0; y < reach.y1; ++y) {
    const float* from = &pending.data.rgb_[(y - reach.y0) * row];
    float* to = pixel(strand.rgb, all, reach.x0, y);
    for (size_t i = 0; i < row; ++i) to[i] += from[i];
  }
  strand.samples[splats_ ? pending.tile : 0] += pending.samples;
  strand.sums[splats_ ? pending.tile : 0] += pending.data.sums_;
  if (pending.data.splats_.empty()) return;
  strand.light.resize(strand.size());
  for (const Splat& one : pending.data.splats_)
    splat(*filter_, one.raster, one.color, all,
          [&](int x, int y, int count, const double* values, double weight) {
            float* to = pixel(strand.light, all, x, y);
            for (int i = 0; i < count; ++i) to[i] += static_cast<float>(values[i] * weight);
          });
}

void SampleFilm::add_samples(const Group& group, std::vector<uint64_t>& samples) const {
  for (size_t t = 0; t < samples.size(); ++t)
    samples[t] += splats_ ? group.strands[0].samples[t] : group.strands[t].samples[0];
}

std::vector<SampleSums> SampleFilm::sums() const {
  std::vector<SampleSums> sums(tile_count());
  for (const auto& group : groups_) {
    const std::lock_guard lock(group->mutex);
    for (size_t t = 0; t < sums.size(); ++t)
      sums[t] += splats_ ? group->strands[0].sums[t] : group->strands[t].sums[0];
  }
  return sums;
}

std::vector<double> SampleFilm::tile_sizes() const {
  std::vector<double> sizes;
  for (int tile = 0; tile < tile_count(); ++tile) {
    const PixelRect cells = cells_of(tile);
    sizes.push_back(static_cast<double>(cells.width()) * cells.height());
  }
  return sizes;
}

Image SampleFilm::image() const {
  std::vector<const Group*> all;
  for (const auto& group : groups_) all.push_back(group.get());
  return develop(all);
}

Image SampleFilm::group_image(int group) const { return develop({groups_[group].get()}); }

uint64_t SampleFilm::passes(int group) const {
  const std::lock_guard lock(groups_[group]->mutex);
  std::vector<uint64_t> samples(tile_count());
  add_samples(*groups_[group], samples);
  return *std::min_element(samples.begin(), samples.end());
}

/// The expected sum of the filter weights of all samples in each pixel.
std::vector<double> SampleFilm::expected_weights(const std::vector<uint64_t>& samples) const {
  std::vector<double> weights(size_t(width_) * height_);
  const auto expected = [&](int pixel, int begin, int end) {
    return expected_weight(cell_weight_, pixel, begin, end);
  };
  for (int tile = 0; tile < tile_count(); ++tile) {
    if (samples[tile] == 0) continue;
    const PixelRect cells = cells_of(tile), reach = reach_of(cells);
    std::vector<double> wx;
    for (int x = reach.x0; x < reach.x1; ++x) wx.push_back(expected(x, cells.x0, cells.x1));
    for (int y = reach.y0; y < reach.y1; ++y) {
      const double wy = samples[tile] * expected(y, cells.y0, cells.y1);
      for (int x = reach.x0; x < reach.x1; ++x)
        weights[size_t(y) * width_ + x] += wy * wx[x - reach.x0];
    }
  }
  return weights;
}

/// Pixels per walk, since importance integrates to 1 over the image.
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
    add_samples(*group, samples);
  }
  return splat_scale(samples);
}

Image SampleFilm::develop(const std::vector<const Group*>& groups) const {
  std::vector<double> rgb(size_t{3} * width_ * height_), light;
  std::vector<uint64_t> samples(tile_count());
  for (const Group* group : groups) {
    const std::lock_guard lock(group->mutex);
    for (const Strand& strand : group->strands) {
      const PixelRect& reach = strand.reach;
      const size_t row = size_t{3} * reach.width();
      for (int y = reach.y0; !strand.rgb.empty() && y < reach.y1; ++y) {
        const float* from = &strand.rgb[(y - reach.y0) * row];
        double* to = &rgb[3 * (size_t(y) * width_ + reach.x0)];
        for (size_t i = 0; i < row; ++i) to[i] += from[i];
      }
      light.resize(std::max(light.size(), strand.light.size()));
      for (size_t i = 0; i < strand.light.size(); ++i) light[i] += strand.light[i];
    }
    add_samples(*group, samples);
  }
  const std::vector<double> weights = expected_weights(samples);
  const double light_scale = splat_scale(samples);
  Image image(width_, height_, 3);
  for (size_t i = 0; i < rgb.size(); ++i) {
    double value = weights[i / 3] > 0 ? rgb[i] / weights[i / 3] : 0.0;
    if (!light.empty()) value += light_scale * edge_scale_.at(i / 3) * light[i];
    image.data[i] = static_cast<float>(value);
  }
  return image;
}

}  // namespace mlt
