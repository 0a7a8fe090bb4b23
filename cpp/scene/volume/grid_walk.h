// The cells of a grid along a line, in order (Amanatides & Woo 1987, "A fast voxel traversal
// algorithm for ray tracing"), without those of empty bricks.
#pragma once

#include "scene/volume/grid.h"

#include <limits>

namespace mlt {

class GridWalk {
 public:
  /// The part of the line o + t d, 0 <= t <= distance, that is in the grid; in cells, from the
  /// beginning of the first.
  GridWalk(const Grid& grid, const Vec3& o, const Vec3& d, double distance)
      : grid_(&grid), o_(o), d_(d), per_d_(1.0 / d), t_(0), end_(distance) {
    for (int axis = 0; axis < 3; ++axis) {
      step_[axis] = d[axis] > 0 ? 1 : -1;
      const double low = grid.low(), high = grid.high(axis);
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
    bool is_empty = grid_->is_empty(cell_);
    for (;;) {
      int axis;
      if (is_empty) {
        axis = leave_brick();
        if (!(t_ < end_)) return;
      } else {
        axis = nearest(side_);
        const double to = std::min(side_[axis], end_);
        if (t_ < to && !visit(cell_, t_, to)) return;
        t_ = std::max(t_, to);
        if (!(side_[axis] < end_)) return;
      }
      const int next = cell_[axis] + step_[axis];
      if (next < 0 || next >= grid_->cells(axis)) return;
      const bool same_brick = !is_empty && next / Grid::brick == cell_[axis] / Grid::brick;
      enter(axis, next);
      if (!same_brick) is_empty = grid_->is_empty(cell_);
    }
  }

 private:
  static int nearest(const Vec3& t) {
    return t.x <= t.y ? (t.x <= t.z ? 0 : 2) : (t.y <= t.z ? 1 : 2);
  }
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
  /// Goes to the last cell in this brick; returns the axis along which the line leaves it.
  int leave_brick() {
    Grid::Index first, last;
    Vec3 side;
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = cell_[axis] / Grid::brick * Grid::brick;
      last[axis] = std::min(first[axis] + Grid::brick, grid_->cells(axis)) - 1;
      side[axis] = far_side(axis, step_[axis] > 0 ? last[axis] : first[axis]);
    }
    const int out = nearest(side);
    t_ = std::max(t_, side[out]);
    for (int axis = 0; axis < 3; ++axis)
      enter(axis, axis != out       ? cell_at(axis, first[axis], last[axis])
                  : step_[axis] > 0 ? last[axis]
                                    : first[axis]);
    return out;
  }

  const Grid* grid_;
  Vec3 o_, d_, per_d_;
  double t_, end_;
  Grid::Index step_, cell_{};
  Vec3 side_{0};  ///< See far_side().
};

}  // namespace mlt
