// The cells of a grid along a line, in order (Amanatides & Woo 1987, "A fast voxel traversal
// algorithm for ray tracing"), without those in empty cubes.
#pragma once

#include "scene/volume/grid.h"

namespace mlt {

class GridWalk {
 public:
  /// The part of the line o + t d, 0 <= t <= distance, that is in the box of what is not empty; in
  /// cells, from the beginning of the grid's first.
  GridWalk(const Grid& grid, const Vec3& o, const Vec3& d, double distance)
      : grid_(&grid), o_(o), d_(d), per_d_(1.0 / d), t_(0), end_(distance) {
    for (int axis = 0; axis < 3; ++axis) {
      step_[axis] = d[axis] > 0 ? 1 : -1;
      const double low = grid.filled_low()[axis], high = grid.filled_high()[axis];
      if (d[axis] == 0) {
        if (!(low <= o[axis] && o[axis] <= high)) end_ = -1;
        continue;
      }
      const double to_low = (low - o[axis]) * per_d_[axis],
                   to_high = (high - o[axis]) * per_d_[axis];
      t_ = std::max(t_, std::min(to_low, to_high));
      end_ = std::min(end_, std::max(to_low, to_high));
    }
  }

  /// Calls visit(cell, from, to) for each cell, until one returns false.
  template <class Visit>
  void run(Visit&& visit) {
    if (!(t_ < end_)) return;
    for (int axis = 0; axis < 3; ++axis) enter(axis, cell_at(axis, 0, grid_->cells(axis) - 1));
    do {
      if (const int edge = grid_->empty_cube(cell_)) {
        leave_cube(edge);
        if (!(t_ < end_)) return;
      } else {
        const double side = least(side_), to = std::min(side, end_);
        if (t_ < to && !visit(cell_, t_, to)) return;
        t_ = std::max(t_, to);
        if (!(side < end_)) return;
        leave_cell(side);
      }
    } while (is_in_grid());
  }

 private:
  static double least(const Vec3& t) { return std::min(std::min(t.x, t.y), t.z); }
  int cell_at(int axis, int first, int last) const {
    return static_cast<int>(std::clamp(o_[axis] + t_ * d_[axis], double(first), double(last)));
  }
  /// Where the line comes to the side of a cell that it leaves through; infinite along the side.
  double far_side(int axis, int cell) const {
    if (d_[axis] == 0) return std::numeric_limits<double>::infinity();
    return (cell + (step_[axis] > 0) - o_[axis]) * per_d_[axis];
  }
  void enter(int axis, int cell) {
    cell_[axis] = cell;
    side_[axis] = far_side(axis, cell);
  }
  bool is_in_grid() const {
    bool is_in = true;
    for (int axis = 0; axis < 3; ++axis)
      is_in &= static_cast<unsigned>(cell_[axis]) < static_cast<unsigned>(grid_->cells(axis));
    return is_in;
  }
  /// Goes on to the next cell: along each axis whose side is the nearest.
  void leave_cell(double nearest) {
    for (int axis = 0; axis < 3; ++axis) {
      const bool leaves = side_[axis] <= nearest;
      cell_[axis] += leaves ? step_[axis] : 0;
      side_[axis] += leaves ? std::fabs(per_d_[axis]) : 0.0;
    }
  }
  /// Goes on to the first cell behind an empty cube.
  void leave_cube(int edge) {
    Grid::Index first;
    Vec3 side;
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = cell_[axis] & -edge;
      side[axis] = far_side(axis, step_[axis] > 0 ? first[axis] + edge - 1 : first[axis]);
    }
    const double nearest = least(side);
    t_ = std::max(t_, nearest);
    for (int axis = 0; axis < 3; ++axis)
      enter(axis, side[axis] > nearest ? cell_at(axis, first[axis], first[axis] + edge - 1)
                  : step_[axis] > 0    ? first[axis] + edge
                                       : first[axis] - 1);
  }

  const Grid* grid_;
  Vec3 o_, d_, per_d_;
  double t_, end_;
  Grid::Index step_, cell_{};
  Vec3 side_{0};  ///< See far_side().
};

}  // namespace mlt
