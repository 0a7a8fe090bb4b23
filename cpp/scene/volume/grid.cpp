#include "scene/volume/grid.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace mlt {

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
    throw SceneError(fmt::format(
        "{}: a grid cannot have {} x {} x {} values with {} channels; there should be at least one "
        "value and fewer than 2^31 numbers, with 1 or 3 channels",
        name, size[0], size[1], size[2], channels));
}

Grid::Grid(GridData data, bool nearest, const std::string& name)
    : data_(std::move(data)), nearest_(nearest) {
  check_values(name);
  find_empty_bricks();
}

void Grid::check_values(const std::string& name) {
  const std::vector<float>& values = data_.values;
  for (size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] >= 0 && std::isfinite(values[i]))) {
      const size_t at = i / data_.channels, x = at % data_.size[0],
                   y = at / data_.size[0] % data_.size[1], z = at / data_.size[0] / data_.size[1];
      throw SceneError(fmt::format(
          "{}: the value at x = {}, y = {}, z = {} is {}, but must be finite and not negative",
          name, x, y, z, values[i]));
    }
  }
  const auto channels = static_cast<size_t>(data_.channels);
  for (size_t i = 0; i < values.size(); i += channels)
    for (int c = 0; c < 3; ++c)
      maximum_[c] = std::max(maximum_[c], double{values[i + c % channels]});
}

void Grid::find_empty_bricks() {
  for (int axis = 0; axis < 3; ++axis) bricks_[axis] = (cells(axis) + brick - 1) / brick;
  empty_.assign(size_t(bricks_[0]) * bricks_[1] * bricks_[2], 1);
  const auto channels = static_cast<size_t>(data_.channels);
  // The cells that have value i at a corner are i and i + 1; where values are constant, i alone.
  const int further = nearest_ ? 0 : 1;
  for (int z = 0; z < data_.size[2]; ++z)
    for (int y = 0; y < data_.size[1]; ++y)
      for (int x = 0; x < data_.size[0]; ++x) {
        const float* value = &data_.values[channels * place(x, y, z)];
        if (std::all_of(value, value + channels, [](float v) { return v == 0; })) continue;
        for (int k = z / brick; k <= (z + further) / brick; ++k)
          for (int j = y / brick; j <= (y + further) / brick; ++j)
            for (int i = x / brick; i <= (x + further) / brick; ++i)
              empty_[brick_place(i, j, k)] = 0;
      }
}

}  // namespace mlt
