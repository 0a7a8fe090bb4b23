// The cells of a grid along a line, in order (Amanatides & Woo 1987, "A fast voxel traversal
// algorithm for ray tracing"), without those of empty bricks.
#pragma once

#include "scene/volume/grid.h"

#include <limits>

namespace mlt {

class GridWalk {
 public:
  /// The part of the line o + t d, 0 <= t <= distance, that is in the grid.
  GridWalk(const Grid& grid, const Vec3& o, const Vec3& d, double distance)
      : grid_(&grid), o_(o), d_(d), per_d_(1.0 / d), t_(0), end_(distance) {
    for (int axis = 0; axis < 3; ++axis) {
      const double to_low = (0 - o[axis]) / d[axis],
                   to_high = (grid.size()[axis] - o[axis]) / d[axis];
      if (d[axis] == 0) {
        if (!(0 <= o[axis] && o[axis] <= grid.size()[axis])) end_ = -1;
        continue;
      }
      t_ = std::max(t_, std::min(to_low, to_high));
      end_ = std::min(end_, std::max(to_low, to_high));
    }
  }

  /// Calls visit(cell, from, to) for each cell, until one returns false.
  template <class Visit>
  void run(Visit&& visit) {
    if (!(t_ < end_)) return;
    for (int axis = 0; axis < 3; ++axis) enter(axis, cell_at(axis, 0, grid_->cells(axis) - 1));
    for (;;) {
      if (grid_->is_empty(cell_)) {
        if (!leave_brick()) return;
        continue;
      }
      const int axis = nearest_side(side_);
      const double to = std::min(side_[axis], end_);
      if (t_ < to && !visit(cell_, t_, to)) return;
      t_ = std::max(t_, to);
      if (!(side_[axis] < end_) || !step(axis, cell_[axis] + (d_[axis] > 0 ? 1 : -1))) return;
    }
  }

 private:
  static int nearest_side(const Vec3& t) {
    return t.x <= t.y ? (t.x <= t.z ? 0 : 2) : (t.y <= t.z ? 1 : 2);
  }
  int cell_at(int axis, int first, int last) const {
    const double x = o_[axis] + t_ * d_[axis] - grid_->begin_of_cell(0);
    return static_cast<int>(std::clamp(x, double(first), double(last)));
  }
  /// Where the line leaves cells first ... last along an axis.
  double far_side(int axis, int first, int last) const {
    if (d_[axis] == 0) return std::numeric_limits<double>::infinity();
    return (grid_->begin_of_cell(d_[axis] > 0 ? last + 1 : first) - o_[axis]) * per_d_[axis];
  }
  void enter(int axis, int cell) {
    cell_[axis] = cell;
    side_[axis] = far_side(axis, cell, cell);
  }
  /// Enters the next cell along an axis; false: there is none.
  bool step(int axis, int cell) {
    if (cell < 0 || cell >= grid_->cells(axis)) return false;
    enter(axis, cell);
    return true;
  }
  /// Goes to the first cell after this brick; false: there is none.
  bool leave_brick() {
    Grid::Index first;
    Vec3 side;
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = cell_[axis] / Grid::brick * Grid::brick;
      side[axis] = far_side(axis, first[axis], first[axis] + Grid::brick - 1);
    }
    const int axis = nearest_side(side);
    t_ = std::max(t_, side[axis]);
    if (!(t_ < end_)) return false;
    for (int other = 0; other < 3; ++other)
      if (other != axis)
        enter(other, cell_at(other, first[other],
                             std::min(first[other] + Grid::brick, grid_->cells(other)) - 1));
    return step(axis, d_[axis] > 0 ? first[axis] + Grid::brick : first[axis] - 1);
  }

  const Grid* grid_;
  Vec3 o_, d_, per_d_;
  double t_, end_;
  Grid::Index cell_{};
  Vec3 side_{0};  ///< Where the line leaves the cell along each axis.
};

}  // namespace mlt
