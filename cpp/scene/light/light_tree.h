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
  static constexpr int width = 8;
  using Importances = float[width];

  /// A child of a node, or a light: number `lane` of the children of nodes_[node].
  struct Place {
    uint32_t node = 0;
    int lane = -1;  ///< -1: it has no parent, or the light has no power.
  };
  struct Node {
    /// Roughly the irradiance at p by each child, up to a factor; 0 only if no light reaches it.
    void find_importances(const Vec3f& p, Importances& __restrict found) const;
    void set(int lane, const LightBounds& bounds);

    // Values of the children:
    float x[width], y[width], z[width], radius2[width], axis_x[width], axis_y[width], axis_z[width];
    float cos_normals[width], sin_normals[width], cos_emission[width];
    float power[width];     ///< 0: there is no such child.
    uint32_t child[width];  ///< Index in nodes_, or of the light.
    bool is_light[width];
    Place above;
  };
  struct Binary;

  uint32_t flatten(const std::vector<Binary>& binary, uint32_t root, const Place& above);
  /// On the way up from a light, calls visit(share of the children before, own share) at each node.
  template <class Visit>
  void climb(uint32_t light, const Vec3& p, Visit&& visit) const;

  std::vector<Node> nodes_;
  std::vector<Place> places_;  ///< One for each light.
};

}  // namespace mlt
