#include "image/splat_film.h"

#include "base/bytes.h"

namespace mlt {
namespace {
constexpr int64_t largest = int64_t{1} << 62;  // of a sum, or of one splat
}

SplatFilm::SplatFilm(int width, int height, std::shared_ptr<const Filter> filter, int groups)
    : width_(width),
      height_(height),
      groups_(groups),
      filter_(std::move(filter)),
      cells_(new Cell[size_t{3} * width * height * groups]()) {}

void SplatFilm::add(int group, const Vec2& raster, const Color& color) {
  Cell* cells = &cells_[size_t{3} * width_ * height_ * group];
  splat(*filter_, raster, {0, 0, width_, height_}, [&](int x, int y, double weight) {
    Cell* pixel = cells + 3 * (size_t(y) * width_ + x);
    for (int c = 0; c < 3; ++c) {
      const double value = color[c] * weight * one;
      if (!(std::abs(value) < largest)) {  // or not a number
        ++saturated_;
        continue;
      }
      const auto step = static_cast<int64_t>(std::llrint(value));
      const int64_t before = pixel[c].fetch_add(step, std::memory_order_relaxed);
      if (before > largest || before < -largest) ++saturated_;
    }
  });
}

Image SplatFilm::image(const std::vector<double>& scale) const {
  const size_t count = size_t{3} * width_ * height_;
  std::vector<double> sum(count);
  for (int g = 0; g < groups_; ++g)
    for (size_t i = 0; scale[g] != 0 && i < count; ++i)
      sum[i] += scale[g] / one * static_cast<double>(cells_[g * count + i].load(std::memory_order_relaxed));
  Image image(width_, height_, 3);
  for (size_t i = 0; i < count; ++i) image.data[i] = static_cast<float>(sum[i]);
  return image;
}

std::string SplatFilm::save() const {
  const size_t count = size_t{3} * width_ * height_ * groups_;
  std::vector<int64_t> sums(count);
  for (size_t i = 0; i < count; ++i) sums[i] = cells_[i].load(std::memory_order_relaxed);
  ByteWriter bytes;
  bytes.write(sums);
  bytes.write(saturated_.load());
  return bytes.take();
}

void SplatFilm::load(const std::string& saved) {
  const size_t count = size_t{3} * width_ * height_ * groups_;
  std::vector<int64_t> sums;
  ByteReader bytes(saved);
  bytes.read(sums);
  const auto saturated = bytes.read<uint64_t>();
  bytes.finish();
  if (sums.size() != count) throw RenderError("the saved film has another size");
  for (size_t i = 0; i < count; ++i) cells_[i].store(sums[i], std::memory_order_relaxed);
  saturated_ = saturated;
}

}  // namespace mlt
