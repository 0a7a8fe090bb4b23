#include "wave/path_wave_lights.h"

namespace mlt {

template <class Numbers>
void BasicPathWave<Numbers>::trace(RayCounts& rays, bool coherent) {
  for (int depth = 1; live_ > 0; ++depth) {
    find_hits(coherent && depth == 1, rays);
    next_ = 0;
    begin_vertices(depth == rules_.most_edges());
    if (scene_->has_passages()) follow_legs(rays);
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

/// Finds where the numbers of this step are: those of a vertex unless it is the `last`, and of the
/// leg to it.
template <class Numbers>
void BasicPathWave<Numbers>::begin_vertices(bool last) {
  const auto first = numbers_.places();
  if (scene_->has_passages()) leg_ = numbers_.places().next();
  at_ = decltype(at_)::draw(numbers_.places());
  if (last && !scene_->has_passages()) return;
  for (int begin = 0; begin < live_; begin += block_size)
    numbers_.begin_vertex(first, begin, std::min(block_size, live_ - begin), last);
}

/// Follows the rays on that go through something.
template <class Numbers>
void BasicPathWave<Numbers>::follow_legs(RayCounts& rays) {
  legs_.follow(
      *scene_, live_, [&](int place) { return hits(place); },
      [&](int place) { return walks_[path_[place]].ray.medium; },
      [&](int place, WaveLeg& leg) {
        const WaveWalk& walk = exact_walk(place);
        leg.ray = walk.ray;
        leg.u = numbers_.read(leg_, place);
        leg.passed.likelihood = walk.likelihood;
      },
      rays);
}

/// Takes what has been passed on the leg to its end: `at`, or (nullptr) nowhere or on a surface
/// that light does not pass.
template <class Numbers>
void BasicPathWave<Numbers>::arrive(int place, WaveWalk& walk, const SurfacePoint* at) {
  if (!passes_something(place)) return;
  const WaveLeg& leg = this->leg(place);
  walk.ray = leg.ray;
  walk.pass(leg.passed,
            at ? scene_->arrival(leg.passed, *at, leg.ray.d) : Scene::arrival(leg.passed));
}

/// Takes one step of trace_path for all paths of the block.
template <class Numbers>
void BasicPathWave<Numbers>::shade_block(int depth, RayCounts& rays) {
  const bool last = depth == rules_.most_edges();
  if (!last) read_numbers(depth);
  glossy_.clear();
  singles_.clear();
  sky_count_ = 0;
  for (int i = 0; i < count_; ++i) find_vertex(i, depth);
  if (last) return;
  lambertian_.find_reflectances();
  lambertian_.find_points(count_, &d_.x[begin_], &d_.y[begin_], &d_.z[begin_],
                          rules_.strict_normals);
  glossy_.find_frames(lambertian_, &d_.x[begin_], &d_.y[begin_], &d_.z[begin_]);
  const bool lit = rules_.wants(depth + 1);
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
inline void BasicPathWave<Numbers>::find_vertex(int i, int depth) {
  const int place = begin_ + i;
  lambertian_.f[i] = nullptr;
  glossy_at_[i] = single_[i] = -1;
  if (passes_something(place) && leg(place).in_medium()) return find_in_medium(i, depth);
  const Hit hit = passes_something(place) ? leg(place).hit : hits(place);
  if (hit.shape == SurfacePoint::no_shape) return leave_scene(place, depth);
  const LaneMesh& mesh = scene_->lane_mesh(hit.shape);
  const bool glossy = mesh.glossy && !mesh.emits;
  const bool in_lanes = (mesh.lambertian || glossy) && !scene_->media().is_boundary(hit.shape);
  if (mesh.emits || !in_lanes) find_single(i, hit, depth, in_lanes);
  if (!in_lanes || depth == rules_.most_edges()) return;
  if (!mesh.emits) arrive(place, walk(i), nullptr);
  const Ray& ray = walk(i).ray;
  const Vec2f b(hit.u, hit.v);
  if (mesh.lambertian) {
    lambertian_.set(i, mesh, hit.primitive, b.x, b.y, ray.time, ray.wavelength);
  } else {
    lambertian_.set_place(i, *mesh.mesh, hit.primitive, b.x, b.y, true);
    glossy_at_[i] = glossy_.add(i, mesh, hit.primitive, b, ray.time, ray.wavelength);
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

template <class Numbers>
void BasicPathWave<Numbers>::leave_scene(int place, int depth) {
  if (!rules_.wants(depth)) return;
  WaveWalk& walk = exact_walk(place);
  arrive(place, walk, nullptr);
  find_light_at_end(place, walk, nullptr);
}

/// Finds a vertex on a surface that shines, or is not `in_lanes`.
template <class Numbers>
void BasicPathWave<Numbers>::find_single(int i, const Hit& hit, int depth, bool in_lanes) {
  const int place = begin_ + i;
  WaveWalk& walk = exact_walk(place);
  const int added = singles_.add(i, -walk.ray.d);
  SurfacePoint& at = singles_[added].at;
  scene_->find_surface_point(passes_something(place) ? leg(place).ray : walk.ray, hit, at);
  arrive(place, walk, &at);
  if (rules_.wants(depth)) find_light_at_end(place, walk, &at);
  const bool lambertian = at.lambertian.known() && !scene_->media().is_boundary(at);
  if (lambertian && !in_lanes) lambertian_.set(i, at);
  if (!in_lanes && !lambertian && consistent_sides(at, -walk.ray.d, rules_.strict_normals))
    single_[i] = added;
  else
    singles_.drop_last();
}

template <class Numbers>
void BasicPathWave<Numbers>::find_in_medium(int i, int depth) {
  const int place = begin_ + i;
  WaveWalk& walk = walks_[path_[place]];
  single_[i] = singles_.add(i, -walk.ray.d);
  SurfacePoint& at = singles_[single_[i]].at;
  at = Scene::medium_point(leg(place).ray, *leg(place).stop);
  arrive(place, walk, &at);
  walk.certainty = 0;
  if (rules_.wants(depth)) find_light_at_end(place, walk, &at);
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
  if (walk.ray.medium != no_medium)
    walk.ray.before = dot(lambertian_.o[i] - lambertian_.p[i], lambertian_.w[i]);
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
