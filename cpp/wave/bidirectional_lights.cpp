// The points on lights of samples that are traced side by side: where their walks start, and those
// that next-event estimation chooses.
#include "wave/bidirectional_wave.h"

namespace mlt {

void BidirectionalWave::walk_from_lights(RayCounts& rays) {
  light_.clear();
  WaveNumbers::Place& places = numbers_.places();
  places = places.begin(Stream::light);
  const auto at = LightNumbersOf<WaveNumbers::Place>::draw(places);
  for (int begin = 0; begin < size(); begin += block_size)
    start_at_lights(at, begin, std::min(block_size, size() - begin));
  light_.walk(numbers_, settings_.rules.most_edges(), rays);
}

/// Starts walks at lights. Emissive meshes emit as a Lambertian surface scatters light from above.
void BidirectionalWave::start_at_lights(const LightNumbersOf<WaveNumbers::Place>& at, int begin,
                                        int count) {
  numbers_.read2(at.position, begin, count, &u_x_[begin], &u_y_[begin]);
  numbers_.read2(at.direction, begin, count, &lights_.u_x[0], &lights_.u_y[0]);
  numbers_.read(at.choice, begin, count, &u_choice_[begin]);
  EmitterChoice choices[block_size];
  uint32_t triangles[block_size];
  for (int i = 0; i < count; ++i) {
    const EmitterChoice choice = scene_->choose_emitter(u_choice_[begin + i]);
    const MeshLight& light = mesh_light(choice.index);
    choices[i] = choice;
    walk_emitter_[begin + i] = choice.index;
    if (!light.mesh) continue;
    const auto point = light.mesh->sample_barycentrics({u_x_[begin + i], u_y_[begin + i]});
    lights_.set_light(i, light, choice.probability, point, wavelength_[begin + i]);
    triangles[i] = point.triangle;
  }
  lights_.surface = lights_.light;
  lights_.n = lights_.light.ng;
  VectorBlock down = {};
  for (int i = 0; i < whole_vectors(count); ++i) {
    down.set(i, -lights_.n[i]);
    lights_.back[i] = 0;
  }
  lights_.find_points(count, &down.x[0], &down.y[0], &down.z[0], false);
  lights_.sample_directions(count, false);
  for (int i = 0; i < count; ++i) {
    if (!mesh_light(choices[i].index).mesh) {
      start_at_other_light(begin + i, choices[i], {lights_.u_x[i], lights_.u_y[i]});
      continue;
    }
    const float pdf = lights_.scatter_pdf[i], forward = lights_.light_pdf[i];
    if (!(pdf > 0) || !(forward > 0) || is_black(*lights_.radiance[i])) continue;
    const float cosine = std::fabs(dot(lights_.surface.ng[i], lights_.w[i]));
    light_.start({begin + i, Vec3(lights_.p[i]), lights_.o[i], lights_.w[i], cosine, pdf, forward,
                  1, *lights_.radiance[i] * (pi / forward), 1, 1, false, false,
                  choices[i].emitter->surroundings()},
                 time(begin + i), wavelength_[begin + i], choices[i].index, triangles[i]);
  }
}

/// See walk_from_light() of subpath.h.
void BidirectionalWave::start_at_other_light(int i, const EmitterChoice& choice,
                                             const Vec2& u_direction) {
  RayCounts none;
  const Walker walker{*scene_, time(i), none, wavelength_[i]};
  const LightSample light =
      sample_light_position(*scene_, choice, {u_x_[i], u_y_[i]}, walker.time, wavelength_[i]);
  if (!(light.x0.pdf > 0)) return;
  SingleWalkVertex& end = singles_.add();
  Vertex& x0 = end.x.vertex;
  x0 = light_vertex(*light.emitter, light.x0.at);
  end.x.forward = light.x0.pdf;
  const auto [ray, pdf] = walker.emitted_ray(x0, u_direction);
  if (!(pdf > 0)) return;
  const double cosine = abs_cos(x0.at, ray.d);
  const Spectrum radiance = vertex_terms(*scene_, x0, ray.d, ray.d, false).f;
  if (is_black(radiance)) return;
  light_.start({i, x0.at.p, Vec3f(ray.o), Vec3f(ray.d), static_cast<float>(cosine),
                static_cast<float>(pdf * cosine), end.x.forward, can_be_hit(*scene_, x0) ? 1. : 0.,
                radiance / (end.x.forward * pdf), 1, x0.at.in_medium() ? 0. : 1.},
               ray, end);
}

/// See BidirectionalSampler::choose_direct.
void BidirectionalWave::choose_direct(int place) {
  const auto at = DirectNumbersOf<WaveNumbers::Place>::draw(direct_places_);
  other_direct_count_ = 0;
  for (int begin = 0; begin < size(); begin += block_size) {
    const int count = std::min(block_size, size() - begin);
    numbers_.read2(at.position, begin, count, &u_x_[begin], &u_y_[begin]);
    if (scene_->needs_light_choice()) numbers_.read(at.choice, begin, count, &u_choice_[begin]);
    for (int i = 0; i < count; i += JointLanes::size)
      choose_direct(place, (begin + i) / JointLanes::size, i);
  }
  backgrounds_.sample_all(*scene_);
  for (int j = 0; j < other_direct_count_; ++j)
    take_other_direct(other_direct_[j].sample, other_direct_[j].light);
}

/// Samples lights for s = 1 for eight samples, of which the first is number `first` of `lights_`.
void BidirectionalWave::choose_direct(int place, int block, int first) {
  if (place > 0 && !camera_.reaches(place, block)) return;
  JointLanes& to = direct_[block];
  JointTechnique& technique = direct_technique_[block];
  technique = joins_walks_;
  for (int lane = 0; lane < JointLanes::size; ++lane) {
    const int i = block * JointLanes::size + lane;
    to.cosine[lane] = 0;
    to.single[lane] = nullptr;
    to.dispersed[lane] = false;
    to.sums[lane] = to.survival[lane] = 1;
    const bool seen = place > 0 ? camera_.joints(place, block).cosine[lane] != 0 : i < size();
    if (!seen) continue;
    const Vec3 from =
        place > 0 ? position(camera_.joints(place, block), lane) : lens(i).x.vertex.at.p;
    const EmitterChoice choice = scene_->choose_emitter_for(from, u_choice_[i]);
    direct_emitter_[i] = choice.index;
    const MeshLight& light = mesh_light(choice.index);
    if (!light.mesh) {
      choose_other_direct(i, from, choice);
      continue;
    }
    const auto point = light.mesh->sample_barycentrics_for(from, {u_x_[i], u_y_[i]});
    lights_.set_light(first + lane, light, choice.probability, point, wavelength_[i]);
    const double pdf = lights_.light_pdf[first + lane];
    if (!(pdf > 0)) continue;
    const double over_walk = choice.probability / scene_->emitter_probability(choice.index) *
                             (light.mesh->area() / point.per_pdf);
    technique.own[lane] = beta_.raise(over_walk);
    to.cosine[lane] = 1;
    to.medium[lane] = choice.emitter->surroundings();
    to.forward[lane] = pdf / over_walk;
    to.value.set(lane, *lights_.radiance[first + lane] * (1 / pdf));
  }
  for (int lane = 0; lane < JointLanes::size; ++lane) {
    to.p.set(lane, lights_.light.position(first + lane));
    to.ng.set(lane, lights_.light.ng[first + lane]);
    to.n.set(lane, lights_.light.ng[first + lane]);
    to.extent[lane] = lights_.light.extent[first + lane];
  }
}

void BidirectionalWave::choose_other_direct(int i, const Vec3& from, const EmitterChoice& choice) {
  const Vec2 u(u_x_[i], u_y_[i]);
  const int added = other_direct_count_++;
  if (added == static_cast<int>(other_direct_.size())) other_direct_.emplace_back();
  other_direct_[added].sample = i;
  LightSample& light = other_direct_[added].light;
  if (choice.probability > 0 && choice.emitter->infinite()) {
    backgrounds_.add(choice, u, time(i), wavelength_[i], light);
    return;
  }
  SurfacePoint at;
  at.p = from;
  at.time = time(i);
  at.wavelength = wavelength_[i];
  light = sample_direct_position(*scene_, at, choice, u);
}

void BidirectionalWave::take_other_direct(int i, const LightSample& light) {
  const auto& [emitter, x0, radiance] = light;
  if (!(x0.pdf > 0)) return;
  if (emitter->infinite()) return take_infinite_direct(i, light);
  SingleWalkVertex& single = singles_.add();
  single.x.vertex = light_vertex(*emitter, x0.at);
  single.x.throughput = Spectrum(1 / x0.pdf);
  single.x.forward = light_position_pdf(*scene_, single.x.vertex);
  single.technique = can_be_hit(*scene_, single.x.vertex) ? 1 : 0;
  const int block = i / JointLanes::size, lane = i % JointLanes::size;
  JointLanes& to = direct_[block];
  to.single[lane] = &single;
  to.cosine[lane] = 1;
  to.forward[lane] = single.x.forward;
  direct_technique_[block].own[lane] = beta_.raise(x0.pdf / single.x.forward);
}

/// The density of a light at infinity is that of a walk.
void BidirectionalWave::take_infinite_direct(int i, const LightSample& light) {
  const Emitter* emitter = light.emitter;
  const PositionSample& x0 = light.x0;
  const Vec3 w = -x0.at.p;
  const Spectrum radiance = light.emitted(w);
  if (is_black(radiance)) return;
  const int block = i / JointLanes::size, lane = i % JointLanes::size;
  JointLanes& to = direct_[block];
  to.p.set(lane, Vec3f(x0.at.p));
  to.ng.set(lane, Vec3f(w));
  to.n.set(lane, Vec3f(w));
  to.extent[lane] = 0;
  to.cosine[lane] = 1;
  to.forward[lane] = x0.pdf;
  to.sums[lane] = emitter->delta() ? 0 : 1;
  to.value.set(lane, radiance * (1 / x0.pdf));
  direct_technique_[block].onwards[lane] = emitter->pdf_ray(x0.at, w);
  direct_technique_[block].near[lane] = 0;
}

}  // namespace mlt
