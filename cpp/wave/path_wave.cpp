#include "wave/path_wave.h"

namespace mlt {

template <class Numbers>
void BasicPathWave<Numbers>::trace(RayCounts& rays, bool coherent) {
  for (int depth = 1; live_ > 0; ++depth) {
    find_hits(coherent && depth == 1, rays);
    next_ = 0;
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

template <class Numbers>
void BasicPathWave<Numbers>::find_shadows(RayCounts& rays) {
  rays.count_occluded(shadows_.count());
  shadows_.trace(
      scene_->accel(), [&](int path) { return walks_[path].ray.time; },
      [&](int path, const Color& radiance, double share) {
        walks_[path].radiance += radiance * share;
      },
      [&](int shadow) { receive_through(shadow); });
  lights_to_pass_.clear();
}

/// See direct_light() of path_tracer.h: the surfaces change the light, and its weight, since a walk
/// may stop there.
template <class Numbers>
void BasicPathWave<Numbers>::receive_through(int shadow) {
  const LightToPass& to_pass = lights_to_pass_[shadow];
  WaveWalk& walk = walks_[shadows_.path(shadow)];
  Ray ray = shadows_.ray(shadow, walk.ray.time);
  ray.wavelength = walk.ray.wavelength;
  const Passage seen = scene_->passage(ray);
  if (seen.is_blocked()) return;
  const double mis = 1 / (1 + (1 / to_pass.mis - 1) * walk.mis.raise(seen.probability));
  const Color found = recorded(to_pass.light * seen.transmittance * (mis / to_pass.mis),
                               ray.wavelength, to_pass.disperses);
  walk.radiance += found * walk.weights.of(found, to_pass.survival, 0);
}

/// Takes one step of trace_path for all paths of the block.
template <class Numbers>
void BasicPathWave<Numbers>::shade_block(int depth, RayCounts& rays) {
  const bool last = depth == rules_.most_edges();
  if (!last) read_numbers(depth);
  singles_.clear();
  sky_count_ = 0;
  for (int i = 0; i < count_; ++i) find_vertex(i, depth, rays);
  if (last) return;
  lambertian_.find_reflectances();
  lambertian_.find_points(count_, &d_.x[begin_], &d_.y[begin_], &d_.z[begin_],
                          rules_.strict_normals);
  const bool lit = rules_.wants(depth + 1) && !scene_->has_media();
  if (scene_->has_media()) light_singles(depth, rays);
  if (lit) choose_lights(depth);
  scatter_in_lanes();
  if (lit) queue_lights();
  lambertian_.sample_directions(count_, rules_.strict_normals);
  take_step(depth, rays);
}

/// Reads the pairs of numbers of a vertex.
template <class Numbers>
void BasicPathWave<Numbers>::read_numbers(int depth) {
  numbers_.begin_vertex(at_.light, begin_, count_);
  if (rules_.wants(depth + 1))
    numbers_.read2(at_.light, begin_, count_, &u_light_x_[0], &u_light_y_[0]);
  numbers_.read2(at_.direction, begin_, count_, &lambertian_.u_x[0], &lambertian_.u_y[0]);
}

template <class Numbers>
Vec3 BasicPathWave<Numbers>::numbers_for_light(int i) const {
  const bool several = scene_->emitters().size() > 1;
  return {several ? numbers_.read(at_.choice, begin_ + i) : 0, u_light_x_[i], u_light_y_[i]};
}

template <class Numbers>
inline void BasicPathWave<Numbers>::find_vertex(int i, int depth, RayCounts& rays) {
  const PacketHits& hits = this->hits(i);
  const int lane = i % RayPacket::size;
  const uint32_t shape = hits.shape[lane];
  lambertian_.f[i] = nullptr;
  single_[i] = -1;
  if (scene_->has_media()) return find_single(i, hits.hit(lane), depth, rays);
  if (shape == SurfacePoint::no_shape) {
    if (!rules_.wants(depth)) return;
    WaveWalk& walk = exact_walk(begin_ + i);
    find_light(*scene_, walk, nullptr, walk);
    return;
  }
  const LambertianMesh& lambertian = scene_->lambertian_mesh(shape);
  if (lambertian.emits || !lambertian.mesh) find_single(i, hits.hit(lane), depth, rays);
  if (depth < rules_.most_edges() && lambertian.mesh)
    lambertian_.set(i, lambertian, hits.primitive[lane], hits.u[lane], hits.v[lane],
                    walk(i).ray.wavelength);
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
  if (rules_.wants(depth)) find_light(*scene_, walk, stops ? &at : nullptr, walk);
  const bool in_lanes = !scene_->has_media() && scene_->lambertian_mesh(hit.shape).mesh;
  if (stops && !in_lanes && consistent_sides(at, -walk.ray.d, rules_.strict_normals))
    single_[i] = added;
  else
    singles_.drop_last();
}

/// Lights the vertices in scenes with media, one by one.
template <class Numbers>
void BasicPathWave<Numbers>::light_singles(int depth, RayCounts& rays) {
  for (const SingleVertex& single : singles_) {
    WaveWalk& walk = this->walk(single.path);
    if (!wants_direct_light(*scene_, rules_, depth, single.at)) continue;
    add_direct_light(Walker{*scene_, walk.ray.time, rays}, rules_, single.at,
                     numbers_for_light(single.path), walk, walk);
  }
}

template <class Numbers>
void BasicPathWave<Numbers>::choose_lights(int depth) {
  const auto wants_light = [&](int i) {
    return lambertian_.f[i] ||
           (single_[i] >= 0 && wants_direct_light(*scene_, rules_, depth, singles_[single_[i]].at));
  };
  for (int i = 0; i < count_; ++i) {
    if (!wants_light(i)) continue;
    Vec3 u = numbers_for_light(i);
    const Vec3 from = single_[i] >= 0 ? singles_[single_[i]].at.p : Vec3(lambertian_.p[i]);
    const EmitterChoice choice = scene_->choose_emitter_for(from, u.x);
    const MeshLight& light = scene_->mesh_light(choice.index);
    if (lambertian_.f[i] && light.mesh)
      lambertian_.set_light(i, light, choice.probability,
                            light.mesh->sample_barycentrics_for(from, {u.y, u.z}),
                            walk(i).ray.wavelength);
    else
      choose_other_light(i, choice, {u.y, u.z});
  }
  sample_other_lights();
}

/// Takes a light that is no emissive mesh, or is for a vertex that is not Lambertian.
template <class Numbers>
void BasicPathWave<Numbers>::choose_other_light(int i, const EmitterChoice& choice, const Vec2& u) {
  if (lambertian_.f[i]) {
    lambertian_.light_pdf[i] = 0;
    if (!(lambertian_.sides[i] > 0)) return;
    if (choice.emitter->infinite()) {
      if (sky_count_ == static_cast<int>(sky_vertices_.size())) sky_vertices_.emplace_back();
      SkyVertex& vertex = sky_vertices_[sky_count_++];
      vertex.path = i;
      vertex.choice = choice;
      vertex.u = u;
      return;
    }
    const Ray& ray = walk(i).ray;
    single_[i] = singles_.add(i, -Vec3(d_[begin_ + i]));
    singles_[single_[i]].at =
        lambertian_.point(i, hits(i).shape[i % RayPacket::size], ray.time, ray.wavelength);
  }
  SingleVertex& single = singles_[single_[i]];
  single.choice = choice;
  single.u_light = u;
}

template <class Numbers>
void BasicPathWave<Numbers>::sample_other_lights() {
  for (SingleVertex& single : singles_) {
    if (!single.samples_light()) continue;
    if (single.choice.emitter->infinite())
      backgrounds_.add(single.choice, single.u_light, single.at.wavelength, single.light);
    else
      single.light = sample_direct_position(*scene_, single.at, single.choice, single.u_light);
  }
  for (int j = 0; j < sky_count_; ++j) {
    SkyVertex& vertex = sky_vertices_[j];
    backgrounds_.add(vertex.choice, vertex.u, walk(vertex.path).ray.wavelength, vertex.light);
  }
  backgrounds_.sample_all(*scene_);
}

template <class Numbers>
inline void BasicPathWave<Numbers>::queue_shadow(int i, const DirectLight& direct, double mis,
                                                 const Vec3f& o, const Vec3f& w, float length) {
  WaveWalk& walk = this->walk(i);
  const Spectrum light = walk.throughput * direct.radiance;
  const Color found = walk.seen(light, direct.disperses);
  ++walk.rays.occluded;
  if (scene_->has_passages())
    lights_to_pass_.push_back({light, walk.dispersed || direct.disperses, mis, walk.survival});
  shadows_.add(path_[begin_ + i], found, walk.find(walk, found, 0), o, w, length);
}

template <class Numbers>
void BasicPathWave<Numbers>::queue_lights() {
  lambertian_.unshadowed_lights(count_, rules_.strict_normals, mis_);
  for (int i = 0; i < count_; ++i)
    if (lambertian_.f[i] && lambertian_.light_weight[i] > 0)
      queue_shadow(
          i, {*lambertian_.radiance[i] * *lambertian_.f[i] * double{lambertian_.light_weight[i]}},
          scene_->has_passages() ? lambertian_.light_mis(i) : 1, lambertian_.shadow_o[i],
          lambertian_.shadow_w[i], lambertian_.shadow_length[i]);
  for (int j = 0; j < sky_count_; ++j) queue_sky(sky_vertices_[j]);
  for (const SingleVertex& single : singles_)
    if (single.samples_light()) queue_other_light(single);
}

/// See direct_light() of path_tracer.h; for a Lambertian vertex.
template <class Numbers>
void BasicPathWave<Numbers>::queue_sky(const SkyVertex& vertex) {
  const int i = vertex.path;
  const auto& [emitter, x0] = vertex.light;
  const Vec3f w(x0.at.p);
  const float weight = lambertian_.weight_from_infinity(
      i, w, static_cast<float>(x0.pdf), emitter->delta(), rules_.strict_normals, walk(i).mis);
  if (!(weight > 0)) return;
  const Spectrum radiance = emitter->eval(x0.at, -x0.at.p);
  if (is_black(radiance)) return;
  const Vec3f o =
      ray_origin(lambertian_.p[i], lambertian_.surface.ng[i], w, lambertian_.surface.extent[i]);
  const bool weighted = scene_->has_passages() && !emitter->delta();
  const double mis = weighted ? weight * x0.pdf / lambertian_.cosine(i, w) : 1;
  queue_shadow(i, {radiance * *lambertian_.f[i] * double{weight}}, mis, o, w,
               std::numeric_limits<float>::infinity());
}

/// See direct_light() of path_tracer.h.
template <class Numbers>
void BasicPathWave<Numbers>::queue_other_light(const SingleVertex& single) {
  const int i = single.path;
  const SurfacePoint& at = single.at;
  const WaveWalk& walk = this->walk(i);
  double stops = 1;
  if (scene_->has_passages() && single.light.x0.pdf > 0)
    stops = scene_->stop_probability(single.light.x0.at, direction(at, single.light.x0.at));
  double weight = 1;
  const auto mis = [&](double light, double bsdf) {
    return weight = walk.mis.weight(light, bsdf * stops);
  };
  const auto scattering = [&](const Vec3& wl) { return single.scattering(*scene_, wl); };
  const DirectLight light =
      unshadowed_light(single.light, at, rules_.strict_normals, scattering, mis);
  if (is_black(light.radiance)) return;
  if (const auto ray = scene_->segment(at, single.light.x0.at, walk.ray.time))
    queue_shadow(i, light, weight, Vec3f(ray->o), Vec3f(ray->d), static_cast<float>(ray->t_max));
}

template <class Numbers>
void BasicPathWave<Numbers>::take_step(int depth, RayCounts& rays) {
  for (int i = 0; i < count_; ++i) {
    WaveWalk& walk = this->walk(i);
    const bool lambertian = lambertian_.f[i];
    if (!(lambertian ? scatter_lambertian(i, depth, walk) : scatter_other(i, depth, walk, rays)))
      continue;
    o_.set(next_, lambertian ? lambertian_.o[i] : Vec3f(walk.ray.o));
    d_.set(next_, lambertian ? lambertian_.w[i] : Vec3f(walk.ray.d));
    ++walk.rays.intersect;
    exact_[next_] = !lambertian;
    path_[next_] = path_[begin_ + i];
    numbers_.move(next_++, begin_ + i);
  }
}

/// See go_on() of path_tracer.h; for a Lambertian vertex.
template <class Numbers>
bool BasicPathWave<Numbers>::scatter_lambertian(int i, int depth, WaveWalk& walk) {
  const double pdf = lambertian_.scatter_pdf[i];
  walk.throughput *= *lambertian_.f[i] * pi;
  if (!(pdf > 0) || vanishes(walk.throughput)) return false;
  if (depth >= rules_.rr_depth &&
      !survive(rules_, depth, numbers_.read(at_.roulette, begin_ + i), walk))
    return false;
  walk.scatter_pdf = pdf;
  walk.delta = false;
  walk.certainty = 0;
  walk.previous = Vec3(lambertian_.p[i]);
  return true;
}

template <class Numbers>
void BasicPathWave<Numbers>::scatter_in_lanes() {
  for (SingleVertex& single : singles_) {
    const int i = single.path;
    single.u_scatter = {numbers_.read(at_.lobe, begin_ + i), lambertian_.u_x[i],
                        lambertian_.u_y[i]};
  }
  singles_.scatter_in_lanes(*scene_, rules_.strict_normals);
}

/// For a vertex that is not Lambertian, if there is one.
template <class Numbers>
bool BasicPathWave<Numbers>::scatter_other(int i, int depth, WaveWalk& walk, RayCounts& rays) {
  if (single_[i] < 0) return false;
  const SingleVertex& single = singles_[single_[i]];
  const Walker walker{*scene_, walk.ray.time, rays};
  const auto sample = single.in_lanes ? single.scattered
                                      : scatter_to_light(walker, single.at, single.wc,
                                                         single.u_scatter, rules_.strict_normals);
  return sample && go_on(walker, rules_, depth, single.at, *sample,
                         numbers_.read(at_.roulette, begin_ + i), walk);
}

template class BasicPathWave<WaveNumbers>;
template class BasicPathWave<DrawnNumbers>;

}  // namespace mlt
