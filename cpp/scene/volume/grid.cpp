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
  join_empty_cubes();
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
  empty_edges_.assign(size_t(bricks_[0]) * bricks_[1] * bricks_[2], brick);
  const float* value = data.values.data();
  for (int z = 0; z < size_[2]; ++z)
    for (int y = 0; y < size_[1]; ++y)
      for (int x = 0; x < size_[0]; ++x, value += channels_)
        if (!std::all_of(value, value + channels_,
                         [](float v) { return without_subnormal(v) == 0; }))
          fill_around({x, y, z});
  if (filled_low_.x > filled_high_.x) filled_low_ = filled_high_ = Vec3(0);
}

/// Notes that the cells around a value are not empty.
void Grid::fill_around(const Index& value) {
  // Along each axis, value i is at a corner of the cells i and i + 1, or of cell i alone where
  // cells are constant.
  const int further = nearest_ ? 0 : 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double first = value[axis], end = first + further + 1;
    filled_low_[axis] = std::min(filled_low_[axis], std::max(first, low()));
    filled_high_[axis] = std::max(filled_high_[axis], std::min(end, high(axis)));
  }
  const auto& [x, y, z] = value;
  for (int k = z / brick; k <= (z + further) / brick; ++k)
    for (int j = y / brick; j <= (y + further) / brick; ++j)
      for (int i = x / brick; i <= (x + further) / brick; ++i)
        empty_edges_[brick_place(i, j, k)] = 0;
}

void Grid::join_empty_cubes() {
  for (int edge = 2 * brick; edge <= largest_cube; edge *= 2) {
    const int step = edge / brick;
    for (int z = 0; z < bricks_[2]; z += step)
      for (int y = 0; y < bricks_[1]; y += step)
        for (int x = 0; x < bricks_[0]; x += step) join_empty_cubes(edge, {x, y, z});
  }
}

/// Makes one cube of eight that are empty, which begin at a brick; outside of the grid all are.
void Grid::join_empty_cubes(int edge, const Index& first) {
  Index end;
  for (int axis = 0; axis < 3; ++axis)
    end[axis] = std::min(first[axis] + edge / brick, bricks_[axis]);
  const auto visit = [&](auto&& brick_at) {
    for (int z = first[2]; z < end[2]; ++z)
      for (int y = first[1]; y < end[1]; ++y)
        for (int x = first[0]; x < end[0]; ++x) brick_at(empty_edges_[brick_place(x, y, z)]);
  };
  bool empty = true;
  visit([&](uint8_t its_edge) { empty = empty && its_edge == edge / 2; });
  if (empty) visit([&](uint8_t& its_edge) { its_edge = static_cast<uint8_t>(edge); });
}

}  // namespace mlt
