#include "path/path_terms.h"

namespace mlt {

void compute_terms(const Scene& scene, const Path& path, const TermSettings& settings,
                   PathTerms& terms) {
  const int k = path.edges();
  terms.vertex.resize(k + 1);
  terms.G.resize(k);
  terms.from_light.resize(k + 1);
  terms.from_camera.resize(k + 1);
  terms.connectable.resize(k + 1);
  update_terms(scene, path, settings, 0, k, terms);
}

void update_terms(const Scene& scene, const Path& path, const TermSettings& settings, int first,
                  int last, PathTerms& terms) {
  const int k = path.edges();
  // Each direction is computed once, for the vertices at both of its ends.
  Vec3 wl = first > 0 ? direction(path[first].at, path[first - 1].at) : Vec3(0);
  for (int i = first; i <= last; ++i) {
    const Vec3 wc = i < k ? direction(path[i].at, path[i + 1].at) : Vec3(0);
    if (i < last) terms.G[i] = geometry(path[i].at, path[i + 1].at, wc);
    terms.connectable[i] = connectable(path[i]);
    terms.vertex[i] = vertex_terms(scene, path[i], wl, wc, settings.strict_normals);
    if (i > 0) terms.from_camera[i - 1] = terms.vertex[i].pdf_from_camera * terms.G[i - 1];
    if (i < k) terms.from_light[i + 1] = terms.vertex[i].pdf_from_light * terms.G[i];
    wl = -wc;
  }
  if (first <= 1) {
    terms.from_light[0] = light_position_pdf(scene, path[0]);
    terms.direct = settings.sample_direct ? direct_position_pdf(scene, path[0], path[1].at)
                                          : terms.from_light[0];
    terms.light_can_be_hit = can_be_hit(scene, path[0]);
  }
  if (last == k) {
    terms.from_camera[k] = camera_position_pdf(scene, path[k]);
    terms.camera_can_be_hit = can_be_hit(scene, path[k]);
  }
}

Color contribution(const PathTerms& terms) {
  Color product = terms.vertex[0].f;
  for (int i = 0; i < terms.edges(); ++i) product *= terms.G[i] * terms.vertex[i + 1].f;
  return product;
}

bool can_sample(const PathTerms& terms, int s) {
  const int k = terms.edges();
  if (s == 0) return terms.light_can_be_hit;
  if (s == k + 1) return terms.camera_can_be_hit;
  return terms.connectable[s - 1] && terms.connectable[s];
}

double technique_density(const PathTerms& terms, int s) {
  if (!can_sample(terms, s)) return 0;
  double p = 1;
  for (int i = 0; i < s; ++i) p *= i == 0 && s == 1 ? terms.direct : terms.from_light[i];
  for (int i = s; i <= terms.edges(); ++i) p *= terms.from_camera[i];
  return p;
}

double mis_weight(const PathTerms& terms, int s, Heuristic heuristic) {
  if (!can_sample(terms, s)) return 0;
  return mis_weight(terms.from_light.data(), terms.from_camera.data(), terms.connectable.data(),
                    terms.edges(), s, terms.direct, terms.light_can_be_hit, terms.camera_can_be_hit,
                    heuristic);
}

double mis_weight(const double* from_light, const double* from_camera, const char* connectable,
                  int edges, int s, double direct, bool light_can_be_hit, bool camera_can_be_hit,
                  Heuristic heuristic) {
  const int k = edges;
  const double direct_over_walk = direct / from_light[0];
  const double own =
      s == 1 ? direct_over_walk : 1.0;  // p_s, in units of its density by walks alone
  double sum = own * own, sum_balance = own;
  bool largest = true;
  const auto add = [&](double ratio, int i) {
    if (i == 1) ratio *= direct_over_walk;
    sum += ratio * ratio;
    sum_balance += ratio;
    if (ratio > own || (ratio == own && i < s)) largest = false;
  };
  double ratio = 1;  // p_i / p_s
  for (int i = s - 1; i >= 0 && ratio > 0; --i) {
    ratio *= from_camera[i] / from_light[i];
    if (i == 0 ? light_can_be_hit : connectable[i - 1] && connectable[i]) add(ratio, i);
  }
  ratio = 1;
  for (int i = s + 1; i <= k + 1 && ratio > 0; ++i) {
    ratio *= from_light[i - 1] / from_camera[i - 1];
    if (i == k + 1 ? camera_can_be_hit : connectable[i - 1] && connectable[i]) add(ratio, i);
  }
  switch (heuristic) {
    case Heuristic::balance: return own / sum_balance;
    case Heuristic::power: return own * own / sum;
    case Heuristic::maximum: break;
  }
  return largest ? 1.0 : 0.0;
}

}  // namespace mlt
