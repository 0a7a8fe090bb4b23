// Next-event estimation in a wave of paths. To be included by path_wave.cpp alone.
#pragma once

#include "wave/path_wave.h"

namespace mlt {

template <class Numbers>
Vec3 BasicPathWave<Numbers>::numbers_for_light(int i) const {
  return {scene_->needs_light_choice() ? u_choice_[i] : 0, u_light_x_[i], u_light_y_[i]};
}

template <class Numbers>
void BasicPathWave<Numbers>::choose_lights(int depth) {
  const auto wants_light = [&](int i) {
    return lambertian_.f[i] || glossy_at_[i] >= 0 ||
           (single_[i] >= 0 && wants_direct_light(*scene_, rules_, depth, singles_[single_[i]].at));
  };
  near_lights_ = false;
  for (int i = 0; i < count_; ++i) {
    if (!wants_light(i)) continue;
    Vec3 u = numbers_for_light(i);
    const Vec3 from = single_[i] >= 0 ? singles_[single_[i]].at.p : Vec3(lambertian_.p[i]);
    const EmitterChoice choice = scene_->choose_emitter_for(from, u.x);
    emitter_[i] = choice.index;
    const MeshLight& light = scene_->mesh_light(choice.index);
    if (single_[i] < 0 && light.mesh) {
      lambertian_.set_light(i, light, choice.probability,
                            light.mesh->sample_barycentrics_for(from, {u.y, u.z}),
                            walk(i).ray.wavelength);
      near_lights_ = true;
    } else {
      choose_other_light(i, choice, {u.y, u.z});
    }
  }
  sample_other_lights();
  light_glossy();
}

/// Takes a light that is no emissive mesh, or is for a vertex that is computed by itself.
template <class Numbers>
void BasicPathWave<Numbers>::choose_other_light(int i, const EmitterChoice& choice, const Vec2& u) {
  if (single_[i] < 0) {
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
    lambertian_.set_lamp(i, sample_light(i, Vec3(lambertian_.p[i]), choice, u), *scene_);
    near_lights_ = true;
    return;
  }
  SingleVertex& single = singles_[single_[i]];
  single.choice = choice;
  single.u_light = u;
}

template <class Numbers>
LightSample BasicPathWave<Numbers>::sample_light(int i, const Vec3& from,
                                                 const EmitterChoice& choice, const Vec2& u) {
  const Ray& ray = walk(i).ray;
  const LightSample light =
      sample_direct_position(*scene_, from, ray.time, ray.wavelength, choice, u);
  const SurfacePoint& x0 = light.x0.at;
  if (x0.in_medium() && light.x0.pdf > 0)
    light_stops_[i] = scene_->medium(x0).at(x0.p, x0.wavelength).extinction;
  return light;
}

template <class Numbers>
void BasicPathWave<Numbers>::sample_other_lights() {
  for (SingleVertex& single : singles_) {
    if (!single.samples_light()) continue;
    if (single.choice.emitter->infinite())
      backgrounds_.add(single.choice, single.u_light, single.at.time, single.at.wavelength,
                       single.light);
    else
      single.light = sample_light(single.path, single.at.p, single.choice, single.u_light);
  }
  for (int j = 0; j < sky_count_; ++j) {
    SkyVertex& vertex = sky_vertices_[j];
    const Ray& ray = walk(vertex.path).ray;
    backgrounds_.add(vertex.choice, vertex.u, ray.time, ray.wavelength, vertex.light);
  }
  backgrounds_.sample_all(*scene_);
}

/// Gives the lights that were sampled to the glossy vertices.
template <class Numbers>
void BasicPathWave<Numbers>::light_glossy() {
  if (near_lights_) lambertian_.unshadowed_lights(count_, rules_.strict_normals, mis_);
  for (GlossyVertex& vertex : glossy_) {
    const int i = vertex.path;
    if (!near_lights_ || !(lambertian_.light_weight[i] > 0)) continue;
    vertex.set_light(lambertian_.wl[i], lambertian_.direction_pdf[i], *lambertian_.radiance[i],
                     false);
  }
  for (int j = 0; j < sky_count_; ++j) {
    const auto& [i, choice, u, light] = sky_vertices_[j];
    if (glossy_at_[i] < 0) continue;
    const Vec3f w(light.x0.at.p);
    if (!(light.x0.pdf > 0) || !lambertian_.is_lit_from(i, w, rules_.strict_normals)) continue;
    glossy_[glossy_at_[i]].set_light(w, static_cast<float>(light.x0.pdf),
                                     light.emitted(-light.x0.at.p), light.emitter->delta());
    lambertian_.aim_at_infinity(i, w);
  }
}

template <class Numbers>
inline void BasicPathWave<Numbers>::queue_shadow(int i, const DirectLight& direct, double mis,
                                                 const Vec3f& o, const Vec3f& w, float length,
                                                 MediumIndex medium) {
  WaveWalk& walk = this->walk(i);
  const Spectrum light = walk.throughput * direct.radiance;
  const Color found = walk.seen(light, direct.disperses);
  ++walk.rays.occluded;
  if (scene_->has_passages())
    lights_to_pass_.push_back(
        {light, walk.dispersed || direct.disperses, mis, walk.survival, walk.likelihood,
         scene_->emitters()[emitter_[i]]->glowing() ? light_stops_[i] : Spectrum(1), medium});
  shadow_emitter_[shadows_.count()] = emitter_[i];
  shadows_.add(path_[begin_ + i], found, walk.find(walk, found, 0), o, w, length);
}

/// Queues the shadow ray of a vertex of `lambertian_` or `glossy_`.
template <class Numbers>
inline void BasicPathWave<Numbers>::queue_shadow(int i, const DirectLight& direct, double mis) {
  queue_shadow(i, direct, mis, lambertian_.shadow_o[i], lambertian_.shadow_w[i],
               lambertian_.shadow_length[i], this->walk(i).ray.medium);
}

template <class Numbers>
void BasicPathWave<Numbers>::queue_lights() {
  if (near_lights_) queue_near_lights();
  for (int j = 0; j < sky_count_; ++j)
    if (lambertian_.f[sky_vertices_[j].path]) queue_sky(sky_vertices_[j]);
  for (const GlossyVertex& vertex : glossy_) queue_glossy(vertex);
  for (const SingleVertex& single : singles_)
    if (single.samples_light()) queue_other_light(single);
}

template <class Numbers>
void BasicPathWave<Numbers>::queue_near_lights() {
  for (int i = 0; i < count_; ++i)
    if (lambertian_.f[i] && lambertian_.light_weight[i] > 0)
      queue_shadow(
          i, {*lambertian_.radiance[i] * *lambertian_.f[i] * double{lambertian_.light_weight[i]}},
          scene_->has_passages() ? lambertian_.light_mis(i) : 1);
}

/// See direct_light() of path_tracer.h; for a Lambertian vertex.
template <class Numbers>
void BasicPathWave<Numbers>::queue_sky(const SkyVertex& vertex) {
  const int i = vertex.path;
  const Emitter* emitter = vertex.light.emitter;
  const PositionSample& x0 = vertex.light.x0;
  const Vec3f w(x0.at.p);
  const float weight = lambertian_.weight_from_infinity(
      i, w, static_cast<float>(x0.pdf), emitter->delta(), rules_.strict_normals, walk(i).mis);
  if (!(weight > 0)) return;
  const Spectrum radiance = vertex.light.emitted(-x0.at.p);
  if (is_black(radiance)) return;
  lambertian_.aim_at_infinity(i, w);
  const bool weighted = scene_->has_passages() && !emitter->delta();
  const double mis = weighted ? weight * x0.pdf / lambertian_.cosine(i, w) : 1;
  queue_shadow(i, {radiance * *lambertian_.f[i] * double{weight}}, mis);
}

/// See direct_light() of path_tracer.h.
template <class Numbers>
void BasicPathWave<Numbers>::queue_glossy(const GlossyVertex& vertex) {
  if (!(vertex.light_pdf > 0)) return;
  const double pdf = vertex.light_pdf, cosine = std::fabs(vertex.wl.z);
  const double mis =
      vertex.delta ? 1.0 : walk(vertex.path).mis.weight(pdf, double{vertex.pdf_light});
  const Spectrum light = vertex.radiance * vertex.f_light * (cosine * mis / pdf);
  if (!is_black(light)) queue_shadow(vertex.path, {light}, mis);
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
    queue_shadow(i, light, weight, Vec3f(ray->o), Vec3f(ray->d), static_cast<float>(ray->t_max),
                 scene_->has_media() ? scene_->medium_towards(at, ray->d) : no_medium);
}

template <class Numbers>
void BasicPathWave<Numbers>::find_shadows(RayCounts& rays) {
  rays.count_occluded(shadows_.count());
  shadows_.trace(
      scene_->accel(), [&](int path) { return walks_[path].ray.time; },
      [&](int shadow, const Color& radiance, double share) {
        if (scene_->has_media() && lights_to_pass_[shadow].medium != no_medium)
          return receive_through(shadow, false);
        receive(shadows_.path(shadow), shadow_emitter_[shadow], radiance * share);
      },
      [&](int shadow) { receive_through(shadow, true); });
  lights_to_pass_.clear();
}

/// See direct_light() of path_tracer.h: what lies on the way changes the light, and its weight,
/// since a walk may stop there.
template <class Numbers>
void BasicPathWave<Numbers>::receive_through(int shadow, bool passes_surfaces) {
  const LightToPass& to_pass = lights_to_pass_[shadow];
  WaveWalk& walk = walks_[shadows_.path(shadow)];
  Ray ray = shadows_.ray(shadow, walk.ray.time);
  ray.wavelength = walk.ray.wavelength;
  ray.medium = to_pass.medium;
  const Passage seen = scene_->pass(ray, passes_surfaces);
  if (seen.is_blocked()) return;
  const double goes = seen.probability * mean(to_pass.likelihood * seen.flight * to_pass.stops);
  const double mis = mis_weight(1, (1 / to_pass.mis - 1) * walk.mis.raise(goes));
  const Color found = recorded(to_pass.light * seen.transmittance * (mis / to_pass.mis),
                               ray.wavelength, to_pass.disperses);
  receive(shadows_.path(shadow), shadow_emitter_[shadow],
          found * walk.weights.of(found, to_pass.survival, 0));
}

}  // namespace mlt
