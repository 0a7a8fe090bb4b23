#include "path/bidirectional_sampler.h"

namespace mlt {

/// Densities that do not depend on how the subpaths are joined: what each walk knows of its own
/// vertices, and of them as made by the other walk, up to the two vertices next to the joint.
void BidirectionalSampler::begin_densities(const WalkVertex* lights, int s,
                                           const WalkVertex* cameras, int t) {
  const int k = s + t - 1;
  densities_.resize(k + 1);
  for (int i = 0; i < s; ++i)
    densities_[i] = {lights[i].forward, lights[i].reverse, connectable(lights[i].vertex)};
  for (int j = 0; j < t; ++j)
    densities_[k - j] = {cameras[j].reverse, cameras[j].forward, connectable(cameras[j].vertex)};
}

bool BidirectionalSampler::weigh(Connection& connection, double survival, const Vertex& x0,
                                 const Vertex& xk, const SurfacePoint& x1) {
  const int k = static_cast<int>(densities_.size()) - 1;
  if (!settings_.light_image)
    densities_[k].connectable = false;  // t = 1 is not among the techniques
  const double direct =
      settings_.sample_direct ? direct_position_pdf(*scene_, x0, x1) : densities_[0].from_light;
  const MisWeights weights =
      mis_weights(densities_.data(), k, connection.s, direct, can_be_hit(*scene_, x0),
                  settings_.light_image && can_be_hit(*scene_, xk), settings_.heuristic);
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
  begin_densities(nullptr, 0, camera_.data(), t);
  densities_[0].connectable = true;
  densities_[0].from_light = light_position_pdf(*scene_, x0);
  densities_[1].from_light = terms.pdf_from_light * end.G;
  return weigh(connection, end.survival, x0, camera_[0].vertex, camera_[t - 2].vertex.at);
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
  const double G = geometry(a.vertex.at, b.vertex.at);
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

  begin_densities(lights, s, camera_.data(), t);
  densities_[s - 1].connectable = densities_[s].connectable = true;
  densities_[s].from_light = at_a.pdf_from_light * G;
  if (t >= 2) densities_[s + 1].from_light = at_b.pdf_from_light * b.G;
  densities_[s - 1].from_camera = at_b.pdf_from_camera * G;
  if (s >= 2) densities_[s - 2].from_camera = at_a.pdf_from_camera * a.G;
  const SurfacePoint& x1 = s >= 2 ? light_[1].vertex.at : b.vertex.at;
  return weigh(connection, a.survival * b.survival, lights[0].vertex, camera_[0].vertex, x1);
}

bool BidirectionalSampler::choose_direct(const SurfacePoint& from, const Vec3& u) {
  const LightSample chosen = sample_direct_position(*scene_, from.p, u);
  if (!(chosen.pdf > 0)) return false;
  direct_.vertex = light_vertex(*chosen.emitter, chosen.x0);
  direct_.throughput = Color(1 / chosen.pdf);
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
  lens_.vertex = camera_vertex(*hit);
  const VertexTerms terms = vertex_terms(*scene_, lens_.vertex, -last.towards_next,
                                         -last.towards_next, settings_.rules.strict_normals);
  const auto raster = scene_->camera().raster_position(*hit, -last.towards_next);
  if (is_black(terms.f) || !raster) return false;
  connection.raster = *raster;
  connection.contribution = last.next_throughput * terms.f;
  if (is_black(connection.contribution)) return false;
  if (k == settings_.rules.most_edges()) {  // The walk has not followed its last direction.
    const double seen = walker(rays).join(last.vertex.at, *hit);
    if (seen == 0) return false;
    connection.contribution *= seen;
  }
  lens_.forward = camera_position_pdf(*scene_, lens_.vertex);
  const double G = geometry(last.vertex.at, *hit);
  begin_densities(light_.data(), k, &lens_, 1);
  densities_[k].from_light = last.next_coefficient * G;
  densities_[k - 1].from_camera = terms.pdf_from_camera * G;
  const SurfacePoint& x1 = k >= 2 ? light_[1].vertex.at : lens_.vertex.at;
  return weigh(connection, last.next_survival, light_[0].vertex, lens_.vertex, x1);
}

void BidirectionalSampler::assemble(const Connection& connection, Path& path) const {
  const int s = connection.s, t = connection.t;
  path.vertices.clear();
  path.time = time_;
  const bool direct = s == 1 && settings_.sample_direct;
  const int lights = t == 0 ? s - 1 : s;
  for (int i = 0; i < lights; ++i)
    path.vertices.push_back(direct ? direct_.vertex : light_[i].vertex);
  if (t == 0) path.vertices.push_back(lens_.vertex);
  for (int j = t - 1; j >= 0; --j) path.vertices.push_back(camera_[j].vertex);
  if (s == 0)
    path[0] = light_vertex(*connection.emitter, path[0].at);
  else if (t > 0)
    path[s - 1].lobe = path[s].lobe = Lobe::smooth;
}

}  // namespace mlt
