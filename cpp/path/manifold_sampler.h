// Specular manifold sampling (Zeltner, Georgiev & Jakob 2020, "Specular manifold sampling for
// rendering high-frequency caustics and glints", sec. 4): a point x_0 of a light and a smooth
// vertex y are joined across a chain of delta vertices. A seed is a random chain from x_0, which
// follows a photon that has arrived near y (manifold_photons.h), and a manifold walk takes its end
// to y. So small lamps are found through glass and water.
//
// Which chain is found is chance. Its probability p has no closed form, but 1 / p is estimated
// without bias by the number n of searches until one finds the same chain again. With a guess q of
// p the technique is one of bidirectional path tracing, the one with s = m + 1 vertices from the
// light: a light walk cannot be connected at the m delta vertices, and makes them with densities
// of its own. In place of 1 the technique counts
//
//   q density of the chain given x_0 and y / (from_light of x_1 ... x_m)
//
// times in TechniqueSums, and what it finds counts n q times.
#pragma once

#include "path/manifold_guide.h"
#include "path/manifold_walk.h"
#include "path/path_terms.h"

namespace mlt {

/// Whether chains are searched from this vertex of a light. Lights at infinity that can be hit are
/// large, and camera walks hit them.
inline bool starts_chains(const Scene& scene, const Vertex& x0) {
  return connectable(x0) && !(x0.at.infinite() && can_be_hit(scene, x0));
}

/// The probability that a walk from the light chooses the lobes of x_1 ... x_m.
inline double lobes_pdf(const PathTerms& terms, int m) {
  double p = 1;
  for (int i = 1; i <= m; ++i) {
    const double arrival = terms.arrival(i, 1).probability();
    p *= arrival > 0 ? terms[i].vertex.pdf_from_light / arrival : 0;
  }
  return p;
}

class ManifoldSampler {
 public:
  ManifoldSampler(const Scene& scene, std::shared_ptr<const ManifoldGuide> guide)
      : scene_(&scene), guide_(std::move(guide)) {}

  /// The guess q times the density of the chain x_1 ... x_m between x_0 and x_{m+1}, given these
  /// two (see SpecularChain); `lobes` as for ManifoldGuide. 0 if the chain cannot be found.
  double chain_density(const Vertex* x0, int m, double lobes) const;
  /// The technique in the terms of a whole path.
  ExtraTechnique technique(const Path& path, const PathTerms& terms) const;

  /// Searches for a chain from x0 to y, once; false if none is found.
  bool find(const Vertex& x0, const Vertex& y, double time, Rng& rng, RayCounts& rays);
  /// What find() has found: x0, the vertices of the chain, y.
  const std::vector<Vertex>& found() const { return found_; }
  /// The guess q of the probability of finding it; `terms` are those of a path that it begins.
  double guess(const PathTerms& terms) const {
    return guide_->guess(found_.data(), chain_length(), lobes_pdf(terms, chain_length()));
  }
  /// Sends a photon from a random point of a light; it is added where it arrives.
  void send_photon(Rng& rng, RayCounts& rays, ManifoldPhotons& photons);
  /// The number of searches until one finds the same again: 1 / p in the mean.
  int find_again(double time, Rng& rng, RayCounts& rays);

 private:
  /// A random chain from x0 through `aim`, with both ends; false if it meets no delta surface.
  bool draw_seed(const Vertex& x0, const Vec3& aim, double time, Rng& rng, RayCounts& rays);
  /// The chain from x0 with these lobes, up to the point next to y; false if there is none.
  bool follow_photon(const Vertex& x0, const ManifoldAim& aim, const SurfacePoint& y, double time,
                     RayCounts& rays);
  bool search(const Vertex& x0, const Vertex& y, double time, Rng& rng, RayCounts& rays);
  bool is_found_again() const;
  int chain_length() const { return static_cast<int>(found_.size()) - 2; }

  const Scene* scene_;
  std::shared_ptr<const ManifoldGuide> guide_;
  std::vector<Vertex> seed_, found_;
  ManifoldWalk walk_;
};

}  // namespace mlt
