#include "path/bidirectional_sampler.h"

#include "path/joined_edge.h"

namespace mlt {

/// The density of x_0 in technique s = 1 over that of a walk that starts there.
double BidirectionalSampler::direct_over_walk(const Vertex& x0, double from_light,
                                              const SurfacePoint& x1) const {
  return settings_.sample_direct ? direct_position_pdf(*scene_, x0, x1) / from_light : 1;
}

bool BidirectionalSampler::weigh(Connection& connection, double own, const TechniqueSums& below,
                                 const TechniqueSums& above, double survival) const {
  const MisWeights weights = mis_weights(own, below, above, settings_.heuristic);
  connection.weight = weights.chosen;
  connection.own_share = weights.balance * survival;
  connection.survival = survival;
  return connection.weight > 0;
}

double BidirectionalSampler::certainty_of_hit_light(int t) const {
  double p = camera_[t - 1].vertex.at.in_medium() ? 0 : camera_[1].passes;
  for (int i = 1; i < t - 1; ++i)
    p *= connectable(camera_[i].vertex) ? 0 : camera_[i].next_coefficient * camera_[i + 1].passes;
  return p;
}

double BidirectionalSampler::certainty_of_hit_lens(int s, const Arrival& from_lens) const {
  double p = light_[0].vertex.at.in_medium() ? 0 : from_lens.probability();
  Spectrum likelihood = from_lens.next_likelihood();
  for (int i = s - 2; i > 0 && p > 0; --i)
    p *= connectable(light_[i].vertex)
             ? 0
             : light_[i - 1].reverse / light_[i].G * fly_back(*scene_, light_[i], likelihood);
  return p;
}

/// s = 0: the camera walk has hit a light.
bool BidirectionalSampler::evaluate_hit_light(Connection& connection, RayCounts& rays) {
  const int t = connection.t;
  const WalkVertex& end = camera_[t - 1];
  const Vertex x0 = light_vertex(*connection.emitter, end.vertex.at);
  if (!can_be_hit(*scene_, x0)) return false;
  const VertexTerms terms = vertex_terms(*scene_, x0, end.towards_previous, end.towards_previous,
                                         settings_.rules.strict_normals);
  connection.contribution = recorded(end.throughput * terms.f, wavelength_, end.dispersed);
  if (is_black(connection.contribution)) return false;
  connection.certainty = certainty_of_hit_light(t);
  const double from_light = light_position_pdf(*scene_, x0);
  const double direct = direct_over_walk(x0, from_light, camera_[t - 2].vertex.at);
  Spectrum likelihood(1);
  const double flown = fly_back(*scene_, end, likelihood);
  const double reverse = end.density_back(terms.pdf_from_light) * flown;
  const TechniqueSums above = above_camera(t - 2, reverse, likelihood)
                                  .with(direct * camera_technique(t - 1, true))
                                  .over(from_light / end.forward)
                                  .with(manifold_over_hit_light(x0, from_light, t))
                                  .with(refracted_over_hit_light(x0, t, rays));
  return weigh(connection, 1, {}, above, end.survival);
}

/// See above; a Lambertian vertex has its density `back`, so the walk has computed the sums
/// already.
inline TechniqueSums BidirectionalSampler::below_joint(int i, const WalkVertex& x, double back,
                                                       Spectrum likelihood) const {
  if (x.joint.known && !scene_->has_coloured_media()) return light_sums_[i];
  if (i == 0) return TechniqueSums().with(can_be_hit(*scene_, x.vertex) ? 1 : 0);
  const double flown = fly_back(*scene_, x, likelihood);
  return below_light(i - 1, x.density_back(back) * flown, likelihood)
      .with(light_techniques(i, true));
}
inline TechniqueSums BidirectionalSampler::above_joint(int i, const WalkVertex& x, double back,
                                                       Spectrum likelihood) const {
  if (x.joint.known && !scene_->has_coloured_media()) return camera_sums_[i];
  if (i == 0) return TechniqueSums().with(camera_technique(i, true));
  const double flown = fly_back(*scene_, x, likelihood);
  return above_camera(i - 1, x.density_back(back) * flown, likelihood)
      .with(camera_technique(i, true));
}

/// s >= 1, t >= 1: the last vertices of the two subpaths see each other.
bool BidirectionalSampler::evaluate_connection(Connection& connection, RayCounts& rays) {
  const int s = connection.s, t = connection.t, k = s + t - 1;
  const bool direct = is_direct(s), strict = settings_.rules.strict_normals;
  const WalkVertex& b = camera_[t - 1];
  if (b.vertex.at.infinite()) return false;
  if (direct ? !choose_direct(t) : s > static_cast<int>(light_.size())) return false;
  const WalkVertex& a = direct ? direct_ : light_[s - 1];
  // A pinhole does not show a light of no size.
  if (k == 1 && scene_->camera().delta_position() && !can_be_hit(*scene_, a.vertex)) return false;

  JoinedEdge joined;
  if (!joined.find(*scene_, a, b, strict)) return false;
  auto& [edge, at_a, at_b, light, raster] = joined;
  if (t == 1) connection.raster = raster;
  const Passage seen = walker(rays).passage(a.vertex.at, b.vertex.at);
  if (seen.is_blocked()) return false;
  connection.certainty = k == 1 && !a.vertex.at.in_medium() ? 1 : 0;
  Spectrum light_likelihood(1), camera_likelihood(1);
  if (scene_->has_passages()) {
    const EdgePassage ends(*scene_, a.vertex.at, b.vertex.at, seen, t == 1);
    const Arrival from_light = ends.from_light.after(a.likelihood),
                  from_camera = ends.from_camera.after(b.likelihood);
    light_likelihood = from_light.next_likelihood();
    camera_likelihood = from_camera.next_likelihood();
    light *= ends.transmittance;
    at_a.onwards *= from_light.probability();
    at_b.onwards *= from_camera.probability();
    connection.certainty *= from_camera.probability();
  }
  connection.contribution = recorded(light, wavelength_, at_a.dispersed || at_b.dispersed);

  const TechniqueSums below =
      below_joint(s - 1, a, at_a.back, camera_likelihood).over(at_b.onwards * edge.G / a.forward);
  TechniqueSums above = above_joint(t - 1, b, at_b.back, light_likelihood);
  if (refracts_ && s == 1 && t >= 3)
    above = above.with(refracted_over(a.forward * at_a.onwards * edge.G, a.vertex, b.vertex,
                                      camera_[t - 2].vertex, rays));
  above = above.over(at_a.onwards * edge.G / b.forward);
  if (refracts_ && s == 2)
    above = above.with(
        refracted_over(light_[0].forward * a.forward, light_[0].vertex, a.vertex, b.vertex, rays));
  return weigh(connection, direct ? direct_pdf_ / a.forward : 1, below, above,
               a.survival * b.survival);
}

void BidirectionalSampler::sample_backgrounds() {
  direct_backgrounds_.resize(camera_.size());
  for (size_t i = 0; i < camera_.size(); ++i) {
    LightSample& light = direct_backgrounds_[i];
    Vec3 u = direct_u_[i];
    const EmitterChoice choice = scene_->choose_emitter_for(camera_[i].vertex.at.p, u.x);
    light.emitter = nullptr;
    if (choice.emitter->infinite()) backgrounds_.add(choice, {u.y, u.z}, time_, wavelength_, light);
  }
  backgrounds_.sample_all(*scene_);
}

/// Samples x_0 for camera vertex t - 1 (next-event estimation).
bool BidirectionalSampler::choose_direct(int t) {
  const bool sampled = !direct_backgrounds_.empty() && direct_backgrounds_[t - 1].emitter;
  const LightSample chosen =
      sampled ? direct_backgrounds_[t - 1]
              : sample_direct_position(*scene_, camera_[t - 1].vertex.at, direct_u_[t - 1]);
  direct_pdf_ = chosen.x0.pdf;
  if (!(direct_pdf_ > 0)) return false;
  direct_.vertex = light_vertex(*chosen.emitter, chosen.x0.at);
  direct_.throughput = Spectrum(1 / direct_pdf_);
  // The density on a light at infinity does not depend on x_1.
  direct_.forward =
      chosen.emitter->infinite() ? direct_pdf_ : light_position_pdf(*scene_, direct_.vertex);
  return true;
}

/// t = 0: the light walk passes through the lens after its vertex s - 2.
bool BidirectionalSampler::evaluate_hit_lens(Connection& connection, RayCounts& rays) {
  const int s = connection.s, k = s - 1;
  const WalkVertex& last = light_[s - 2];
  if (last.absorbed() || !lens_can_be_hit_) return false;
  const bool passages = scene_->has_passages();
  const Ray ray =
      s == 2 ? light_.first_ray() : walker(rays).leave(last.vertex.at, last.towards_next);
  auto hit = scene_->camera().hit_lens(ray);
  if (!hit) return false;
  hit->wavelength = wavelength_;
  if (!passages && s <= static_cast<int>(light_.size()) &&
      length_squared(hit->p - ray.o) >= length_squared(light_[s - 1].vertex.at.p - ray.o))
    return false;
  lens_ = camera_vertex(*hit);
  const auto [terms, raster] = lens_terms(*scene_, *hit, -last.towards_next);
  if (is_black(terms.f) || !raster) return false;
  connection.raster = *raster;
  const Spectrum light = last.next_throughput * terms.f;
  if (is_black(light)) return false;
  Passage seen;
  const bool traced = !light_.goes_on() || s - 1 < static_cast<int>(light_.size());
  if (passages || !traced) seen = walker(rays).passage(last.vertex.at, *hit);
  if (seen.is_blocked()) return false;
  const EdgePassage edge =
      passages ? EdgePassage(*scene_, last.vertex.at, *hit, seen, true) : EdgePassage();
  connection.contribution = recorded(light * edge.transmittance, wavelength_, last.next_dispersed);
  connection.certainty = certainty_of_hit_lens(s, edge.from_camera);
  const double G = geometry(last.vertex.at, *hit);
  const double before_lens = !connectable(last.vertex) ? manifold_count(k - 1, lens_)
                             : k == 1 ? direct_over_walk(last.vertex, last.forward, *hit)
                                      : 1;
  const double reverse = terms.pdf_from_camera * G * edge.from_camera.probability();
  const TechniqueSums below =
      below_light(k - 1, reverse, edge.from_camera.next_likelihood())
          .with(before_lens)
          .over(camera_position_pdf(*scene_, lens_) / (last.next_coefficient * G));
  return weigh(connection, 1, below, {}, last.next_survival);
}

void BidirectionalSampler::assemble(const Connection& connection, Path& path) const {
  const int s = connection.s, t = connection.t;
  if (connection.assembled) {
    path = assembled_;
    return;
  }
  path.vertices.clear();
  path.time = time_;
  path.wavelength = wavelength_;
  const int lights = t == 0 ? s - 1 : s;
  for (int i = 0; i < lights; ++i)
    path.vertices.push_back(is_direct(s) ? direct_.vertex : light_[i].vertex);
  if (t == 0) path.vertices.push_back(lens_);
  for (int j = t - 1; j >= 0; --j) path.vertices.push_back(camera_[j].vertex);
  if (s == 0)
    path[0] = light_vertex(*connection.emitter, path[0].at);
  else if (t > 0)
    path[s - 1].lobe = path[s].lobe = Lobe::smooth;
}

}  // namespace mlt
