// The state of Metropolis light transport: a light path with its terms and its target L*.
#pragma once

#include "mutation/target_map.h"
#include "path/path_terms.h"

#include <vector>

namespace mlt {

/// What a mutation does to a path: vertices first ... last are deleted (none if last = first - 1) and
/// `inserted` new ones take their place.
struct Edit {
  int first, last, inserted;

  int deleted() const { return last - first + 1; }
  int shift() const { return inserted - deleted(); }
  Edit reversed() const { return {first, first + inserted - 1, deleted()}; }
};

struct MutationSettings {
  int max_depth = -1;
  int min_depth = 1;               ///< Shorter paths carry no light: they are rendered apart.
  const TargetMap* map = nullptr;  ///< Two-stage sampling: a factor of the target.
  bool hide_emitters = false;
  bool strict_normals = false;
  /// Smooth vertices below this roughness count as specular in signatures.
  double near_specular = 0.1;
  /// Radii between which the image position is perturbed: pixels, and a share of the image's diagonal.
  double smallest_pixels = 0.1, largest_share = 0.1;
};

struct PathState {
  Path path;
  PathTerms terms;
  Vec2 raster{0};
  Color rgb{0};       ///< f(x), Veach 1997, eq. 8.7
  double target = 0;  ///< L*(x), times the factor of two-stage sampling

  int edges() const { return path.edges(); }
  const Vertex& operator[](size_t i) const { return path[i]; }
  bool specular(int i) const { return terms[i].specular; }  ///< S, not D, of inner vertex i.
};

/// y becomes x with the edit applied; the inserted vertices and their terms are yet to be filled in.
void splice(const PathState& x, const Edit& edit, PathState& y);

/// Computes what depends on vertices first ... last and their neighbours, then f and L*. Without
/// visibility. target = 0 if the path carries no light or misses the image.
void evaluate(const Scene& scene, const MutationSettings& settings, int first, int last,
              PathState& x);
/// The same for a path of which nothing has been computed yet.
void evaluate(const Scene& scene, const MutationSettings& settings, PathState& x);

}  // namespace mlt
