#include "mutation/target_map.h"

#include "base/error.h"

#include <algorithm>
#include <utility>

namespace mlt {
namespace {

/// The coarse image in blocks of one size.
struct Blocks {
  int columns, rows;
  std::vector<double> sums, squares, cells;  ///< Sums over samples, of squares; how many cells.
  std::vector<double> brightness = {};       ///< Brightness per cell.

  size_t index(int x, int y) const { return static_cast<size_t>(y) * columns + x; }
};

Blocks larger_blocks(const Blocks& small) {
  Blocks large{(small.columns + 1) / 2, (small.rows + 1) / 2, {}, {}, {}};
  for (auto* values : {&large.sums, &large.squares, &large.cells})
    values->resize(static_cast<size_t>(large.columns) * large.rows);
  for (int y = 0; y < small.rows; ++y)
    for (int x = 0; x < small.columns; ++x) {
      const size_t from = small.index(x, y), to = large.index(x / 2, y / 2);
      large.sums[to] += small.sums[from];
      large.squares[to] += small.squares[from];
      large.cells[to] += small.cells[from];
    }
  return large;
}

/// The brightness, interpolated between the middles of the blocks; x and y are in blocks.
double interpolated_brightness(const Blocks& blocks, double x, double y) {
  const double u = std::clamp(x - 0.5, 0.0, blocks.columns - 1.0),
               v = std::clamp(y - 0.5, 0.0, blocks.rows - 1.0);
  const int x0 = static_cast<int>(u), y0 = static_cast<int>(v),
            x1 = std::min(x0 + 1, blocks.columns - 1), y1 = std::min(y0 + 1, blocks.rows - 1);
  const auto along_row = [&](int row) {
    const double left = blocks.brightness[blocks.index(x0, row)],
                 right = blocks.brightness[blocks.index(x1, row)];
    return left + (u - x0) * (right - left);
  };
  return along_row(y0) + (v - y0) * (along_row(y1) - along_row(y0));
}

/// The effective number of samples in the block.
double effective_count(const Blocks& blocks, size_t i) {
  return blocks.squares[i] > 0 ? blocks.sums[i] * blocks.sums[i] / blocks.squares[i] : 0;
}

void find_brightness(Blocks& small, const Blocks& large) {
  constexpr double k = 4;
  small.brightness.resize(small.sums.size());
  for (int y = 0; y < small.rows; ++y)
    for (int x = 0; x < small.columns; ++x) {
      const size_t i = small.index(x, y), around = large.index(x / 2, y / 2);
      const double n = effective_count(large, around) * small.cells[i] / large.cells[around];
      small.brightness[i] = (n * small.sums[i] / small.cells[i] +
                             k * interpolated_brightness(large, (x + 0.5) / 2, (y + 0.5) / 2)) /
                            (n + k);
    }
}

/// 1 over the brightness of the cells in units of the mean, and the mean.
std::pair<std::vector<double>, double> inverse_brightness(Blocks cells) {
  constexpr double least_share = 0.05;  // of the mean: no region is preferred more than 20 times
  std::vector<Blocks> sizes{std::move(cells)};
  while (sizes.back().sums.size() > 1) sizes.push_back(larger_blocks(sizes.back()));
  Blocks& whole = sizes.back();
  const double mean = whole.sums[0] / whole.cells[0];
  whole.brightness = {mean};
  for (size_t i = sizes.size() - 1; i > 0; --i) find_brightness(sizes[i - 1], sizes[i]);
  std::vector<double> factors;
  for (const double brightness : sizes[0].brightness)
    factors.push_back(mean > 0 ? 1 / std::max(least_share, brightness / mean) : 1.0);
  return {std::move(factors), mean};
}

}  // namespace

TargetMap::TargetMap(const Raster& raster, int cell)
    : cells_(RasterCells::of(raster, cell)),
      factors_(2 * cells_.count()),
      squares_(2 * cells_.count()) {}

void TargetMap::add(const Vec2& raster, double brightness, double certainty) {
  const auto add_at = [&](size_t i) {
    factors_[i] += brightness;
    squares_[i] += brightness * brightness;
  };
  const size_t cell = cells_.at(raster);
  add_at(cell);
  if (!(certainty > 0)) add_at(cells_.count() + cell);
}

void TargetMap::add(const TargetMap& other) {
  for (size_t i = 0; i < factors_.size(); ++i) {
    factors_[i] += other.factors_[i];
    squares_[i] += other.squares_[i];
  }
}

/// The target has the same mean over the image, whether all light is divided by the brightness of
/// all or scattered light by its own.
void TargetMap::finish() {
  const auto half = [](const std::vector<double>& values, bool second) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    return second ? std::vector<double>(middle, values.end())
                  : std::vector<double>(values.begin(), middle);
  };
  const auto blocks = [&](bool scattered) {
    return Blocks{cells_.columns, cells_.rows, half(factors_, scattered), half(squares_, scattered),
                  std::vector<double>(cells_.count(), 1)};
  };
  const auto [of_all, mean] = inverse_brightness(blocks(false));
  const auto [of_scattered, scattered_mean] = inverse_brightness(blocks(true));
  for (size_t i = 0; i < cells_.count(); ++i) {
    factors_[i] = of_all[i];
    factors_[cells_.count() + i] =
        scattered_mean > 0 ? of_scattered[i] * (mean / scattered_mean) : of_all[i];
  }
  squares_.clear();
}

void TargetMap::set_factors(std::vector<double> factors) {
  if (factors.size() != factors_.size()) throw RenderError("the saved target map has another size");
  factors_ = std::move(factors);
}

}  // namespace mlt
