// A hierarchy of lights, which chooses one by what it may send to a point: in proportion to power,
// distance and the cosine of emission, bounded for all lights of a node together.
// A. Conty Estevez, C. Kulla, "Importance sampling of many lights with adaptive tree splitting",
// HPG 2018.
#pragma once

#include "math/vec.h"

#include <cstdint>
#include <vector>

namespace mlt {

/// Where some lights are, and where to they may shine.
struct LightBounds {
  Vec3 low{infinity}, high{-infinity};
  /// All normals are within an angle of this axis, and each light shines within an angle of its
  /// normal.
  Vec3 axis{0, 0, 1};
  double cos_normals = -1, cos_emission = -1;
  double power = 0;
};

class LightTree {
 public:
  LightTree() = default;
  /// Throws UsageError if no light has any power.
  explicit LightTree(const std::vector<LightBounds>& lights);

  bool empty() const { return nodes_.empty(); }

  struct Choice {
    uint32_t light;
    double probability;  ///< 0: no light reaches the point.
    double remainder;    ///< Uniform in [0, 1): u can be used again.
  };
  Choice sample(const Vec3& p, double u) const;
  /// The probability with which sample() chooses a light for p.
  double probability(uint32_t light, const Vec3& p) const;
  /// The u which sample() maps to this light and remainder.
  double invert(uint32_t light, const Vec3& p, double remainder) const;

 private:
  struct Node {
    explicit Node(const LightBounds& bounds);

    /// Roughly the irradiance at p, up to a factor; 0 only if no light reaches it.
    double importance(const Vec3& p) const;

    Vec3 centre, axis;
    double radius2, cos_normals, sin_normals, cos_emission, power;
    /// Index of the second child, the first one follows its parent; 0: a leaf.
    uint32_t second = 0;
    uint32_t light = 0;  ///< Of a leaf.
  };
  uint32_t build(const std::vector<LightBounds>& lights, std::vector<uint32_t>::iterator first,
                 std::vector<uint32_t>::iterator last, uint64_t turns, int depth);
  /// The probability of the first child.
  double first_share(const Node& node, const Vec3& p) const;
  /// Calls visit(whether it is the second child, its probability) on the way down to a light.
  template <class Visit>
  void descend(uint32_t light, const Vec3& p, Visit&& visit) const;

  std::vector<Node> nodes_;
  std::vector<uint64_t> turns_;  ///< For each light: bit d is set where the way turns to the second
                                 ///< child at depth d.
  std::vector<bool> has_;        ///< For each light: whether it has any power.
};

}  // namespace mlt
