// The pixels that a sample at a continuous raster position reaches, and their filter weights.
#pragma once

#include "base/whole_vectors.h"
#include "image/filter.h"
#include "math/color.h"
#include "math/vec.h"

#include <algorithm>
#include <cmath>

namespace mlt {

/// A half-open rectangle of pixels.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
};

/// The most pixels of a run.
inline constexpr int run_pixels = 16;

/// How far outside the image samples still reach a pixel, in whole pixels.
inline int filter_border(const Filter& filter) {
  return static_cast<int>(std::ceil(filter.radius() - 0.5));
}

/// Calls add(x, y, count, values, weight) for each run of pixels of `rect`, from (x, y) on, whose
/// filter covers the raster position `at`: color times filter is `weight` times `count` values,
/// three channels a pixel, with zeros up to whole_vectors(count).
template <class Add>
void splat(const Filter& filter, const Vec2& at, const Color& color, const PixelRect& rect,
           Add&& add) {
  if (filter.is_box()) {
    const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
    if (x >= rect.x0 && x < rect.x1 && y >= rect.y0 && y < rect.y1) {
      const double values[8] = {color.x, color.y, color.z};
      add(x, y, 3, values, 1.0);
    }
    return;
  }
  const double r = filter.radius();
  const int x0 = std::max(rect.x0, static_cast<int>(std::ceil(at.x - r - 0.5)));
  const int y0 = std::max(rect.y0, static_cast<int>(std::ceil(at.y - r - 0.5)));
  const int x1 = std::min(rect.x1 - 1, static_cast<int>(std::floor(at.x + r - 0.5)));
  const int y1 = std::min(rect.y1 - 1, static_cast<int>(std::floor(at.y + r - 0.5)));
  // All rows have the same weights of columns: they are computed once, for some columns at a
  // time.
  for (int first = x0; first <= x1; first += run_pixels) {
    const int pixels = std::min(run_pixels, x1 + 1 - first);
    const int count = 3 * pixels, padded = whole_vectors(count);
    double row[3 * run_pixels];
    for (int i = 0; i < pixels; ++i) {
      const double wx = filter.eval(first + i + 0.5 - at.x);
      for (int c = 0; c < 3; ++c) row[3 * i + c] = color[c] * wx;
    }
    for (int i = count; i < padded; ++i) row[i] = 0;
    for (int y = y0; y <= y1; ++y)
      if (const double wy = filter.eval(y + 0.5 - at.y); wy != 0) add(first, y, count, row, wy);
  }
}

}  // namespace mlt
