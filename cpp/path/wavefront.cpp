#include "path/wavefront.h"

#include <numeric>

namespace mlt {

void Wavefront::trace(RayCounts& rays) {
  live_.resize(size());
  std::iota(live_.begin(), live_.end(), 0);
  for (int depth = 1; !live_.empty(); ++depth) {
    find_hits(rays);
    matte_.count = 0;
    goes_on_.fill(false);
    for (size_t k = 0; k < live_.size(); ++k) find_vertex(live_[k], hits_[k], depth, rays);
    scatter_matte(depth, rays);
    find_shadows();
    const auto ended = [&](int walk) { return !goes_on_[walk]; };
    live_.erase(std::remove_if(live_.begin(), live_.end(), ended), live_.end());
  }
}

void Wavefront::find_hits(RayCounts& rays) {
  hits_.resize(live_.size());
  for (size_t begin = 0; begin < live_.size(); begin += RayPacket::size) {
    const int count = static_cast<int>(std::min<size_t>(RayPacket::size, live_.size() - begin));
    const Ray* packet[RayPacket::size];
    for (int i = 0; i < count; ++i) packet[i] = &walks_[live_[begin + i]].ray;
    scene_->accel().intersect(packet, count, &hits_[begin]);
  }
  rays.intersect += live_.size();
}

/// One step of trace_path, up to where light is scattered.
void Wavefront::find_vertex(int index, const Hit& hit, int depth, RayCounts& rays) {
  CameraWalk& walk = walks_[index];
  if (hit.shape == SurfacePoint::no_shape) {
    if (rules_.wants(depth)) find_light(*scene_, walk, nullptr);
    return;
  }
  const Shape& shape = *scene_->shapes()[hit.shape];
  const Mesh* mesh = shape.as_mesh();
  const bool matte = mesh && shape.bsdf().is_matte();
  if (shape.emitter() || !matte) {
    const SurfacePoint at = scene_->surface_point(walk.ray, hit);
    if (rules_.wants(depth)) find_light(*scene_, walk, &at);
    if (depth < rules_.most_edges() && !matte) find_other_vertex(index, at, depth, rays);
  }
  if (depth < rules_.most_edges() && matte) find_matte_vertex(index, *mesh, hit);
}

void Wavefront::find_matte_vertex(int index, const Mesh& mesh, const Hit& hit) {
  const MeshPoint point = mesh.point(hit.primitive, {hit.u, hit.v});
  const Vec3f wc(-walks_[index].ray.d);
  if (!consistent_sides(point.ng, point.n, wc, rules_.strict_normals)) return;
  const Matte* uniform = mesh.bsdf().uniform_matte();
  matte_.add(index, hit.shape, point, wc,
             uniform ? *uniform : mesh.bsdf().matte(mesh.textured_point(point)));
}

void Wavefront::find_other_vertex(int index, const SurfacePoint& at, int depth, RayCounts& rays) {
  CameraWalk& walk = walks_[index];
  const Vec3 wc = -walk.ray.d;
  if (!consistent_sides(at, wc, rules_.strict_normals)) return;
  const VertexNumbers numbers(samplers_[index]);
  if (wants_direct_light(*scene_, rules_, depth, at))
    queue_light(index, at, numbers.for_light(), rays);
  const Walker walker{*scene_, walk.ray.time, rays};
  goes_on_[index] = scatter(walker, rules_, depth, at, numbers, walk);
}

void Wavefront::scatter_matte(int depth, RayCounts& rays) {
  const bool direct = rules_.wants(depth + 1);
  for (int i = 0; i < matte_.count; ++i) {
    const VertexNumbers numbers(samplers_[matte_.walk[i]]);
    matte_.u_x[i] = static_cast<float>(numbers.direction.x);
    matte_.u_y[i] = static_cast<float>(numbers.direction.y);
    matte_.u_roulette[i] = numbers.roulette;
    if (direct) choose_light(i, numbers.for_light(), rays);
  }
  if (direct) queue_lights(rays);
  matte_.sample_directions(rules_.strict_normals);
  for (int i = 0; i < matte_.count; ++i) goes_on_[matte_.walk[i]] = go_on(i, depth);
}

void Wavefront::choose_light(int i, const Vec3& u, RayCounts& rays) {
  double u_choice = u.x;
  const EmitterChoice choice = scene_->choose_emitter(u_choice);
  if (const Color* radiance = choice.emitter->uniform_radiance()) {
    const Mesh& mesh = *choice.emitter->shape()->as_mesh();
    matte_.set_light(i, mesh.sample_point({u.y, u.z}), *radiance, choice.probability / mesh.area());
    return;
  }
  matte_.set_no_light(i);
  const int walk = matte_.walk[i];
  queue_light(walk, matte_.point(i, walks_[walk].ray.time), u, rays);
}

void Wavefront::queue_lights(RayCounts& rays) {
  matte_.unshadowed_lights(rules_.strict_normals, heuristic_);
  for (int i = 0; i < matte_.count; ++i)
    if (matte_.light_weight[i] > 0)
      queue_shadow(matte_.walk[i],
                   matte_.radiance[i] * matte_.f[i] * double{matte_.light_weight[i]}, rays,
                   matte_.shadow_o[i], matte_.shadow_w[i], matte_.shadow_length[i],
                   walks_[matte_.walk[i]].ray.time);
}

/// direct_light() of path_tracer.h.
void Wavefront::queue_light(int index, const SurfacePoint& at, const Vec3& u, RayCounts& rays) {
  const CameraWalk& walk = walks_[index];
  const auto mis = [&](double light, double bsdf) { return walk.mis(light, bsdf); };
  const DirectLight light =
      unshadowed_light(*scene_, at, -walk.ray.d, u, rules_.strict_normals, mis);
  if (is_black(light.radiance)) return;
  if (const auto ray = scene_->segment(at, light.x0, walk.ray.time))
    queue_shadow(index, light.radiance, rays, *ray);
}

template <class... Segment>
void Wavefront::queue_shadow(int index, const Color& radiance, RayCounts& rays,
                             const Segment&... segment) {
  const int i = shadows_.packet.count;
  shadows_.walk[i] = index;
  shadows_.radiance[i] = walks_[index].throughput * radiance;
  shadows_.own_share[i] = walks_[index].own_share(shadows_.radiance[i]);
  shadows_.packet.add(segment...);
  ++rays.occluded;
  if (shadows_.packet.full()) find_shadows();
}

void Wavefront::find_shadows() {
  if (shadows_.packet.count == 0) return;
  const unsigned blocked = scene_->accel().occluded(shadows_.packet);
  for (int i = 0; i < shadows_.packet.count; ++i)
    if (!(blocked >> i & 1))
      walks_[shadows_.walk[i]].take(shadows_.radiance[i], shadows_.own_share[i]);
  shadows_.packet.count = 0;
}

/// scatter() of path_tracer.h for a matte vertex.
bool Wavefront::go_on(int i, int depth) {
  const double pdf = matte_.scatter_pdf[i];
  CameraWalk& walk = walks_[matte_.walk[i]];
  walk.throughput *= matte_.f[i] * pi;
  if (!(pdf > 0) || is_black(walk.throughput)) return false;
  if (!survive(rules_, depth, matte_.u_roulette[i], walk)) return false;
  walk.scatter_pdf = pdf;
  walk.delta = false;
  walk.previous = Vec3(matte_.p[i]);
  walk.ray = {Vec3(matte_.o[i]), Vec3(matte_.w[i]), walk.ray.time};
  return true;
}

}  // namespace mlt
