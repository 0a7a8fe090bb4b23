// A grid of numbers or colours: linear between its values, or constant around each of them. Value
// (i, j, k) is the one at x = i + 1/2, y = j + 1/2, z = k + 1/2.
#pragma once

#include "math/color.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace mlt {

struct GridData {
  std::array<int, 3> size{};  ///< Values along x, y and z.
  int channels = 1;           ///< 1, or 3: RGB.
  std::vector<float> values;  ///< Channels first, then x, y and z.
};

/// Throws UsageError, which begins with `name`, if a grid would have no values, more than 2^31, or
/// another number of channels than 1 or 3.
void check_grid_size(const std::array<int64_t, 3>& size, int64_t channels, const std::string& name);

class Grid {
 public:
  using Index = std::array<int, 3>;

  /// The values around a place: those of four edges along x, in loops that the compiler
  /// vectorises. T is double or Color.
  template <class T>
  struct Cell {
    T begin[4];  ///< Bit 0 of the index: z, bit 1: y.
    T rise[4];   ///< From the beginning of the edge to its end.

    /// `f`: position in the cell, from 0 to 1.
    T at(const Vec3& f) const {
      T value[4];
      for (int i = 0; i < 4; ++i) value[i] = begin[i] + f.x * rise[i];
      for (int i = 0; i < 2; ++i) value[i] += f.y * (value[i + 2] - value[i]);
      return value[0] + f.z * (value[1] - value[0]);
    }
  };

  /// Throws UsageError, which begins with `name`, if a value is negative or not finite;
  /// subnormal ones are 0.
  Grid(const GridData& data, bool nearest, const std::string& name);

  const std::array<int, 3>& size() const { return size_; }
  bool is_coloured() const { return channels_ == 3; }
  const Color& maximum() const { return maximum_; }

  /// Cells have a value at each corner, and begin at x = i - 1/2. Half of the first lies outside of
  /// the grid, as does half of the last: there the outermost values continue. Where values are
  /// constant, cells begin at x = i, and none lies outside.
  int cells(int axis) const { return size_[axis] + (nearest_ ? 0 : 1); }
  /// The sides of the grid, counted in cells from the beginning of the first.
  double low() const { return nearest_ ? 0 : 0.5; }
  double high(int axis) const { return low() + size_[axis]; }
  template <class T>
  Cell<T> cell(const Index& index) const {
    const size_t low = place(index[0], index[1], index[2]);
    Cell<T> cell;
    for (int i = 0; i < 4; ++i) {
      cell.begin[i] = value<T>(low + to_edge_[i]);
      cell.rise[i] = value<T>(low + to_edge_[i] + along_edge_) - cell.begin[i];
    }
    return cell;
  }

  /// The edge of an empty cube of cells, which can be skipped, around a cell: 4, 8, 16 or 32, and
  /// cells at its low sides have multiples of that as their indices; 0: the cell may not be empty.
  int empty_cube(const Index& cell) const {
    return empty_edges_[brick_place(cell[0] / brick, cell[1] / brick, cell[2] / brick)];
  }
  /// The box of all cells that are not empty, as low() and high() count; around nothing it is void.
  const Vec3& filled_low() const { return filled_low_; }
  const Vec3& filled_high() const { return filled_high_; }

 private:
  /// The index of the value at the low corner of a cell. The values are stored with those that
  /// continue them around the grid.
  size_t place(int x, int y, int z) const {
    return (size_t(z) * (size_[1] + 2) + y) * (size_[0] + 2) + x;
  }
  size_t brick_place(int x, int y, int z) const {
    return (size_t(z) * bricks_[1] + y) * bricks_[0] + x;
  }
  template <class T>
  T value(size_t place) const {
    if constexpr (std::is_same_v<T, Color>) {
      const float* rgb = &values_[3 * place];
      return {rgb[0], rgb[1], rgb[2]};
    } else {
      return values_[place];
    }
  }
  void check(const GridData& data, const std::string& name);
  void store(const GridData& data);
  void find_empty_bricks(const GridData& data);
  void fill_around(const Index& value);
  void join_empty_cubes();
  void join_empty_cubes(int edge, const Index& first);

  /// Bricks are the smallest cubes that can be skipped.
  static constexpr int brick = 4, largest_cube = 32;

  std::array<int, 3> size_;
  int channels_;
  bool nearest_;
  std::vector<float> values_;
  std::array<size_t, 4> to_edge_;  ///< From the low corner of a cell to its edges; see Cell.
  size_t along_edge_;
  Color maximum_{0};
  std::array<int, 3> bricks_{};
  std::vector<uint8_t> empty_edges_;  ///< See empty_cube(); for each brick.
  Vec3 filled_low_{std::numeric_limits<double>::infinity()}, filled_high_{-filled_low_};
};

}  // namespace mlt
