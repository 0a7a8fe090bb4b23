// The state of Metropolis light transport: a light path with its terms and its target L*.
#pragma once

#include "base/cached.h"
#include "markov/mixture.h"
#include "mutation/image_footprint.h"
#include "path/measure.h"

#include <vector>

namespace mlt {

/// The change of a path by a mutation: vertices first ... last are deleted (none if last = first -
/// 1) and replaced by `inserted` new ones.
struct Edit {
  int first = 0, last = -1, inserted = 0;

  int deleted() const { return last - first + 1; }
  int shift() const { return inserted - deleted(); }
  Edit reversed() const { return {first, first + inserted - 1, deleted()}; }
};

/// The specular chains next to the lens, along which a perturbation of the image position moves.
struct CameraChains {
  /// The diffuse vertex that is connected to the rest; 0: a light that is hit; -1: neither.
  int stop = -1;
  int further = 0;  ///< Number of chains beyond the first diffuse vertex.

  bool operator==(const CameraChains& other) const {
    return stop == other.stop && further == other.further;
  }
};

struct PathState {
  Path path;
  PathTerms terms;
  Vec2 raster{0};
  Color rgb{0};       ///< f(x) / |f(x)|, see relative_contribution.
  double target = 0;  ///< T'(x) / |f(x)|, see PathTarget.

  /// Functions of the path, cached when first evaluated.
  struct Known {
    Cached<double> over_density, over_starts;         ///< See PathTarget.
    Cached<std::optional<ImageFootprint>> footprint;  ///< For the caustic perturbation.
    Cached<CameraChains> camera_chains;
    Cached<int> triples;       ///< Number of triples that the manifold perturbation may move.
    Cached<int> propagations;  ///< Number of ways in which the propagation may move a vertex.
    Cached<int> translucent;   ///< The vertex at which the translucent perturbation ends, or -1.

    void invalidate() {
      over_density.invalidate();
      over_starts.invalidate();
      footprint.invalidate();
      camera_chains.invalidate();
      triples.invalidate();
      propagations.invalidate();
      translucent.invalidate();
    }
  };
  mutable Known known;
  mutable MoveChoice choice;  ///< Cached by the mixture that moves the path.

  /// T'(x). May over- or underflow; chains do not need it.
  double brightness() const { return target * magnitude(terms, 0, edges()); }

  int edges() const { return path.edges(); }
  const Vertex& operator[](size_t i) const { return path[i]; }
  bool specular(int i) const { return terms[i].specular; }  ///< Whether inner vertex i is S, not D.
};

/// Whether light is scattered in the same ways at vertices first ... last of x and of y.
inline bool same_form(const PathState& x, const PathState& y, int first, int last) {
  for (int i = first; i <= last; ++i)
    if (x.specular(i) != y.specular(i) || x[i].lobe != y[i].lobe) return false;
  return true;
}

/// Sets y to x with the edit applied; the inserted vertices and their terms are yet to be filled
/// in.
void splice(const PathState& x, const Edit& edit, PathState& y);

}  // namespace mlt
