// Positions on lights at infinity, sampled for many vertices together: the tables of environment
// maps are large, so a single sample would wait for memory.
#pragma once

#include "path/walk.h"

#include <vector>

namespace mlt {

class BackgroundPositions {
 public:
  /// Queues the sampling of a position by (u.y, u.z) on the light that u.x chooses for `from`, if
  /// it is at infinity; else returns false. sample_all() writes the result to `light`, which must
  /// not move until then. `wavelength` is that of its path.
  bool add(const Scene& scene, const Vec3& from, Vec3 u, double wavelength, LightSample& light) {
    if (scene.infinite_emitters().empty()) return false;
    const EmitterChoice choice = scene.choose_emitter_for(from, u.x);
    if (!choice.emitter->infinite()) return false;
    light.emitter = choice.emitter;
    waiting_.push_back({choice, {{u.y, u.z}, &light.x0}, wavelength});
    return true;
  }
  void sample_all(const Scene& scene) {
    for (const uint32_t index : scene.infinite_emitters()) {
      requests_.clear();
      for (const Waiting& waiting : waiting_)
        if (waiting.choice.index == index) requests_.push_back(waiting.request);
      scene.emitters()[index]->sample_positions(requests_.data(),
                                                static_cast<int>(requests_.size()));
    }
    for (const Waiting& waiting : waiting_) {
      waiting.request.sample->pdf *= waiting.choice.probability;
      waiting.request.sample->at.wavelength = waiting.wavelength;
    }
    waiting_.clear();
  }

 private:
  struct Waiting {
    EmitterChoice choice;
    PositionRequest request;
    double wavelength;
  };
  std::vector<Waiting> waiting_;
  std::vector<PositionRequest> requests_;
};

}  // namespace mlt
