// The manifold walk: a chain of (nearly) specular vertices between two ends follows when one of the
// ends moves, while the other stays (Jakob & Marschner 2012, "Manifold exploration", sec. 4.3).
//
// Each step moves the first vertex by the derivative of the chain, and traces a ray from the end
// that stays through it and on, with the constraints kept; a step that does not come closer is
// halved. So all chains on the way are ones that light can take.
#pragma once

#include "path/specular_chain.h"
#include "path/walk.h"

namespace mlt {

/// The ray from the end of a chain through p.
Ray ray_through(const Scene& scene, const SurfacePoint& end, const Vec3& p, double time);

class ManifoldWalk {
 public:
  /// Starts with the chain of `count` vertices between first[0], which stays, and first[count + 1].
  /// False if no walk is possible from it.
  bool start(const Scene& scene, const Vertex* first, int count);

  /// Traces the chain again at another wavelength, with its first vertex and its constraints kept;
  /// false if that is not possible. It ends somewhere else then.
  bool change_wavelength(double u, double time, RayCounts& rays);

  /// Walks until the chain ends in `end`, with visibility; false if it does not converge.
  bool go(const SurfacePoint& end, double time, RayCounts& rays);

  /// The vertices between the ends.
  int count() const { return count_; }
  const Vertex& operator[](int i) const { return chain_[i + 1]; }
  /// Whether the chain is that between first[0] and first[count() + 1], up to rounding.
  bool ended_in(const Vertex* first) const;

 private:
  static constexpr int most = SpecularChain::most_vertices;
  static constexpr int most_steps = 20;
  static constexpr double least_step = 1.0 / 64;

  using Chain = std::vector<Vertex>;  ///< Vertices with both ends.

  /// Traces the chain from the end that stays through `p`. Its last vertex becomes the point of the
  /// last ray that is nearest to `end`.
  bool trace(const Vec3& p, const SurfacePoint& end, double time, RayCounts& rays,
             Chain& chain) const;

  const Scene* scene_ = nullptr;
  int count_ = 0;
  Chain chain_, next_;
  std::array<SpecularScattering, most> kept_;
};

}  // namespace mlt
