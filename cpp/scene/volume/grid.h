// A grid of numbers or colours: linear between its values, or constant around each of them. Value
// (i, j, k) is the one at x = i + 1/2, y = j + 1/2, z = k + 1/2.
#pragma once

#include "math/color.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mlt {

struct GridData {
  std::array<int, 3> size{};  ///< Values along x, y and z.
  int channels = 1;           ///< 1, or 3: RGB.
  std::vector<float> values;  ///< Channels first, then x, y and z.
};

/// Throws SceneError, which begins with `name`, if a grid would have no values, more than 2^31, or
/// another number of channels than 1 or 3.
void check_grid_size(const std::array<int64_t, 3>& size, int64_t channels, const std::string& name);

class Grid {
 public:
  using Index = std::array<int, 3>;

  /// The eight values around a place, at the corners of a cell; T is double or Color.
  template <class T>
  struct Cell {
    std::array<T, 8> corner;  ///< Bit 0 of the index: x, bit 1: y, bit 2: z.

    /// `f`: position in the cell, from 0 to 1.
    T at(const Vec3& f) const {
      T plane[2];
      for (int z = 0; z < 2; ++z) {
        const T *row = &corner[4 * z], low = row[0] + f.x * (row[1] - row[0]),
                high = row[2] + f.x * (row[3] - row[2]);
        plane[z] = low + f.y * (high - low);
      }
      return plane[0] + f.z * (plane[1] - plane[0]);
    }
  };

  /// Throws SceneError, which begins with `name`, if a value is negative or not finite.
  Grid(GridData data, bool nearest, const std::string& name);

  const std::array<int, 3>& size() const { return data_.size; }
  bool is_coloured() const { return data_.channels == 3; }
  const Color& maximum() const { return maximum_; }

  /// Cells have a value at each corner, and begin at x = i + 1/2. They are numbered from 0, half of
  /// which lies outside of the grid, as does the last: there the outermost values continue. Where
  /// values are constant, cells begin at x = i, and none lies outside.
  int cells(int axis) const { return data_.size[axis] + (nearest_ ? 0 : 1); }
  double begin_of_cell(int i) const { return nearest_ ? i : i - 0.5; }
  template <class T>
  Cell<T> cell(const Index& index) const {
    Index low = index, high = index;
    for (int axis = 0; axis < 3 && !nearest_; ++axis) {
      low[axis] = std::max(index[axis] - 1, 0);
      high[axis] = std::min(index[axis], data_.size[axis] - 1);
    }
    Cell<T> cell;
    for (int i = 0; i < 8; ++i)
      cell.corner[i] = value<T>(
          place(i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]));
    return cell;
  }

  /// Bricks are cubes of cells; an empty one can be skipped.
  static constexpr int brick = 8;
  bool is_empty(const Index& cell) const {
    return empty_[brick_place(cell[0] / brick, cell[1] / brick, cell[2] / brick)];
  }

 private:
  size_t place(int x, int y, int z) const {
    return (size_t(z) * data_.size[1] + y) * data_.size[0] + x;
  }
  size_t brick_place(int x, int y, int z) const {
    return (size_t(z) * bricks_[1] + y) * bricks_[0] + x;
  }
  template <class T>
  T value(size_t place) const {
    if constexpr (std::is_same_v<T, Color>) {
      const float* rgb = &data_.values[3 * place];
      return {rgb[0], rgb[1], rgb[2]};
    } else {
      return data_.values[place];
    }
  }
  void check_values(const std::string& name);
  void find_empty_bricks();

  GridData data_;
  bool nearest_;
  Color maximum_{0};
  std::array<int, 3> bricks_{};
  std::vector<uint8_t> empty_;
};

}  // namespace mlt
