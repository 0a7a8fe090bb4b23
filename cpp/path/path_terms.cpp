#include "path/path_terms.h"

namespace mlt {
namespace {

/// The least |f_i| that is not black: in the tail of a lobe, products of 1 / |f_i| might overflow.
constexpr double least_f = 1e-100;

double inverse_size(const Spectrum& f) {
  const double size = max_component(f);
  return size > least_f ? 1 / size : 0;
}

/// The likelihoods of walks along the whole path, from either end.
void find_likelihoods(PathTerms& terms) {
  const int k = terms.edges();
  for (int i = 1; i < k; ++i) terms.passages[i].from_light.likelihood = terms.likelihood(i, 1);
  for (int i = k - 1; i > 0; --i)
    terms.passages[i - 1].from_camera.likelihood = terms.likelihood(i, -1);
}

/// Finds the passages of the edges at vertices first ... last, unless a vertex is black, and
/// includes those of all edges at vertices begin ... end in the terms. Not inlined: update_terms
/// would become too large for what it needs in each scene.
[[gnu::noinline]] void include_passages(const Scene& scene, const Path& path, int first, int last,
                                        int begin, int end, PathTerms& terms) {
  const int k = path.edges();
  terms.passages.resize(k + 1);
  bool lit = true;
  for (int i = begin; i <= end; ++i) lit = lit && terms[i].inverse_f > 0;
  for (int i = std::max(first - 1, 0); i <= std::min(last, k - 1); ++i) {
    const SurfacePoint &a = path[i].at, &b = path[i + 1].at;
    const Passage edge = lit ? scene.passage(a, b, path.time) : Passage::blocked();
    terms.passages[i] = {scene, a, b, edge, i + 1 == k};
  }
  if (scene.has_coloured_media()) find_likelihoods(terms);
  for (int i = begin; i <= end; ++i) {
    VertexTerms& x = terms[i].vertex;
    if (i < k) {
      x.f *= terms.passages[i].transmittance;
      x.pdf_from_light *= terms.passages[i].from_light.probability();
      terms[i + 1].from_light = x.pdf_from_light * terms[i].G;
    }
    if (i > 0) {
      x.pdf_from_camera *= terms.passages[i - 1].from_camera.probability();
      terms[i - 1].from_camera = x.pdf_from_camera * terms[i - 1].G;
    }
    terms[i].inverse_f = inverse_size(x.f);
  }
}

/// How often technique s counts in TechniqueSums.
double technique_count(const PathTerms& terms, int s) {
  if (!can_sample(terms, s)) return 0;
  return s == 1 ? terms.direct / terms[0].from_light : 1;
}

/// The sums over the techniques with fewer than s vertices from the light, and with more.
std::pair<TechniqueSums, TechniqueSums> other_techniques(const PathTerms& terms, int s,
                                                         const ExtraTechnique& extra) {
  const auto with = [&](const TechniqueSums& sums, int i) {
    return sums.with(technique_count(terms, i)).with(i == extra.s ? extra.count : 0);
  };
  TechniqueSums below, above;
  for (int i = 0; i < s; ++i)
    below = with(below, i).over(terms[i].from_camera / terms[i].from_light);
  for (int i = terms.edges(); i >= s; --i)
    above = with(above, i + 1).over(terms[i].from_light / terms[i].from_camera);
  return {below, above};
}

}  // namespace

void compute_terms(const Scene& scene, const Path& path, const TermSettings& settings,
                   PathTerms& terms) {
  const int k = path.edges();
  terms.at.resize(k + 1);
  update_terms(scene, path, settings, 0, k, terms);
}

void update_terms(const Scene& scene, const Path& path, const TermSettings& settings, int first,
                  int last, PathTerms& terms) {
  // In coloured media densities depend on all that a walk has flown before.
  const bool whole = scene.has_coloured_media();
  const int k = path.edges(), begin = whole ? 0 : std::max(0, first - 1),
            end = whole ? k : std::min(k, last + 1);
  const Vertex* vertices = path.vertices.data();
  TermsAt* at = terms.at.data();
  const bool passages = scene.has_passages();
  // The terms of a light at infinity do not depend on its neighbour.
  const bool same_light = first > 0 && vertices[0].at.infinite() && !passages;
  Vec3 wl = begin > 0 ? terms.direction(begin, -1) : Vec3(0);
  for (int i = begin; i <= end; ++i) {
    const Vertex& vertex = vertices[i];
    TermsAt& x = at[i];
    if (i < end) find_edge(vertex.at, vertices[i + 1].at, x);
    const Vec3 wc = i < k ? x.w : Vec3(0);
    if (i > 0 || !same_light) {
      x.connectable = connectable(vertex);
      x.specular = is_specular(scene, vertex, wl, wc, settings.near_specular);
      if (i < k) {
        x.vertex = vertex_terms(scene, vertex, wl, wc, settings.strict_normals);
      } else {
        const LensTerms lens = lens_terms(scene, vertex.at, wl);
        x.vertex = lens.vertex;
        terms.raster = lens.raster;
      }
      x.inverse_f = inverse_size(x.vertex.f);
    }
    if (i > 0) at[i - 1].from_camera = x.vertex.pdf_from_camera * at[i - 1].G;
    if (i < k) at[i + 1].from_light = x.vertex.pdf_from_light * x.G;
    wl = -wc;
  }
  terms.wavelength = path.wavelength;
  if (passages) include_passages(scene, path, first, last, begin, end, terms);
  if (first == 0) {
    at[0].from_light = light_position_pdf(scene, vertices[0]);
    terms.light_can_be_hit = can_be_hit(scene, vertices[0]);
    terms.light_in_medium = vertices[0].at.in_medium();
  }
  if (begin == 0 && !same_light)
    terms.direct = settings.sample_direct && !vertices[0].at.infinite()
                       ? direct_position_pdf(scene, vertices[0], vertices[1].at)
                       : at[0].from_light;
  if (last == k) {
    at[k].from_camera = camera_position_pdf(scene, vertices[k]);
    terms.camera_can_be_hit = can_be_hit(scene, vertices[k]);
  }
}

std::string signature(const PathTerms& terms) {
  std::string letters = "L";
  for (int i = 1; i < terms.edges(); ++i) letters += terms[i].specular ? 'S' : 'D';
  return letters + 'E';
}

std::string signature(const Scene& scene, const Path& path, double near_specular) {
  PathTerms terms;
  compute_terms(scene, path, {true, false, near_specular}, terms);
  return signature(terms);
}

Color contribution(const PathTerms& terms) {
  Spectrum product = terms[0].vertex.f;
  for (int i = 0; i < terms.edges(); ++i) product *= terms[i].G * terms[i + 1].vertex.f;
  return recorded(product, terms.wavelength, terms.dispersed());
}

double magnitude(const PathTerms& terms, int i, int j) {
  double product = max_component(terms[i].vertex.f);
  for (; i < j; ++i) product *= terms[i].G * max_component(terms[i + 1].vertex.f);
  return product;
}

Color relative_contribution(const PathTerms& terms) {
  Spectrum product(1);
  for (const TermsAt& x : terms.at) product *= x.vertex.f * x.inverse_f;
  return recorded(product, terms.wavelength, terms.dispersed());
}

double technique_density(const PathTerms& terms, int s) {
  if (!can_sample(terms, s)) return 0;
  double p = 1;
  for (int i = 0; i < s; ++i) p *= i == 0 && s == 1 ? terms.direct : terms[i].from_light;
  for (int i = s; i <= terms.edges(); ++i) p *= terms[i].from_camera;
  return p;
}

double certainty(const PathTerms& terms) {
  if (terms.light_in_medium) return 0;
  double p = terms.arrival(terms.edges(), -1).probability();
  for (int i = 1; i < terms.edges(); ++i)
    p *= terms[i].connectable ? 0 : terms[i].vertex.pdf_from_camera;
  return p;
}

MisWeights mis_weights(const PathTerms& terms, int s, Heuristic heuristic,
                       const ExtraTechnique& extra) {
  const double own = technique_count(terms, s);
  if (own == 0) return {};
  auto [below, above] = other_techniques(terms, s, extra);
  if (s == extra.s) below = below.with(extra.count);
  return mis_weights(own, below, above, heuristic);
}
MisWeights mis_weights(const PathTerms& terms, const ExtraTechnique& extra, Heuristic heuristic) {
  const auto [below, above] = other_techniques(terms, extra.s, extra);
  return mis_weights(extra.count, below.with(technique_count(terms, extra.s)), above, heuristic);
}

int sample_technique(const PathTerms& terms, Heuristic heuristic, double u) {
  int last = -1;
  for (int s = 0; s <= terms.edges() + 1; ++s) {
    const double weight = mis_weight(terms, s, heuristic);
    if (!(weight > 0)) continue;
    last = s;
    if ((u -= weight) < 0) break;
  }
  return last;
}

}  // namespace mlt
