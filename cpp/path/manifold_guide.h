// What manifold sampling (manifold_sampler.h) knows of a scene before the render: where chains of
// delta vertices begin, which of them are worth finding, and how easily they are found.
//
// Chains are told apart by their lobes alone. Searching costs time, and many scenes do without: a
// walk from a large lamp passes through a glass, or one from the camera hits the lamp behind it. So
// chains are searched for where much of the light is rare, which means that other techniques have
// less than a hundredth of the density with which all together find it.
#pragma once

#include "base/rng.h"
#include "path/path.h"
#include "path/path_rules.h"

#include <memory>
#include <unordered_map>
#include <vector>

namespace mlt {

/// A number for the lobes of the chain first[1] ... first[m].
uint64_t lobes_of(const Vertex* first, int m);

class ManifoldGuide {
 public:
  /// A guide to all chains of the scene.
  explicit ManifoldGuide(const Scene& scene);

  /// Whether the scene has surfaces with delta lobes.
  bool useful() const { return !boxes_.empty(); }
  /// A random point in the bounding box of a shape with delta lobes.
  Vec3 aim(Rng& rng) const;
  /// A guess of the probability of finding the chain first[1] ... first[m], whose lobes a walk from
  /// the light chooses with the probability `lobes`. 0: it is not to be found.
  double guess(const Vertex* first, int m, double lobes) const;

  /// Restricts the guide to chains of these lobes. Such a chain is found `ratio` times as often as
  /// a walk from the light chooses its lobes.
  void choose(std::unordered_map<uint64_t, double> ratios) { ratios_ = std::move(ratios); }

  /// The number of searches after which a chain counts as found again.
  int most_searches() const { return most_searches_; }
  void set_most_searches(int most) { most_searches_ = most; }

 private:
  struct Box {
    Vec3 low, high;
  };

  int most_searches_ = 1 << 16;  ///< Enough but for chains that rounding errors have found.
  std::vector<Box> boxes_;
  std::optional<std::unordered_map<uint64_t, double>> ratios_;
};

/// The guide to the chains along which rare light comes, by what some samples of bidirectional path
/// tracing have found; nullptr if there is little of it.
std::shared_ptr<const ManifoldGuide> learn_manifolds(const Scene& scene, const PathRules& rules);

}  // namespace mlt
