// The terms of a finished path. Contribution, technique densities and MIS weights are short products
// of these; each function below is one formula.
//
// Notation (Veach 1997, ch. 8 and 10): path x = x_0 ... x_k; technique (s, t) makes the first s vertices by
// a walk from the light and the last t by a walk from the camera, s + t = k + 1, and connects
// x_{s-1} with x_s.
#pragma once

#include "path/path.h"

#include <vector>

namespace mlt {

struct PathTerms {
  std::vector<VertexTerms> vertex;  ///< f_i and the two coefficients, i = 0 ... k.
  std::vector<double> G;            ///< G_i = G(x_i, x_{i+1}), i = 0 ... k - 1; without visibility.
  std::vector<double> from_light;   ///< Density of x_i made by a light walk, in the measure of x_i.
  std::vector<double> from_camera;  ///< The same for a camera walk.
  std::vector<char> connectable;    ///< Whether an edge may be made by connection at x_i.
  bool light_can_be_hit = false, camera_can_be_hit = false;
  /// Density of x_0 in the technique s = 1, which may choose it to be seen from x_1.
  double direct = 0;

  int edges() const { return static_cast<int>(G.size()); }
};

struct TermSettings {
  bool sample_direct = true;  ///< Technique s = 1 chooses x_0 as seen from x_1.
  bool strict_normals = false;
};

/// All terms, from the vertices alone. `terms` keeps its memory.
void compute_terms(const Scene& scene, const Path& path, const TermSettings& settings,
                   PathTerms& terms);

/// Brings the terms up to date after vertices first ... last, or a neighbour of theirs, have changed:
/// computes anew the terms of these vertices, the edges between them, and the densities that follow.
void update_terms(const Scene& scene, const Path& path, const TermSettings& settings, int first,
                  int last, PathTerms& terms);

/// f(x) = f_0 G_0 f_1 G_1 ... G_{k-1} f_k (Veach 1997, eq. 8.7), without visibility.
Color contribution(const PathTerms& terms);

/// Can technique s make the path? Only if neither end of the connecting edge is a delta vertex;
/// s = 0 needs a light, s = k + 1 a lens, that a walk can hit.
bool can_sample(const PathTerms& terms, int s);

/// p_{s,t}(x), the density of technique s in the product-area measure (Veach 1997, sec. 10.2).
double technique_density(const PathTerms& terms, int s);

enum class Heuristic { balance, power, maximum };

/// The MIS weight of technique s (Veach 1997, eqs. 9.8, 9.13 with beta = 2, 9.12).
double mis_weight(const PathTerms& terms, int s, Heuristic heuristic);

/// The MIS weight from the density arrays: r_i = p_i / p_s by the recurrence of Veach 1997, eq. 10.9,
/// p_{i+1} / p_i = from_light[i] / from_camera[i]. `direct` is the density of x_0 in technique 1.
double mis_weight(const double* from_light, const double* from_camera, const char* connectable,
                  int edges, int s, double direct, bool light_can_be_hit, bool camera_can_be_hit,
                  Heuristic heuristic);

}  // namespace mlt
