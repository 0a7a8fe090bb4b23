// The film of Metropolis integrators. Splats are bounded, so they add up in fixed point: integer
// sums do not depend on their order, and the image has the same bits for any number of threads.
#pragma once

#include "image/edge_scale.h"
#include "image/filter_rows.h"
#include "image/image.h"
#include "image/splat.h"
#include "math/color.h"

#include <atomic>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace mlt {

class SplatFilm {
 public:
  /// `around`: whether there are splats as far outside the image as the filter reaches.
  SplatFilm(int width, int height, std::shared_ptr<const Filter> filter, int groups,
            bool around = true);

  /// Adds `color` times the filter at a raster position. Thread-safe.
  void add(int group, const Vec2& raster, const Color& color);
  /// The number of rows that a splat reaches.
  int splat_rows() const { return std::max(1, rows_.pixels()); }
  /// Address of the i-th row of a splat, for prefetching; nullptr outside of the image.
  const void* splat_row(int group, const Vec2& raster, int i) const {
    const double before = 0.5 * (splat_rows() - 1);
    const int x = static_cast<int>(raster.x - before), y = static_cast<int>(raster.y - before) + i;
    if (x < 0 || x >= width_ || y < 0 || y >= height_) return nullptr;
    return row(group, y) + 3 * x;
  }

  int group_count() const { return groups_; }
  /// The sum over the groups g of scale[g] times the sum of g.
  Image image(const std::vector<double>& scale) const;
  /// The number of additions that were out of the range of fixed point, or to a sum that was.
  uint64_t saturated() const { return saturated_; }

  /// Saves the groups first ... last - 1.
  std::string save(int first, int last) const;
  /// Adds the saved sums of these groups of another film. Throws RenderError if the bytes do not
  /// fit, and changes nothing then.
  void merge(int first, int last, const std::string& bytes);

 private:
  struct Free {
    void operator()(int64_t* cells) const { std::free(cells); }
  };
  using Lock = std::atomic<bool>;
  /// How many rows share a lock.
  static constexpr int band_rows = 8;

  size_t group_size() const { return size_t{3} * width_ * height_; }
  size_t bands() const { return (height_ + band_rows - 1) / band_rows; }
  int64_t* row(int group, int y) const {
    return &cells_[3 * (size_t(group) * height_ + y) * width_];
  }
  /// Calls use() while no other thread can access the rows of the band that y is in.
  template <class Use>
  void with_band(int group, int y, Use&& use) const;
  /// Adds a splat in steps of fixed point; false if the filter covers pixels outside the image, or
  /// has no table.
  bool add_whole(int group, const Vec2& raster, const Color& steps);

  int width_, height_, groups_;
  std::shared_ptr<const Filter> filter_;
  FilterRows<double> rows_;
  EdgeScale edge_scale_;
  /// Sums by [group][pixel][channel]; they take memory only where splats have been added.
  std::unique_ptr<int64_t[], Free> cells_;
  std::unique_ptr<Lock[]> locks_;  ///< [group][band]
  std::atomic<uint64_t> saturated_{0};
};

}  // namespace mlt
