// Positions on lights at infinity, sampled for many vertices together: the tables of environment
// maps are large, so a single sample would wait for memory.
#pragma once

#include "path/walk.h"

#include <vector>

namespace mlt {

class BackgroundPositions {
 public:
  /// Queues the sampling of a position on a light at infinity. sample_all() writes the result to
  /// `light`, which must not move until then. `time` and `wavelength` are those of its path.
  void add(const EmitterChoice& choice, const Vec2& u, double time, double wavelength,
           LightSample& light) {
    light.emitter = choice.emitter;
    waiting_.push_back({choice, {u, time, wavelength, &light.x0, &light.radiance}});
  }
  void sample_all(const Scene& scene) {
    for (const uint32_t index : scene.infinite_emitters()) {
      requests_.clear();
      for (const Waiting& waiting : waiting_)
        if (waiting.choice.index == index) requests_.push_back(waiting.request);
      scene.emitters()[index]->sample_positions(requests_.data(),
                                                static_cast<int>(requests_.size()));
    }
    for (const Waiting& waiting : waiting_)
      waiting.request.sample->pdf *= waiting.choice.probability;
    waiting_.clear();
  }

 private:
  struct Waiting {
    EmitterChoice choice;
    PositionRequest request;
  };
  std::vector<Waiting> waiting_;
  std::vector<PositionRequest> requests_;
};

}  // namespace mlt
