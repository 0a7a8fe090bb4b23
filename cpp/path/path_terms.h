// The terms of a finished path. Contribution, technique densities and MIS weights are short
// products of these; each function below is one formula.
//
// Notation (Veach 1997, ch. 8 and 10): path x = x_0 ... x_k; technique (s, t) makes the first s
// vertices by a walk from the light and the last t by a walk from the camera, s + t = k + 1, and
// connects x_{s-1} with x_s.
#pragma once

#include "path/mis.h"
#include "path/path.h"

#include <algorithm>
#include <string>
#include <vector>

namespace mlt {

/// The densities with which the techniques make x_i.
struct VertexDensities {
  double from_light = 0;     ///< Density of x_i made by a light walk, in the measure of x_i.
  double from_camera = 0;    ///< Density of x_i made by a camera walk.
  bool connectable = false;  ///< Whether an edge may be made by connection at x_i.
};

/// An edge, seen from its end on the light side.
struct Edge {
  Vec3 w{0};            ///< Unit direction.
  double distance = 0;  ///< Infinite where one end is at infinity.
  double G = 0;         ///< G(a, b), without visibility.
};
/// Computes an edge in place: copying the struct right after its members are stored would stall.
inline void find_edge(const SurfacePoint& a, const SurfacePoint& b, Edge& edge) {
  if (a.infinite() || b.infinite()) {
    edge.w = direction(a, b);
    edge.distance = infinity;
    edge.G = geometry(a, b, edge.w);
    return;
  }
  const Vec3 ab = b.p - a.p;
  const double distance2 = length_squared(ab), distance = std::sqrt(distance2);
  const Vec3 w = ab * (1 / distance);
  edge.w = w;
  edge.distance = distance;
  edge.G = abs_cos(a, w) * abs_cos(b, w) / distance2;
}
inline Edge edge_between(const SurfacePoint& a, const SurfacePoint& b) {
  Edge edge;
  find_edge(a, b, edge);
  return edge;
}

/// The terms of x_i, and of the edge from x_i to x_{i+1} (i < k).
struct TermsAt : VertexDensities, Edge {
  bool specular = false;  ///< S or D (see signature) by `TermSettings::near_specular`.
  VertexTerms vertex;     ///< f_i and the two coefficients.
  /// 1 / |f_i|, where |f_i| is the largest component; 0 if that is (almost) 0.
  double inverse_f = 0;
};

/// The light that goes straight along an edge, and the arrivals of walks from either end at the
/// other. A light walk goes through the lens, whatever lies before or behind it.
struct EdgePassage {
  EdgePassage() = default;
  /// The passage along the edge from a to b, which is on the lens if `to_lens`.
  EdgePassage(const Scene& scene, const SurfacePoint& a, const SurfacePoint& b, const Passage& edge,
              bool to_lens)
      : transmittance(edge.transmittance) {
    const Vec3 w = direction(a, b);
    from_camera = scene.arrival(edge, a, -w);
    if (!to_lens) from_light = scene.arrival(edge, b, w);
  }

  Spectrum transmittance{1};
  Arrival from_light, from_camera;
};

/// The terms include what surfaces and media let pass on the way to the next vertex: f_i the
/// transmittance of edge i, a coefficient the probability of arriving at the next vertex.
struct PathTerms {
  std::vector<TermsAt> at;  ///< i = 0 ... k.
  /// Passages of the edges from x_i to x_{i+1}; empty in scenes without passages.
  std::vector<EdgePassage> passages;
  bool light_can_be_hit = false, camera_can_be_hit = false, light_in_medium = false;
  /// Density of x_0 in the technique s = 1, which may sample it for x_1.
  double direct = 0;
  std::optional<Vec2> raster;  ///< Raster position; nullopt if the path misses the image.
  double wavelength = rgb_lanes;

  int edges() const { return static_cast<int>(at.size()) - 1; }  ///< k
  /// Whether any vertex disperses (see Scattering).
  bool dispersed() const {
    return std::any_of(at.begin(), at.end(), [](const TermsAt& x) { return x.vertex.disperses; });
  }
  /// Unit direction at x_i towards x_{i + step}, where step is 1 or -1.
  Vec3 direction(int i, int step) const { return step > 0 ? at[i].w : -at[i - 1].w; }
  /// The arrival at x_{i + step} of a walk from x_i.
  Arrival arrival(int i, int step) const {
    if (passages.empty()) return {};
    return step > 0 ? passages[i].from_light : passages[i - 1].from_camera;
  }
  /// The likelihood of a walk that has come to x_i in steps of `step`.
  Spectrum likelihood(int i, int step) const {
    const int previous = i - step;
    if (previous < 0 || previous > edges()) return Spectrum(1);
    return arrival(previous, step).next_likelihood();
  }
  TermsAt& operator[](size_t i) { return at[i]; }
  const TermsAt& operator[](size_t i) const { return at[i]; }
};

struct TermSettings {
  bool sample_direct = true;  ///< Technique s = 1 samples x_0 for x_1.
  bool strict_normals = false;
  double near_specular = 0;  ///< Smooth vertices below this roughness count as specular.
};

/// Computes all terms, from the vertices alone. The buffers of `terms` are reused.
void compute_terms(const Scene& scene, const Path& path, const TermSettings& settings,
                   PathTerms& terms);

/// Brings the terms up to date after vertices first ... last (none if last = first - 1: an edge)
/// have changed: computes anew what depends on these vertices, on the edges that touch them, and on
/// the densities that follow.
void update_terms(const Scene& scene, const Path& path, const TermSettings& settings, int first,
                  int last, PathTerms& terms);

/// Heckbert's notation: L, then D or S for each inner vertex, then E. A smooth vertex counts as S
/// when its roughness between its two directions is below `near_specular`.
std::string signature(const PathTerms& terms);
std::string signature(const Scene& scene, const Path& path, double near_specular = 0);

/// f(x) = f_0 G_0 f_1 G_1 ... G_{k-1} f_k (Veach 1997, eq. 8.7), without visibility, as a film
/// records it.
Color contribution(const PathTerms& terms);

/// |f_i| G_i |f_{i+1}| ... |f_j|; of a whole path it is |f(x)|, which may overflow or underflow.
double magnitude(const PathTerms& terms, int i, int j);
/// f(x) / |f(x)|: a colour, whatever the length of the path and the scale of the scene.
Color relative_contribution(const PathTerms& terms);

/// Whether technique s can make the path: only if neither end of the connecting edge is a delta
/// vertex; s = 0 needs a light, s = k + 1 a lens, that a walk can hit.
inline bool can_sample(const PathTerms& terms, int s) {
  if (s == 0) return terms.light_can_be_hit;
  if (s > terms.edges()) return terms.camera_can_be_hit;
  return terms[s - 1].connectable && terms[s].connectable;
}

/// p_{s,t}(x), the density of technique s in the product-area measure (Veach 1997, sec. 10.2).
double technique_density(const PathTerms& terms, int s);

/// A technique beside those of can_sample (manifold_sampler.h, refracted_light.h): it makes the
/// path with s vertices from the light, and counts `count` times in TechniqueSums. s = -1: none.
struct ExtraTechnique {
  int s = -1;
  double count = 0;
};

/// The probability that a walk from the camera chooses these lobes, if all of them are delta; else
/// 0. Where a walk stops in a medium that glows is never certain.
double certainty(const PathTerms& terms);

/// The MIS weights of technique s (Veach 1997, eqs. 9.8, 9.13 with beta = 2, 9.12), and those of
/// the extra one.
MisWeights mis_weights(const PathTerms& terms, int s, Heuristic heuristic,
                       const ExtraTechnique& extra = {});
MisWeights mis_weights(const PathTerms& terms, const ExtraTechnique& extra, Heuristic heuristic);
inline double mis_weight(const PathTerms& terms, int s, Heuristic heuristic) {
  return mis_weights(terms, s, heuristic).chosen;
}
/// A technique s with the probability of its MIS weight; -1 if none can make the path.
int sample_technique(const PathTerms& terms, Heuristic heuristic, double u);

}  // namespace mlt
