#include "scene/volume/grid.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace mlt {
namespace {

/// 0 for what a float hardly holds: rounding, which may lie below zero.
float without_subnormal(float value) { return std::fpclassify(value) == FP_SUBNORMAL ? 0 : value; }

}  // namespace

void check_grid_size(const std::array<int64_t, 3>& size, int64_t channels,
                     const std::string& name) {
  constexpr int64_t most = int64_t{1} << 31;
  bool ok = channels == 1 || channels == 3;
  int64_t values = channels;
  for (const int64_t n : size) {
    ok = ok && 0 < n && n <= most / values;
    if (ok) values *= n;
  }
  if (!ok || values >= most)
    throw UsageError(fmt::format(
        "{}: a grid cannot have {} x {} x {} values with {} channels; there should be at least one "
        "value and fewer than 2^31 numbers, with 1 or 3 channels",
        name, size[0], size[1], size[2], channels));
}

Grid::Grid(const GridData& data, bool nearest, const std::string& name)
    : size_(data.size), channels_(data.channels), nearest_(nearest) {
  check(data, name);
  store(data);
  find_empty_bricks(data);
}

void Grid::check(const GridData& data, const std::string& name) {
  const auto channels = static_cast<size_t>(channels_);
  for (size_t i = 0; i < data.values.size(); ++i) {
    const float value = without_subnormal(data.values[i]);
    if (!(value >= 0 && std::isfinite(value))) {
      const size_t at = i / channels, width = size_[0], height = size_[1];
      throw UsageError(fmt::format(
          "{}: the value at x = {}, y = {}, z = {} is {}, but must be finite and not negative",
          name, at % width, at / width % height, at / width / height, value));
    }
    double& most = maximum_[static_cast<int>(i % channels)];
    most = std::max(most, double{value});
  }
  if (channels_ == 1) maximum_ = Color(maximum_.x);
}

void Grid::store(const GridData& data) {
  const auto inside = [&](int i, int axis) { return std::clamp(i - 1, 0, size_[axis] - 1); };
  values_.reserve(channels_ * place(0, 0, size_[2] + 2));
  for (int z = 0; z < size_[2] + 2; ++z)
    for (int y = 0; y < size_[1] + 2; ++y) {
      const size_t row = (size_t(inside(z, 2)) * size_[1] + inside(y, 1)) * size_[0];
      for (int x = 0; x < size_[0] + 2; ++x)
        for (int c = 0; c < channels_; ++c)
          values_.push_back(without_subnormal(data.values[channels_ * (row + inside(x, 0)) + c]));
    }
  along_edge_ = nearest_ ? 0 : 1;
  for (int i = 0; i < 4; ++i) to_edge_[i] = nearest_ ? place(1, 1, 1) : place(0, i >> 1, i & 1);
}

void Grid::find_empty_bricks(const GridData& data) {
  for (int axis = 0; axis < 3; ++axis) bricks_[axis] = (cells(axis) + brick - 1) / brick;
  empty_.assign(size_t(bricks_[0]) * bricks_[1] * bricks_[2], 1);
  // Along each axis, value i is at a corner of the cells i and i + 1, or of cell i alone where
  // cells are constant.
  const int further = nearest_ ? 0 : 1;
  const float* value = data.values.data();
  for (int z = 0; z < size_[2]; ++z)
    for (int y = 0; y < size_[1]; ++y)
      for (int x = 0; x < size_[0]; ++x, value += channels_) {
        if (std::all_of(value, value + channels_,
                        [](float v) { return without_subnormal(v) == 0; }))
          continue;
        for (int k = z / brick; k <= (z + further) / brick; ++k)
          for (int j = y / brick; j <= (y + further) / brick; ++j)
            for (int i = x / brick; i <= (x + further) / brick; ++i)
              empty_[brick_place(i, j, k)] = 0;
      }
}

}  // namespace mlt
