#include "image/splat_film.h"

#include "base/bytes.h"

#include <cstring>
#include <new>
#include <thread>

namespace mlt {
namespace {

constexpr double one = 0x1p28;                 ///< Steps of fixed point in 1.
constexpr int64_t largest = int64_t{1} << 62;  ///< Largest sum, or splat.
constexpr double largest_exact = 0x1p51;       ///< Largest number for round_small.
constexpr int run_values = 3 * run_pixels;

/// `weight` times `values`, to the nearest integers. Between 2^52 and 2^53 the last bit of a double
/// counts ones, so the sum with 1.5 * 2^52 has them in its low bits; compilers can do this for
/// several numbers at a time.
void round_small(const double* values, double weight, int count, int64_t* rounded) {
  constexpr double shift = 0x1.8p52;
  double shifted[run_values];
  for (int i = 0; i < count; ++i) shifted[i] = values[i] * weight + shift;
  int64_t base;
  std::memcpy(&base, &shift, sizeof(base));
  for (int i = 0; i < count; ++i) {
    std::memcpy(&rounded[i], &shifted[i], sizeof(base));
    rounded[i] -= base;
  }
}

/// `weight` times `values` of any size, rounded; returns how many are too large, or NaN.
int round_large(const double* values, double weight, int count, int64_t* rounded) {
  int refused = 0;
  for (int i = 0; i < count; ++i) {
    const double step = values[i] * weight;
    const bool fits = std::abs(step) < static_cast<double>(largest);
    rounded[i] = fits ? std::llrint(step) : 0;
    refused += !fits;
  }
  return refused;
}

/// Adds steps to sums; returns how many sums were out of range before.
int add_steps(const int64_t* steps, int count, int64_t* sums) {
  int64_t full = 0;
  for (int i = 0; i < count; ++i) {
    full += sums[i] > largest || sums[i] < -largest;
    sums[i] =
        static_cast<int64_t>(static_cast<uint64_t>(sums[i]) + static_cast<uint64_t>(steps[i]));
  }
  return static_cast<int>(full);
}

/// Adds `weight` times `values`, which are small, four at a time.
int add_small(const double* __restrict values, double weight, int count, int64_t* __restrict sums) {
  constexpr int vector = 4;
  uint64_t full[vector] = {};
  int i = 0;
  for (; i + vector <= count; i += vector) {
    int64_t steps[vector];
    round_small(values + i, weight, vector, steps);
    for (int j = 0; j < vector; ++j) {
      const auto sum = static_cast<uint64_t>(sums[i + j]);
      full[j] += (sum ^ (sum << 1)) >> 63;  // The highest two bits differ where |sum| >= 2^62.
      sums[i + j] = static_cast<int64_t>(sum + static_cast<uint64_t>(steps[j]));
    }
  }
  int64_t steps[vector];
  round_small(values + i, weight, count - i, steps);
  return static_cast<int>(full[0] + full[1] + full[2] + full[3]) +
         add_steps(steps, count - i, sums + i);
}

}  // namespace

SplatFilm::SplatFilm(int width, int height, std::shared_ptr<const Filter> filter, int groups,
                     bool around)
    : width_(width),
      height_(height),
      groups_(groups),
      filter_(std::move(filter)),
      rows_(*filter_),
      edge_scale_(around ? EdgeScale() : EdgeScale(*filter_, width, height)),
      cells_(static_cast<int64_t*>(std::calloc(group_size() * groups + 1, sizeof(int64_t)))),
      locks_(new Lock[groups * bands()]()) {
  if (!cells_) throw std::bad_alloc();
}

template <class Use>
void SplatFilm::with_band(int group, int y, Use&& use) const {
  Lock& lock = locks_[group * bands() + y / band_rows];
  while (lock.exchange(true, std::memory_order_acquire)) std::this_thread::yield();
  use();
  lock.store(false, std::memory_order_release);
}

void SplatFilm::add(int group, const Vec2& raster, const Color& color) {
  const Color steps_in_color = color * one;
  const double filter = std::max(1.0, sqr(filter_->largest()));  // The box filter's weight is 1.
  const Color size = glm::abs(steps_in_color) * filter;
  const bool small = size.x < largest_exact && size.y < largest_exact && size.z < largest_exact;
  if (small && add_whole(group, raster, steps_in_color)) return;
  const auto add = [&](int x, int y, int count, const double* values, double weight) {
    int64_t steps[run_values];
    int refused = 0, full = 0;
    if (small)
      round_small(values, weight, whole_vectors(count), steps);
    else
      refused = round_large(values, weight, count, steps);
    with_band(group, y, [&] { full = add_steps(steps, count, row(group, y) + 3 * x); });
    if (refused + full > 0) saturated_ += refused + full;
  };
  splat(*filter_, raster, steps_in_color, {0, 0, width_, height_}, add);
}

bool SplatFilm::add_whole(int group, const Vec2& raster, const Color& steps) {
  const int pixels = rows_.pixels(), count = 3 * pixels;
  if (pixels == 0) return false;
  const auto across = rows_.weights(raster.x), down = rows_.weights(raster.y);
  const int x = across.first, y = down.first;
  if (x < 0 || y < 0 || x + pixels > width_ || y + pixels > height_) return false;
  double values[3 * FilterRows<double>::most_pixels];
  for (int i = 0; i < FilterRows<double>::most_pixels; ++i)
    for (int c = 0; c < 3; ++c) values[3 * i + c] = steps[c] * across.at[i];
  int full = 0;
  for (int i = 0; i < pixels;) {
    const int end = std::min(pixels, i + band_rows - (y + i) % band_rows);
    with_band(group, y + i, [&] {
      for (; i < end; ++i) full += add_small(values, down.at[i], count, row(group, y + i) + 3 * x);
    });
  }
  if (full > 0) saturated_ += full;
  return true;
}

Image SplatFilm::image(const std::vector<double>& scale) const {
  const size_t values = size_t{3} * width_;
  std::vector<double> sum(group_size());
  for (int g = 0; g < groups_; ++g)
    for (int y = 0; scale[g] != 0 && y < height_; ++y)
      with_band(g, y, [&] {
        const int64_t* cells = row(g, y);
        for (size_t i = 0; i < values; ++i)
          sum[y * values + i] += scale[g] / one * static_cast<double>(cells[i]);
      });
  Image image(width_, height_, 3);
  for (size_t i = 0; i < sum.size(); ++i)
    image.data[i] = static_cast<float>(sum[i] * edge_scale_.at(i / 3));
  return image;
}

std::string SplatFilm::save(int first, int last) const {
  const int values = 3 * width_;
  std::vector<int64_t> sums;
  sums.reserve(group_size() * (last - first));
  for (int g = first; g < last; ++g)
    for (int y = 0; y < height_; ++y)
      with_band(g, y, [&] { sums.insert(sums.end(), row(g, y), row(g, y) + values); });
  ByteWriter bytes;
  bytes.write(sums);
  bytes.write(saturated_.load());
  return bytes.take();
}

void SplatFilm::merge(int first, int last, const std::string& saved) {
  std::vector<int64_t> sums;
  ByteReader bytes(saved);
  bytes.read(sums);
  const auto saturated = bytes.read<uint64_t>();
  bytes.finish();
  if (sums.size() != group_size() * (last - first))
    throw RenderError("the saved film has another size");
  const int values = 3 * width_;
  const int64_t* from = sums.data();
  for (int g = first; g < last; ++g)
    for (int y = 0; y < height_; ++y, from += values)
      if (std::any_of(from, from + values, [](int64_t step) { return step != 0; }))
        with_band(g, y, [&] { saturated_ += add_steps(from, values, row(g, y)); });
  saturated_ += saturated;
}

}  // namespace mlt
