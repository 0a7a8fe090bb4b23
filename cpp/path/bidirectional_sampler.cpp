#include "path/bidirectional_sampler.h"

namespace mlt {

/// How much more often technique s = 1 makes x_0 than a walk from it does.
double BidirectionalSampler::direct_over_walk(const Vertex& x0, double from_light,
                                              const SurfacePoint& x1) const {
  return settings_.sample_direct ? direct_position_pdf(*scene_, x0, x1) / from_light : 1;
}

/// How often technique s = i counts whose joint lies before vertex i of the light subpath. `joined`:
/// vertex i scatters smoothly, since the path is joined there.
double BidirectionalSampler::light_technique(int i, bool joined) const {
  if (i == 0) return can_be_hit(*scene_, light_[0].vertex) ? 1 : 0;
  if (!connectable(light_[i - 1].vertex)) return 0;
  if (!joined && !connectable(light_[i].vertex)) return 0;
  return i == 1 ? light_direct_over_walk_ : 1;
}

/// The same for technique t = i and the camera subpath.
double BidirectionalSampler::camera_technique(int i, bool joined) const {
  if (i <= 1 && !settings_.light_image) return 0;
  if (i == 0) return can_be_hit(*scene_, camera_[0].vertex) ? 1 : 0;
  return connectable(camera_[i - 1].vertex) && (joined || connectable(camera_[i].vertex)) ? 1 : 0;
}

/// Techniques with a joint before or at vertex i of the light subpath, whose density as made by a
/// camera walk is `reverse`.
TechniqueSums BidirectionalSampler::below_light(int i, double reverse) const {
  const TechniqueSums before = i > 0 ? light_sums_[i - 1] : TechniqueSums();
  return before.over(reverse / light_[i].forward, light_technique(i));
}
TechniqueSums BidirectionalSampler::above_camera(int i, double reverse) const {
  const TechniqueSums before = i > 0 ? camera_sums_[i - 1] : TechniqueSums();
  return before.over(reverse / camera_[i].forward, camera_technique(i));
}

/// Up to the last vertex but one: the density that the other walk gives it is known.
void BidirectionalSampler::sum_techniques() {
  light_sums_.clear();
  camera_sums_.clear();
  if (light_.size() >= 2)
    light_direct_over_walk_ =
        direct_over_walk(light_[0].vertex, light_[0].forward, light_[1].vertex.at);
  for (int i = 0; i + 1 < static_cast<int>(light_.size()); ++i)
    light_sums_.push_back(below_light(i, light_[i].reverse));
  for (int i = 0; i + 1 < static_cast<int>(camera_.size()); ++i)
    camera_sums_.push_back(above_camera(i, camera_[i].reverse));
}

bool BidirectionalSampler::weigh(Connection& connection, double own, const TechniqueSums& below,
                                 const TechniqueSums& above, double survival) const {
  const MisWeights weights = mis_weights(own, below, above, settings_.heuristic);
  connection.weight = weights.chosen;
  connection.own_share = weights.balance * survival;
  return connection.weight > 0;
}

/// s = 0: the camera walk has hit a light.
bool BidirectionalSampler::evaluate_hit_light(Connection& connection) {
  const int t = connection.t;
  const WalkVertex& end = camera_[t - 1];
  const Vertex x0 = light_vertex(*connection.emitter, end.vertex.at);
  if (!can_be_hit(*scene_, x0)) return false;
  const VertexTerms terms = vertex_terms(*scene_, x0, end.towards_previous, end.towards_previous,
                                         settings_.rules.strict_normals);
  connection.contribution = end.throughput * terms.f;
  if (is_black(connection.contribution)) return false;
  const double from_light = light_position_pdf(*scene_, x0);
  const double direct = direct_over_walk(x0, from_light, camera_[t - 2].vertex.at);
  const TechniqueSums above =
      above_camera(t - 2, terms.pdf_from_light * end.G)
          .over(from_light / end.forward, direct * camera_technique(t - 1, true));
  return weigh(connection, 1, {}, above, end.survival);
}

/// s >= 1, t >= 1: the last vertices of the two subpaths see each other.
bool BidirectionalSampler::evaluate_connection(Connection& connection, RayCounts& rays) {
  const int s = connection.s, t = connection.t, k = s + t - 1;
  const WalkVertex& b = camera_[t - 1];
  if (b.vertex.at.infinite()) return false;
  const bool direct = s == 1 && settings_.sample_direct;
  if (direct ? !choose_direct(b.vertex.at, direct_u_[t - 1]) : s > static_cast<int>(light_.size()))
    return false;
  const WalkVertex* lights = direct ? &direct_ : light_.data();
  const WalkVertex& a = lights[s - 1];
  if (k == 1 && !can_be_hit(*scene_, a.vertex) && !can_be_hit(*scene_, b.vertex)) return false;

  const Vec3 ab = direction(a.vertex.at, b.vertex.at);
  const VertexTerms at_a =
      joint_terms(*scene_, a.vertex, a.towards_previous, ab, settings_.rules.strict_normals);
  if (is_black(at_a.f)) return false;
  const VertexTerms at_b =
      joint_terms(*scene_, b.vertex, -ab, b.towards_previous, settings_.rules.strict_normals);
  if (is_black(at_b.f)) return false;
  const double G = geometry(a.vertex.at, b.vertex.at, ab);
  connection.contribution = a.throughput * at_a.f * G * at_b.f * b.throughput;
  if (is_black(connection.contribution)) return false;
  if (t == 1) {
    const auto raster = scene_->camera().raster_position(b.vertex.at, -ab);
    if (!raster) return false;
    connection.raster = *raster;
  }
  const double seen = walker(rays).join(a.vertex.at, b.vertex.at);
  if (seen == 0) return false;
  connection.contribution *= seen;

  TechniqueSums below, above;
  if (s >= 2) below = below_light(s - 2, at_a.pdf_from_camera * a.G);
  if (t >= 2) above = above_camera(t - 2, at_b.pdf_from_light * b.G);
  const double before_a = s >= 2                          ? light_technique(s - 1, true)
                          : can_be_hit(*scene_, a.vertex) ? 1
                                                          : 0;
  below = below.over(at_b.pdf_from_camera * G / a.forward, before_a);
  above = above.over(at_a.pdf_from_light * G / b.forward, camera_technique(t - 1, true));
  return weigh(connection, direct ? direct_pdf_ / a.forward : 1, below, above,
               a.survival * b.survival);
}

bool BidirectionalSampler::choose_direct(const SurfacePoint& from, const Vec3& u) {
  const LightSample chosen = sample_direct_position(*scene_, from, u);
  if (!(chosen.pdf > 0)) return false;
  direct_.vertex = light_vertex(*chosen.emitter, chosen.x0);
  direct_.throughput = Color(1 / chosen.pdf);
  direct_pdf_ = chosen.pdf;
  direct_.forward = light_position_pdf(*scene_, direct_.vertex);
  return true;
}

/// t = 0: the light walk passes through the lens after its vertex s - 2.
bool BidirectionalSampler::evaluate_hit_lens(Connection& connection, RayCounts& rays) {
  const int s = connection.s, k = s - 1;
  const WalkVertex& last = light_[s - 2];
  if (last.absorbed()) return false;
  const Ray ray =
      s == 2 ? light_.first_ray() : walker(rays).leave(last.vertex.at, last.towards_next);
  const auto hit = scene_->camera().hit_lens(ray);
  if (!hit) return false;
  if (s <= static_cast<int>(light_.size()) &&
      length_squared(hit->p - ray.o) >= length_squared(light_[s - 1].vertex.at.p - ray.o))
    return false;
  lens_ = camera_vertex(*hit);
  const VertexTerms terms = vertex_terms(*scene_, lens_, -last.towards_next, -last.towards_next,
                                         settings_.rules.strict_normals);
  const auto raster = scene_->camera().raster_position(*hit, -last.towards_next);
  if (is_black(terms.f) || !raster) return false;
  connection.raster = *raster;
  connection.contribution = last.next_throughput * terms.f;
  if (is_black(connection.contribution)) return false;
  if (light_.goes_on() && s - 1 == static_cast<int>(light_.size())) {  // Nobody has looked yet.
    const double seen = walker(rays).join(last.vertex.at, *hit);
    if (seen == 0) return false;
    connection.contribution *= seen;
  }
  const double G = geometry(last.vertex.at, *hit);
  const double before_lens = !connectable(last.vertex) ? 0
                             : k == 1 ? direct_over_walk(last.vertex, last.forward, *hit)
                                      : 1;
  const TechniqueSums below =
      below_light(k - 1, terms.pdf_from_camera * G)
          .over(camera_position_pdf(*scene_, lens_) / (last.next_coefficient * G), before_lens);
  return weigh(connection, 1, below, {}, last.next_survival);
}

void BidirectionalSampler::assemble(const Connection& connection, Path& path) const {
  const int s = connection.s, t = connection.t;
  path.vertices.clear();
  path.time = time_;
  const bool direct = s == 1 && settings_.sample_direct;
  const int lights = t == 0 ? s - 1 : s;
  for (int i = 0; i < lights; ++i)
    path.vertices.push_back(direct ? direct_.vertex : light_[i].vertex);
  if (t == 0) path.vertices.push_back(lens_);
  for (int j = t - 1; j >= 0; --j) path.vertices.push_back(camera_[j].vertex);
  if (s == 0)
    path[0] = light_vertex(*connection.emitter, path[0].at);
  else if (t > 0)
    path[s - 1].lobe = path[s].lobe = Lobe::smooth;
}

}  // namespace mlt
