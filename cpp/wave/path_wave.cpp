#include "wave/path_wave_lights.h"

namespace mlt {

template <class Numbers>
void BasicPathWave<Numbers>::trace(RayCounts& rays, bool coherent) {
  for (int depth = 1; live_ > 0; ++depth) {
    find_hits(coherent && depth == 1, rays);
    next_ = 0;
    first_ = numbers_.places();
    if (scene_->has_passages()) leg_ = numbers_.places().next();
    at_ = decltype(at_)::draw(numbers_.places());
    for (begin_ = 0; begin_ < live_; begin_ += block_size) {
      count_ = std::min(block_size, live_ - begin_);
      shade_block(depth, rays);
    }
    find_shadows(rays);
    live_ = next_;
  }
}

template <class Numbers>
WaveWalk& BasicPathWave<Numbers>::exact_walk(int place) {
  WaveWalk& walk = walks_[path_[place]];
  if (!exact_[place]) {
    walk.ray.o = Vec3(o_[place]);
    walk.ray.d = Vec3(d_[place]);
  }
  exact_[place] = true;
  return walk;
}

template <class Numbers>
void BasicPathWave<Numbers>::find_hits(bool coherent, RayCounts& rays) {
  find_wave_hits(
      scene_->accel(), live_, o_, d_, [&](int i) -> const Ray& { return exact_walk(i).ray; },
      [&](int i) { return walks_[path_[i]].ray.time; }, coherent, hits_);
  rays.count_intersect(live_);
}

/// Takes one step of trace_path for all paths of the block.
template <class Numbers>
void BasicPathWave<Numbers>::shade_block(int depth, RayCounts& rays) {
  const bool last = depth == rules_.most_edges();
  if (!last || scene_->has_passages()) numbers_.begin_vertex(first_, begin_, count_, last);
  if (!last) read_numbers(depth);
  glossy_.clear();
  singles_.clear();
  sky_count_ = 0;
  for (int i = 0; i < count_; ++i) find_vertex(i, depth, rays);
  if (last) return;
  lambertian_.find_reflectances();
  lambertian_.find_points(count_, &d_.x[begin_], &d_.y[begin_], &d_.z[begin_],
                          rules_.strict_normals);
  glossy_.find_frames(lambertian_, &d_.x[begin_], &d_.y[begin_], &d_.z[begin_]);
  const bool lit = rules_.wants(depth + 1) && !scene_->has_media();
  if (scene_->has_media()) light_singles(depth, rays);
  if (lit) choose_lights(depth);
  scatter_in_lanes();
  if (lit) queue_lights();
  lambertian_.sample_directions(count_, rules_.strict_normals);
  take_step(depth, rays);
}

/// Reads the numbers that vertices of all kinds need.
template <class Numbers>
void BasicPathWave<Numbers>::read_numbers(int depth) {
  if (rules_.wants(depth + 1)) {
    numbers_.read2(at_.light, begin_, count_, &u_light_x_[0], &u_light_y_[0]);
    if (scene_->needs_light_choice()) numbers_.read(at_.choice, begin_, count_, &u_choice_[0]);
  }
  numbers_.read2(at_.direction, begin_, count_, &lambertian_.u_x[0], &lambertian_.u_y[0]);
}

template <class Numbers>
inline void BasicPathWave<Numbers>::find_vertex(int i, int depth, RayCounts& rays) {
  const PacketHits& hits = this->hits(i);
  const int lane = i % RayPacket::size;
  const uint32_t shape = hits.shape[lane];
  lambertian_.f[i] = nullptr;
  glossy_at_[i] = single_[i] = -1;
  if (scene_->has_media()) return find_single(i, hits.hit(lane), depth, rays);
  if (shape == SurfacePoint::no_shape) {
    if (!rules_.wants(depth)) return;
    WaveWalk& walk = exact_walk(begin_ + i);
    find_light_at_end(begin_ + i, walk, nullptr);
    return;
  }
  const LaneMesh& mesh = scene_->lane_mesh(shape);
  const bool glossy = mesh.glossy && !mesh.emits;
  if (mesh.emits || !(mesh.lambertian || glossy)) find_single(i, hits.hit(lane), depth, rays);
  if (depth == rules_.most_edges()) return;
  const uint32_t triangle = hits.primitive[lane];
  const Vec2f b(hits.u[lane], hits.v[lane]);
  if (mesh.lambertian) {
    lambertian_.set(i, mesh, triangle, b.x, b.y, walk(i).ray.wavelength);
  } else if (glossy) {
    lambertian_.set_place(i, *mesh.mesh, triangle, b.x, b.y, true);
    glossy_at_[i] = glossy_.add(i, mesh, triangle, b, walk(i).ray.wavelength);
  }
}

template <class Numbers>
inline void BasicPathWave<Numbers>::find_light_at_end(int place, WaveWalk& walk,
                                                      const SurfacePoint* at) {
  if (!keeps_emitters_) return find_light(*scene_, walk, at, walk);
  struct Keeper : IgnorePaths {
    double find(const CameraWalk& walk, const Color& rgb, double certainty) {
      return weight = static_cast<const WaveWalk&>(walk).find(walk, rgb, certainty);
    }
    void hit(const Emitter& emitter, const SurfacePoint&, const Color& rgb) const {
      wave->keep(path, emitter.index(), rgb * weight);
    }
    BasicPathWave* wave;
    int path;
    double weight = 1;
  } keeper;
  keeper.wave = this;
  keeper.path = path_[place];
  find_light(*scene_, walk, at, keeper);
}

/// Finds a vertex on a surface that shines, is not Lambertian, or is behind one that light passes;
/// in scenes with media any vertex.
template <class Numbers>
void BasicPathWave<Numbers>::find_single(int i, const Hit& hit, int depth, RayCounts& rays) {
  WaveWalk& walk = exact_walk(begin_ + i);
  const int added = singles_.add(i, -walk.ray.d);
  SurfacePoint& at = singles_[added].at;
  bool stops = hit.shape != SurfacePoint::no_shape;
  if (stops) scene_->find_surface_point(walk.ray, hit, at);
  if (walk.ray.medium != no_medium || (stops && scene_->bsdf(at).has_passage()))
    stops = go_through(Walker{*scene_, walk.ray.time, rays}, numbers_.read(leg_, begin_ + i), stops,
                       walk, at);
  if (rules_.wants(depth)) find_light_at_end(begin_ + i, walk, stops ? &at : nullptr);
  const bool in_lanes = !scene_->has_media() && scene_->lane_mesh(hit.shape).lambertian;
  if (stops && !in_lanes && consistent_sides(at, -walk.ray.d, rules_.strict_normals))
    single_[i] = added;
  else
    singles_.drop_last();
}

template <class Numbers>
void BasicPathWave<Numbers>::take_step(int depth, RayCounts& rays) {
  for (int i = 0; i < count_; ++i) {
    WaveWalk& walk = this->walk(i);
    const bool lambertian = lambertian_.f[i], on_mesh = lambertian || glossy_at_[i] >= 0;
    if (!(lambertian ? scatter_lambertian(i, depth, walk)
          : on_mesh  ? scatter_glossy(i, depth, walk)
                     : scatter_other(i, depth, walk, rays)))
      continue;
    o_.set(next_, on_mesh ? lambertian_.o[i] : Vec3f(walk.ray.o));
    d_.set(next_, on_mesh ? lambertian_.w[i] : Vec3f(walk.ray.d));
    ++walk.rays.intersect;
    exact_[next_] = !on_mesh;
    path_[next_] = path_[begin_ + i];
    numbers_.move(next_++, begin_ + i);
  }
}

template <class Numbers>
bool BasicPathWave<Numbers>::scatter_lambertian(int i, int depth, WaveWalk& walk) {
  walk.throughput *= *lambertian_.f[i] * pi;
  return leave_mesh(i, depth, lambertian_.scatter_pdf[i], walk);
}

template <class Numbers>
bool BasicPathWave<Numbers>::scatter_glossy(int i, int depth, WaveWalk& walk) {
  const GlossyVertex& vertex = glossy_[glossy_at_[i]];
  if (!(vertex.pdf > 0) || !lambertian_.leave_in(i, vertex.to, rules_.strict_normals)) return false;
  walk.throughput *= vertex.f_cos * (1 / double{vertex.pdf});
  return leave_mesh(i, depth, vertex.pdf, walk);
}

/// See go_on() of path_tracer.h.
template <class Numbers>
bool BasicPathWave<Numbers>::leave_mesh(int i, int depth, double pdf, WaveWalk& walk) {
  if (!(pdf > 0) || !survive(rules_, depth, roulette(i, depth), walk)) return false;
  walk.scatter_pdf = pdf;
  walk.delta = false;
  walk.certainty = 0;
  walk.previous = Vec3(lambertian_.p[i]);
  return true;
}

template <class Numbers>
void BasicPathWave<Numbers>::scatter_in_lanes() {
  if (glossy_.begin() == glossy_.end() && singles_.begin() == singles_.end()) return;
  numbers_.read(at_.lobe, begin_, count_, &u_lobe_[0]);
  const auto numbers = [&](int i) {
    return Vec3(u_lobe_[i], lambertian_.u_x[i], lambertian_.u_y[i]);
  };
  for (GlossyVertex& vertex : glossy_) vertex.u_scatter = numbers(vertex.path);
  glossy_.scatter();
  for (SingleVertex& single : singles_) single.u_scatter = numbers(single.path);
  singles_.scatter_in_lanes(*scene_, rules_.strict_normals);
}

/// For a vertex that is computed by itself, if there is one.
template <class Numbers>
bool BasicPathWave<Numbers>::scatter_other(int i, int depth, WaveWalk& walk, RayCounts& rays) {
  if (single_[i] < 0) return false;
  const SingleVertex& single = singles_[single_[i]];
  const Walker walker{*scene_, walk.ray.time, rays};
  const auto sample = single.in_lanes ? single.scattered
                                      : scatter_to_light(walker, single.at, single.wc,
                                                         single.u_scatter, rules_.strict_normals);
  return sample && go_on(walker, rules_, depth, single.at, *sample, roulette(i, depth), walk);
}

template class BasicPathWave<WaveNumbers>;
template class BasicPathWave<DrawnNumbers>;

}  // namespace mlt
