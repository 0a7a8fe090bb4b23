// Which light is sampled: for a walk from the lights by power, for next-event estimation at a point
// by what each light may send there (LightTree), where there are more than a few.
#pragma once

#include "math/distribution.h"
#include "scene/emitter/emitter.h"
#include "scene/light/light_tree.h"

#include <vector>

namespace mlt {

/// A chosen light, by its index, and the probability of the choice; 0: there is none.
struct LightIndex {
  uint32_t index;
  double probability;
};

class LightChoice {
 public:
  LightChoice() = default;
  /// Lights that move are somewhere around their places at these two times. Throws SceneError if no
  /// light has a sampling weight.
  LightChoice(const std::vector<EmitterPtr>& lights, double open, double close);

  /// Whether the choice for next-event estimation depends on the point.
  bool depends_on_point() const { return !tree_.empty(); }

  // For walks. u is rescaled so that it can be used again.
  LightIndex choose(double& u) const {
    if (part_of_.size() == 1) return {0, 1};
    const auto [index, remainder] = by_power_.sample_reuse(u);
    u = remainder;
    return {static_cast<uint32_t>(index), by_power_.pdf(index)};
  }
  double probability(uint32_t index) const { return by_power_.pdf(index); }
  /// A u with which choose() chooses this light and leaves v.
  double invert(uint32_t index, double v) const { return by_power_.invert(index, v); }

  // For next-event estimation at the point p.
  LightIndex choose_for(const Vec3& p, double& u) const {
    return depends_on_point() ? choose_in_tree(p, u) : choose(u);
  }
  double probability_for(uint32_t index, const Vec3& p) const;
  double invert_for(uint32_t index, const Vec3& p, double v) const;

 private:
  LightIndex choose_in_tree(const Vec3& p, double& u) const;

  Discrete by_power_;
  LightTree tree_;  ///< Lights that are not at infinity; empty if they are few.
  /// The lights at infinity, and all others as one, with a tree.
  Discrete parts_;
  std::vector<uint32_t> infinite_;
  std::vector<uint32_t> part_of_;  ///< For each light its index in parts_.
};

}  // namespace mlt
