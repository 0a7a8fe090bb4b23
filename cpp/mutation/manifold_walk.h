// The manifold walk: a chain of (nearly) specular vertices between two ends follows when one of the
// ends moves, while the other stays (Jakob & Marschner 2012, "Manifold exploration", sec. 4.3).
//
// Each step moves the first vertex by the derivative of the chain, and traces a ray from the end
// that stays through it and on, with the constraints kept; a step that does not come closer is
// halved. So all chains on the way are ones that light can take.
#pragma once

#include "mutation/path_state.h"
#include "mutation/specular_chain.h"
#include "path/walk.h"

namespace mlt {

class ManifoldWalk {
 public:
  /// Starts with the chain of x between vertex c and vertex b > c, of which c stays. False if no
  /// walk is possible from it.
  bool start(const Scene& scene, const PathState& x, int c, int b);

  /// Walks until the chain ends in `end`, with visibility; false if it does not converge.
  bool go(const SurfacePoint& end, double time, RayCounts& rays);

  /// Vertices c + 1 ... b - 1 of the chain.
  int count() const { return count_; }
  const Vertex& operator[](int i) const { return chain_[i + 1]; }

 private:
  static constexpr int most = SpecularChain::most_vertices;
  static constexpr int most_steps = 20;
  static constexpr double least_step = 1.0 / 64;

  using Chain = std::vector<Vertex>;  ///< Vertices with both ends.

  /// Traces the chain from the end that stays through `p`. Its last vertex becomes the point of the
  /// last ray that is nearest to `end`.
  bool trace(const Vec3& p, const SurfacePoint& end, double time, RayCounts& rays,
             Chain& chain) const;
  Ray first_ray(const Vec3& p, double time) const;

  const Scene* scene_ = nullptr;
  int count_ = 0;
  Chain chain_, next_;
  std::array<SpecularScattering, most> kept_;
};

}  // namespace mlt
