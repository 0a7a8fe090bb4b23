// What manifold sampling (manifold_sampler.h) knows of a scene before the render: where chains of
// delta vertices begin, which of them are worth finding, and how easily they are found.
//
// Chains are told apart by their lobes alone. Searching costs time, and many scenes do without: a
// walk from a large lamp passes through a glass, or one from the camera hits the lamp behind it. So
// chains are searched for where much of the light is rare, for the rays that it takes: other
// techniques have less than a tenth of the density with which all together find it.
#pragma once

#include "base/rng.h"
#include "path/manifold_photons.h"
#include "path/path.h"
#include "path/path_rules.h"

#include <memory>
#include <unordered_map>
#include <vector>

namespace mlt {

/// A number for the lobes of the chain first[1] ... first[m].
uint64_t lobes_of(const Vertex* first, int m);
/// m, for such a number.
int count_lobes(uint64_t key);

/// How a seed begins.
struct ManifoldAim {
  Vec3 at;             ///< A point that its first ray passes through.
  uint64_t lobes = 0;  ///< The lobes of its chain (see lobes_of); 0: they are drawn.
};

class ManifoldGuide {
 public:
  /// A guide to all chains of the scene.
  explicit ManifoldGuide(const Scene& scene);

  /// Whether the scene has surfaces with delta lobes.
  bool useful() const { return !boxes_.empty(); }
  /// Where a seed from x0 begins that is to end near y.
  ManifoldAim aim(const Vertex& x0, const Vertex& y, Rng& rng) const;
  /// A random point in the bounding box of a shape with delta lobes.
  Vec3 aim_blindly(Rng& rng) const;
  /// The probability that a seed from first[0] to first[m + 1] has the lobes of the chain between
  /// them, which a walk from the light chooses with the probability `lobes`.
  double lobes_of_seed(const Vertex* first, int m, double lobes) const;
  /// A guess of the probability of finding this chain. 0: it is not to be found.
  double guess(const Vertex* first, int m, double lobes) const;

  /// Has most seeds follow photons.
  void follow(std::shared_ptr<const ManifoldPhotons> photons) { photons_ = std::move(photons); }

  /// Restricts the guide to chains of these lobes. Such a chain is found `ratio` times as often as
  /// a seed has its lobes.
  void choose(std::unordered_map<uint64_t, double> ratios) { ratios_ = std::move(ratios); }

  /// The number of searches after which a chain counts as found again.
  int most_searches() const { return most_searches_; }
  void set_most_searches(int most) { most_searches_ = most; }

 private:
  struct Box {
    Vec3 low, high;
  };

  ManifoldPhotons::Cell photons_near(const Vertex& x0, const Vertex& y) const;

  int most_searches_ = 1 << 16;  ///< Enough but for chains that rounding errors have found.
  std::vector<Box> boxes_;
  std::shared_ptr<const ManifoldPhotons> photons_;
  std::optional<std::unordered_map<uint64_t, double>> ratios_;
};

/// Rays by which a guide is learned: half a second or less. Rays are counted, not seconds, so that
/// each run learns alike.
inline constexpr uint64_t rays_of_lessons = 1 << 20;

/// Photons from the lights of the scene from which chains are searched, by about this many rays.
std::shared_ptr<const ManifoldPhotons> send_photons(const Scene& scene,
                                                    uint64_t most_rays = rays_of_lessons / 2);

/// The guide to the chains along which rare light comes, by what some samples of bidirectional path
/// tracing have found; nullptr if there is little of it. The samples take about `most_rays`, and
/// photons half as many.
std::shared_ptr<const ManifoldGuide> learn_manifolds(const Scene& scene, const PathRules& rules,
                                                     uint64_t most_rays = rays_of_lessons);

}  // namespace mlt
