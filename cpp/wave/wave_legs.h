// Legs of many walks, followed side by side through media, and through surfaces that light passes.
#pragma once

#include "math/lanes.h"
#include "path/walk.h"

#include <vector>

namespace mlt {

/// A leg of Walker::go_on() in a wave.
struct WaveLeg {
  Ray ray;                     ///< What is left of it behind the last surface that it has passed.
  Hit hit;                     ///< The surface that this meets next, or no_shape.
  double u;                    ///< The number of the leg.
  Passage passed;              ///< What it has passed.
  std::optional<double> stop;  ///< The distance at which it stops in a medium.

  bool in_medium() const { return stop.has_value(); }
};

class WaveLegs {
 public:
  void clear() { legs_.clear(); }
  WaveLeg& add(const WaveLeg& leg) { return legs_.emplace_back(leg); }
  /// Follows all legs to where they stop: in a medium, on the surface of their hit, or nowhere.
  void follow(const Scene& scene, RayCounts& rays);

  const std::vector<WaveLeg>& all() const { return legs_; }

 private:
  /// Finds the next surfaces of the legs that go on.
  void intersect(const Scene& scene, RayCounts& rays);

  std::vector<WaveLeg> legs_;
  std::vector<WaveLeg*> going_on_;
};

}  // namespace mlt
