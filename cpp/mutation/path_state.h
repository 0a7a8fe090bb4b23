// The state of Metropolis light transport: a light path with its terms and its target L*.
#pragma once

#include "base/kept.h"
#include "markov/mixture.h"
#include "mutation/image_footprint.h"
#include "path/measure.h"

#include <vector>

namespace mlt {

/// What a mutation does to a path: vertices first ... last are deleted (none if last = first - 1)
/// and `inserted` new ones take their place.
struct Edit {
  int first = 0, last = -1, inserted = 0;

  int deleted() const { return last - first + 1; }
  int shift() const { return inserted - deleted(); }
  Edit reversed() const { return {first, first + inserted - 1, deleted()}; }
};

struct PathState {
  Path path;
  PathTerms terms;
  Vec2 raster{0};
  Color rgb{0};       ///< f(x) / |f(x)|, see relative_contribution.
  double target = 0;  ///< L*(x) / |f(x)|, times the factor of two-stage sampling.

  // Functions of the path, kept by those who ask for them:
  mutable MoveChoice choice;                              ///< Of the mixture that moves it.
  mutable Kept<double> over_density;                      ///< See PathTarget.
  mutable Kept<std::optional<ImageFootprint>> footprint;  ///< Of its caustic perturbation.

  /// L*(x), times that factor. May overflow or underflow; chains do without it.
  double brightness() const { return target * magnitude(terms, 0, edges()); }

  int edges() const { return path.edges(); }
  const Vertex& operator[](size_t i) const { return path[i]; }
  bool specular(int i) const { return terms[i].specular; }  ///< S, not D, of inner vertex i.
};

/// y becomes x with the edit applied; the inserted vertices and their terms are yet to be filled
/// in.
void splice(const PathState& x, const Edit& edit, PathState& y);

}  // namespace mlt
