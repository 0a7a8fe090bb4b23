// Walks from the camera by the numbers of many chains, traced side by side (PathWave).
#pragma once

#include "primary/primary_step.h"
#include "wave/number_rows.h"
#include "wave/path_wave.h"

#include <vector>

namespace mlt {

/// The states hold numbers of Stream::camera alone, and light at the walk's own position.
class WalkWave : private DrawnNumbers::Source {
 public:
  static constexpr size_t capacity = BasicPathWave<DrawnNumbers>::capacity;

  WalkWave(const Scene& scene, const PathRules& rules, const SmallStep& small_step);

  /// Adds a proposal from x, to be stored in y, by the random numbers of `key`: a small step, or a
  /// large one. `rays` counts its rays.
  void add(const PrimaryState& x, bool large, uint64_t key, PrimaryState& y, RayCounts& rays) {
    proposals_.push_back({key, large ? nullptr : &x.numbers[Stream::camera], &y, &rays, 0});
  }
  /// Traces all proposals that were added, and clears the wave.
  void trace();

 private:
  struct Proposal {
    uint64_t key;
    const std::vector<double>* from;
    PrimaryState* y;
    RayCounts* rays;
    size_t length;  ///< How many numbers it has drawn; its buffer may hold more.
    std::vector<double>& numbers() const { return y->numbers[Stream::camera]; }
  };

  void leave_camera();
  void draw(const int* paths, int count, size_t first, bool leg_alone,
            const double** numbers) override;
  /// Draws `numbers` numbers, from the first-th on, of the proposals get(0), ..., get(count - 1).
  template <size_t numbers, class Get>
  void draw(int count, size_t first, Get&& get);

  const Scene* scene_;
  SmallStep small_step_;
  BasicPathWave<DrawnNumbers> wave_;
  std::vector<Proposal> proposals_;
  NumberRows rows_;
  std::vector<Vec2> rasters_;
};

}  // namespace mlt
