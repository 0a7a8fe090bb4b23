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
  /// Follows the rays of the first `count` walks that go through something to where they stop: in a
  /// medium, on the surface of their hit, or nowhere. hit(i) is what the i-th ray meets first,
  /// medium(i) where it starts; start(i, leg) sets its ray, its number and its likelihood.
  template <class HitOf, class MediumOf, class Start>
  void follow(const Scene& scene, int count, HitOf&& hit, MediumOf&& medium, Start&& start,
              RayCounts& rays) {
    legs_.clear();
    for (int i = 0; i < count; ++i) {
      const Hit met = hit(i);
      const bool meets = met.shape != SurfacePoint::no_shape;
      const bool passes = medium(i) != no_medium || (meets && scene.has_passage(met.shape));
      at_[i] = passes ? static_cast<int>(legs_.size()) : -1;
      if (!passes) continue;
      WaveLeg& leg = legs_.emplace_back();
      leg.hit = met;
      start(i, leg);
    }
    follow_all(scene, rays);
  }
  /// The leg of the i-th walk; nullptr: it goes through nothing.
  const WaveLeg* of(int i) const { return at_[i] < 0 ? nullptr : &legs_[at_[i]]; }

 private:
  void follow_all(const Scene& scene, RayCounts& rays);
  /// Finds the next surfaces of the legs that go on.
  void intersect(const Scene& scene, RayCounts& rays);

  std::vector<WaveLeg> legs_;
  Wave<int> at_;  ///< Where the leg of each walk is; -1: nowhere.
  std::vector<WaveLeg*> going_on_;
};

}  // namespace mlt
