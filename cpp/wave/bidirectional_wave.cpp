#include "wave/bidirectional_wave.h"

namespace mlt {
namespace {

/// Edges from vertices to the lens.
struct LensEdges {
  Lanes<double, JointLanes::size> x, y, z, G;  ///< Direction; G = 0: no light goes that way.
};

/// Computes edges to the lens, in double precision: an orthographic camera is far away.
void find_edges(const JointLanes& a, const SurfacePoint& lens, bool strict,
                LensEdges& __restrict edges) {
  const Vec3 p = lens.p, axis = lens.ng;
  for (int i = 0; i < JointLanes::size; ++i) {
    const Vec3 to_lens = p - Vec3(a.p[i]);
    const double distance2 = dot(to_lens, to_lens);
    const Vec3 w = to_lens * (1 / std::sqrt(distance2));
    const auto [geometric, quotient, scatters] =
        lambertian_edge(Vec3(a.ng[i]), Vec3(a.n[i]), w, double{a.cosine[i]}, strict);
    const double G = geometric * std::fabs(dot(axis, w)) / distance2;
    edges.x[i] = w.x;
    edges.y[i] = w.y;
    edges.z[i] = w.z;
    edges.G[i] = scatters ? G : 0;
  }
}

}  // namespace

bool BidirectionalWave::supports(const Scene& scene, const BidirectionalSettings& settings) {
  const Shutter& shutter = scene.camera().shutter();
  if (!settings.sample_direct || settings.heuristic == Heuristic::maximum || settings.manifolds)
    return false;
  if (scene.has_passages() || !scene.camera().delta_position() || shutter.open != shutter.close ||
      scene.accel().moves())
    return false;
  for (const EmitterPtr& emitter : scene.emitters())
    if (!scene.mesh_light(emitter->index()).mesh) return false;
  return true;
}

BidirectionalWave::BidirectionalWave(const Scene& scene, const BidirectionalSettings& settings)
    : scene_(&scene),
      settings_(settings),
      beta_(settings.heuristic),
      lens_(scene.camera().sample_position({0.5, 0.5}, scene.camera().shutter().open)),
      camera_(scene, settings.rules, Subpath::From::camera, settings.heuristic,
              settings.light_image),
      light_(scene, settings.rules, Subpath::From::light, settings.heuristic,
             settings.light_image) {}

void BidirectionalWave::add(uint64_t stream, uint32_t index, const Vec2& pixel) {
  rasters_[size()] = pixel;
  numbers_.add(stream, index);
}

void BidirectionalWave::clear() {
  numbers_.clear();
  lights_found_.clear();
}

void BidirectionalWave::trace(RayCounts& rays) {
  walk_from_camera(rays);
  walk_from_lights(rays);
  fall_back_together();
  take_hits();
  direct_places_ = WaveNumbers::Place().begin(Stream::direct);
  const PathRules& rules = settings_.rules;
  const int most = std::min(camera_.last_place() + 1, rules.most_edges());
  for (int t = 1; t <= most; ++t) {
    choose_direct(t - 1);
    for (int s = 1; s <= light_.last_place() + 1; ++s) {
      if (!rules.wants(s + t - 1)) continue;
      if (t > 1)
        connect(s, t, rays);
      else if (settings_.light_image)
        connect_to_lens(s, rays);
    }
  }
  find_shadows(rays);
}

/// See BidirectionalSampler::walk_from_camera.
void BidirectionalWave::walk_from_camera(RayCounts& rays) {
  const Camera& camera = scene_->camera();
  camera_.clear(size());
  WaveNumbers::Place& places = numbers_.places();
  places = {};
  numbers_.read2(places.next2(), 0, size(), &u_x_[0], &u_y_[0]);
  places = places.begin(Stream::camera);
  LensNumbersOf<WaveNumbers::Place>::draw(places);
  draw_wavelengths();
  for (int i = 0; i < size(); ++i) {
    rasters_[i] += Vec2(u_x_[i], u_y_[i]);
    first_[i] = last_[i] = -1;
    const Ray ray = camera.ray(rasters_[i], {}, lens_.at.time);
    const auto projection = camera.project(lens_.at, ray.d);
    if (!projection) continue;
    const double cosine = abs_cos(lens_.at, ray.d);
    camera_.start(i,
                  {Vec3f(lens_.at.p), Vec3f(ray.o), Vec3f(ray.d), static_cast<float>(cosine),
                   static_cast<float>(projection->pdf_direction * cosine), 1, 0,
                   Spectrum(projection->importance / projection->pdf_direction), wavelength_[i]});
  }
  camera_.walk(numbers_, settings_.rules.most_edges() + 1, rays);
}

void BidirectionalWave::draw_wavelengths() {
  const Camera& camera = scene_->camera();
  if (camera.spectral()) numbers_.read(numbers_.places().next(), 0, size(), &u_choice_[0]);
  for (int i = 0; i < size(); ++i) wavelength_[i] = camera.wavelength([&] { return u_choice_[i]; });
}

void BidirectionalWave::walk_from_lights(RayCounts& rays) {
  light_.clear(size());
  WaveNumbers::Place& places = numbers_.places();
  places = places.begin(Stream::light);
  const auto at = LightNumbersOf<WaveNumbers::Place>::draw(places);
  for (int begin = 0; begin < size(); begin += block_size)
    start_at_lights(at, begin, std::min(block_size, size() - begin));
  light_.walk(numbers_, settings_.rules.most_edges(), rays);
}

/// Starts walks at lights, which emit as a Lambertian surface scatters light from above.
void BidirectionalWave::start_at_lights(const LightNumbersOf<WaveNumbers::Place>& at, int begin,
                                        int count) {
  numbers_.read2(at.position, begin, count, &u_x_[begin], &u_y_[begin]);
  numbers_.read2(at.direction, begin, count, &lights_.u_x[0], &lights_.u_y[0]);
  numbers_.read(at.choice, begin, count, &u_choice_[begin]);
  uint32_t chosen[block_size], triangles[block_size];
  for (int i = 0; i < count; ++i) {
    const EmitterChoice choice = scene_->choose_emitter(u_choice_[begin + i]);
    const MeshLight& light = scene_->mesh_light(choice.index);
    const auto point = light.mesh->sample_barycentrics({u_x_[begin + i], u_y_[begin + i]});
    lights_.set_light(i, light, choice.probability, point, wavelength_[begin + i]);
    chosen[i] = choice.index;
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
    const float pdf = lights_.scatter_pdf[i], forward = lights_.light_pdf[i];
    if (camera_.fell_back(begin + i) || !(pdf > 0) || !(forward > 0) ||
        is_black(*lights_.radiance[i]))
      continue;
    const float cosine = std::fabs(dot(lights_.surface.ng[i], lights_.w[i]));
    light_.start(begin + i, {lights_.p[i], lights_.o[i], lights_.w[i], cosine, pdf, forward, 1,
                             *lights_.radiance[i] * (pi / forward), wavelength_[begin + i],
                             chosen[i], triangles[i]});
  }
}

void BidirectionalWave::fall_back_together() {
  for (int i = 0; i < size(); ++i)
    if (camera_.fell_back(i) || light_.fell_back(i)) {
      camera_.fall_back(i);
      light_.fall_back(i);
    }
}

void BidirectionalWave::take_hits() {
  for (const SubpathWave::Hit& hit : camera_.hits())
    if (!fell_back(hit.sample))
      take(add({hit.sample, hit.place, true, hit.survival, rasters_[hit.sample],
                recorded(hit.weighted, wavelength_[hit.sample])}));
}

inline int BidirectionalWave::add(const Light& light) {
  lights_found_.push_back(light);
  return static_cast<int>(lights_found_.size()) - 1;
}

/// Links a light to those of its sample.
inline void BidirectionalWave::take(int light) {
  int& last = last_[lights_found_[light].sample];
  (last < 0 ? first_[lights_found_[light].sample] : lights_found_[last].next) = light;
  last = light;
}

/// See BidirectionalSampler::choose_direct.
void BidirectionalWave::choose_direct(int place) {
  const auto at = DirectNumbersOf<WaveNumbers::Place>::draw(direct_places_);
  for (int begin = 0; begin < size(); begin += block_size) {
    const int count = std::min(block_size, size() - begin);
    numbers_.read2(at.position, begin, count, &u_x_[begin], &u_y_[begin]);
    if (scene_->emitters().size() > 1) numbers_.read(at.choice, begin, count, &u_choice_[begin]);
    for (int i = 0; i < count; i += JointLanes::size)
      choose_direct(place, (begin + i) / JointLanes::size, i);
  }
}

/// Samples lights for s = 1 for eight samples, of which the first is number `first` of `lights_`.
void BidirectionalWave::choose_direct(int place, int block, int first) {
  if (place > 0 && !camera_.reaches(place, block)) return;
  JointLanes& to = direct_[block];
  for (int lane = 0; lane < JointLanes::size; ++lane) {
    const int i = block * JointLanes::size + lane;
    to.cosine[lane] = 0;
    const bool seen =
        place > 0 ? camera_.joints(place, block).cosine[lane] != 0 : i < size() && !fell_back(i);
    if (!seen) continue;
    const Vec3 from = place > 0 ? Vec3(camera_.joints(place, block).p[lane]) : lens_.at.p;
    const EmitterChoice choice = scene_->choose_emitter_for(from, u_choice_[i]);
    const MeshLight& light = scene_->mesh_light(choice.index);
    const auto point = light.mesh->sample_barycentrics_for(from, {u_x_[i], u_y_[i]});
    lights_.set_light(first + lane, light, choice.probability, point, wavelength_[i]);
    const double pdf = lights_.light_pdf[first + lane];
    if (!(pdf > 0)) continue;
    const double over_walk = choice.probability / scene_->emitter_probability(choice.index) *
                             (light.mesh->area() / point.per_pdf);
    direct_own_[block][lane] = beta_.raise(over_walk);
    to.cosine[lane] = 1;
    to.forward[lane] = pdf / over_walk;
    to.value.set(lane, *lights_.radiance[first + lane] * (1 / pdf));
  }
  for (int lane = 0; lane < JointLanes::size; ++lane) {
    to.p.set(lane, lights_.light.position(first + lane));
    to.ng.set(lane, lights_.light.ng[first + lane]);
    to.n.set(lane, lights_.light.ng[first + lane]);
    to.extent[lane] = lights_.light.extent[first + lane];
  }
  for (double& sum : to.sums.values) sum = 1;
  for (double& survival : to.survival.values) survival = 1;
}

void BidirectionalWave::connect(int s, int t, RayCounts& rays) {
  JoiningRays joining;
  SpectrumLanes joined;
  for (int block = 0; block < block_count(); ++block) {
    if (!light_reaches(s, block) || !camera_.reaches(t - 1, block)) continue;
    const JointLanes &a = light_joints(s, block), &b = camera_.joints(t - 1, block);
    join(a, b, own(s, block), settings_.rules.strict_normals, beta_, lanes(), joining, joined);
    make_room_for_shadows(rays);
    for (int i = 0; i < JointLanes::size; ++i) {
      if (!(joining.length[i] > 0)) continue;
      const int sample = block * JointLanes::size + i;
      const Color weighted = recorded(joined.get(i, lanes()), wavelength_[sample]);
      if (is_black(weighted)) continue;
      wait_for_shadow(
          {sample, s + t - 1, true, a.survival[i] * b.survival[i], rasters_[sample], weighted},
          joining.o[i], joining.w[i], joining.length[i]);
    }
  }
}

void BidirectionalWave::connect_to_lens(int s, RayCounts& rays) {
  for (int block = 0; block < block_count(); ++block)
    if (light_reaches(s, block)) {
      make_room_for_shadows(rays);
      connect_to_lens(s, block);
    }
}

void BidirectionalWave::connect_to_lens(int s, int block) {
  const Camera& camera = scene_->camera();
  const JointLanes& a = light_joints(s, block);
  LensEdges edges;
  find_edges(a, lens_.at, settings_.rules.strict_normals, edges);
  for (int i = 0; i < JointLanes::size; ++i) {
    if (!(edges.G[i] > 0)) continue;
    const Vec3 w(edges.x[i], edges.y[i], edges.z[i]);
    const auto projection = camera.project(lens_.at, -w);
    if (!projection) continue;
    const double G = edges.G[i];
    const double below = beta_.over(a.sums[i], projection->pdf_direction * G / a.forward[i]);
    const double own = this->own(s, block)[i];
    const double share = projection->importance * G * own / (own + below);
    const Color weighted =
        recorded(a.value.get(i, lanes()) * share, wavelength_[block * JointLanes::size + i]);
    if (is_black(weighted)) continue;
    const Vec3f start = ray_origin(a.p[i], a.ng[i], Vec3f(w), a.extent[i]);
    const Vec3 ray = camera.entrance(lens_.at, -w) - Vec3(start);
    if (!(dot(ray, w) > 0)) continue;  // behind the camera
    const double length = mlt::length(ray);
    wait_for_shadow(
        {block * JointLanes::size + i, s, false, a.survival[i], projection->raster, weighted},
        start, Vec3f(ray * (1 / length)), static_cast<float>(length * (1 - ray_offset)));
  }
}

inline void BidirectionalWave::wait_for_shadow(const Light& light, const Vec3f& o, const Vec3f& w,
                                               float length) {
  shadows_.add(add(light), light.weighted, light.survival, o, w, length);
}

/// Makes room for eight more shadow rays.
inline void BidirectionalWave::make_room_for_shadows(RayCounts& rays) {
  if (shadows_.count() + JointLanes::size > wave_size) find_shadows(rays);
}

void BidirectionalWave::find_shadows(RayCounts& rays) {
  rays.count_occluded(shadows_.count());
  shadows_.trace(
      scene_->accel(), [](int) { return 0.0; },
      [&](int light, const Color&, double) { take(light); }, [](int) {});
}

}  // namespace mlt
