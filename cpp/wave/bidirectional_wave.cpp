#include "wave/bidirectional_wave.h"

namespace mlt {
namespace {

constexpr float endless = std::numeric_limits<float>::infinity();

/// Makes a shadow ray from a vertex to a light at infinity in the direction w.
void leave_scene(const JointLanes& from, int i, const Vec3f& w, JoiningRays& rays) {
  rays.o.set(i, ray_origin(from.p[i], from.ng[i], w, from.extent[i]));
  rays.w.set(i, w);
  rays.length[i] = endless;
}

/// Edges from vertices to the lens.
struct LensEdges {
  Lanes<double, JointLanes::size> x, y, z, G;  ///< Direction; G = 0: no light goes that way.
};

/// Computes edges to the lens, in double precision: an orthographic camera is far away.
void find_edges(const JointLanes& a, const JointTechnique& technique, const SurfacePoint& lens,
                bool strict, LensEdges& __restrict edges) {
  const Vec3 p = lens.p;
  for (int i = 0; i < JointLanes::size; ++i) {
    const Vec3 to_lens = p * double{technique.near[i]} - Vec3(a.p[i]);
    const double distance2 = dot(to_lens, to_lens);
    const Vec3 w = to_lens * (1 / std::sqrt(distance2));
    const auto [geometric, quotient, scatters] =
        lambertian_edge(Vec3(a.ng[i]), Vec3(a.n[i]), w, double{a.cosine[i]}, strict);
    const double G = geometric * abs_cos(lens, w) / distance2;
    edges.x[i] = w.x;
    edges.y[i] = w.y;
    edges.z[i] = w.z;
    edges.G[i] = scatters ? G : 0;
  }
}

}  // namespace

bool BidirectionalWave::supports(const Scene& scene, const BidirectionalSettings& settings) {
  const bool refracts = settings.rules.through_boundaries && RefractedLight::serves(scene);
  return settings.rules.waves && settings.sample_direct && !refracts &&
         settings.heuristic != Heuristic::maximum && !settings.manifolds &&
         !scene.has_coloured_media() && !scene.camera().clips_far();
}

BidirectionalWave::BidirectionalWave(const Scene& scene, const BidirectionalSettings& settings,
                                     Techniques techniques)
    : scene_(&scene),
      settings_(settings),
      techniques_(techniques),
      beta_(settings.heuristic),
      one_lens_(scene.camera().delta_position() && !scene.camera().shutter().opens()),
      lenses_(one_lens_ ? 1 : capacity),
      camera_(scene, settings.rules, Subpath::From::camera, settings.heuristic,
              settings.light_image),
      light_(scene, settings.rules, Subpath::From::light, settings.heuristic,
             settings.light_image && techniques == Techniques::all) {
  other_direct_.reserve(capacity);  // so that none moves
  for (int lane = 0; lane < JointLanes::size; ++lane) {
    joins_walks_.own[lane] = joins_walks_.near[lane] = 1;
    joins_walks_.onwards[lane] = inv_pi;
  }
}

void BidirectionalWave::add(uint64_t stream, const SampleIndex& index, const Vec2& corner) {
  rasters_[size()] = corner;
  numbers_.add(stream, index);
}

void BidirectionalWave::clear() {
  numbers_.clear();
  lights_found_.clear();
}

void BidirectionalWave::trace(RayCounts& rays) {
  singles_.clear();
  start_samples();
  draw_lens();
  camera_.clear();
  if (techniques_ == Techniques::all) walk_from_camera(rays);
  walk_from_lights(rays);
  take_hits(rays);
  direct_places_ = WaveNumbers::Place().begin(Stream::direct);
  const PathRules& rules = settings_.rules;
  const int most = std::min(camera_.last_place() + 1, rules.most_edges());
  for (int t = 1; t <= most; ++t) {
    choose_direct(t - 1);
    for (int s = 1; s <= light_.last_place() + 1; ++s) {
      if (!rules.wants(s + t - 1)) continue;
      joint_ = joint_number(s, t);
      emitters_ = s == 1 ? &direct_emitter_ : &walk_emitter_;
      if (t > 1)
        connect(s, t, rays);
      else if (settings_.light_image)
        connect_to_lens(s, rays);
    }
  }
  find_shadows(rays);
}

/// Finds the raster positions of samples that have no light yet.
void BidirectionalWave::start_samples() {
  WaveNumbers::Place& places = numbers_.places();
  places = {};
  numbers_.read2(places.next2(), 0, size(), &u_x_[0], &u_y_[0]);
  for (int i = 0; i < size(); ++i) {
    rasters_[i] += Vec2(u_x_[i], u_y_[i]) * cell_;
    first_[i] = last_[i] = -1;
  }
}

inline void BidirectionalWave::wait_for_shadow(const Light& light, const Waiting& waiting,
                                               const Vec3f& o, const Vec3f& w, float length) {
  const Color weighted = recorded(waiting.weighted, wavelength_[light.sample], waiting.dispersed);
  if (is_black(weighted)) return;
  const int added = add(light);
  lights_found_[added].weighted = weighted;
  if (scene_->has_passages()) waiting_.push_back(waiting);
  shadows_.add(added, weighted, light.survival, o, w, length);
}

void BidirectionalWave::take_hits(RayCounts& rays) {
  joint_ = 0;
  emitters_ = &walk_emitter_;
  const auto weighted = [](const SubpathWave::Hit& hit) {
    return hit.light * mis_weight(1, hit.scaled, hit.fixed);
  };
  for (const SubpathWave::Hit& hit : camera_.hits()) {
    const int added = add({hit.sample, true, hit.survival, hit.certainty, rasters_[hit.sample],
                           recorded(weighted(hit), wavelength_[hit.sample], hit.dispersed)});
    lights_found_[added].emitter = hit.emitter;
    take(added);
  }
  for (const SubpathWave::Hit& hit : light_.hits()) {
    make_room_for_shadows(rays);
    wait_for_shadow({hit.sample, false, hit.survival, hit.certainty, hit.raster},
                    {weighted(hit), hit.dispersed, hit.scaled, hit.fixed, hit.to_lens.medium},
                    Vec3f(hit.to_lens.o), Vec3f(hit.to_lens.d),
                    static_cast<float>(hit.to_lens.t_max));
  }
}

inline int BidirectionalWave::add(const Light& light) {
  lights_found_.push_back(light);
  lights_found_.back().joint = joint_;
  lights_found_.back().emitter = (*emitters_)[light.sample];
  return static_cast<int>(lights_found_.size()) - 1;
}

/// Links a light to those of its sample.
inline void BidirectionalWave::take(int light) {
  int& last = last_[lights_found_[light].sample];
  (last < 0 ? first_[lights_found_[light].sample] : lights_found_[last].next) = light;
  last = light;
}

void BidirectionalWave::connect(int s, int t, RayCounts& rays) {
  JoiningRays joining;
  SpectrumLanes joined;
  for (int block = 0; block < block_count(); ++block) {
    if (!light_reaches(s, block) || !camera_.reaches(t - 1, block)) continue;
    const JointLanes &a = light_joints(s, block), &b = camera_.joints(t - 1, block);
    join(a, b, technique(s, block), settings_.rules.strict_normals, beta_, lanes(), joining,
         joined);
    make_room_for_shadows(rays);
    for (int i = 0; i < JointLanes::size; ++i) {
      if (a.cosine[i] == 0 || b.cosine[i] == 0) continue;
      const int sample = block * JointLanes::size + i;
      if (a.single[i] || b.single[i]) {
        join_alone(s, sample, a, b);
        continue;
      }
      if (!(joining.length[i] > 0)) continue;
      const bool infinite = technique(s, block).near[i] == 0;
      if (infinite) leave_scene(b, i, a.p[i], joining);
      wait_for_shadow({sample, true, a.survival[i] * b.survival[i], 0, rasters_[sample]},
                      {joined.get(i, lanes()), a.dispersed[i] || b.dispersed[i], joining.others[i],
                       0, infinite ? b.medium[i] : a.medium[i]},
                      joining.o[i], joining.w[i], joining.length[i]);
    }
  }
}

/// Joins two vertices of a sample one of which is another one, or on a lens with an area. See
/// BidirectionalSampler::evaluate_connection.
void BidirectionalWave::join_alone(int s, int sample, const JointLanes& a, const JointLanes& b) {
  const int i = sample % JointLanes::size;
  const JointTechnique& technique = this->technique(s, sample / JointLanes::size);
  const bool infinite = technique.near[i] == 0;
  const PointKind kind = infinite ? PointKind::infinite : PointKind::surface;
  const WalkVertex& x = single_vertex(a, i, kind, scratch_[0]);
  const WalkVertex& y = single_vertex(b, i, PointKind::surface, scratch_[1]);
  const bool to_lens = y.vertex.kind == VertexKind::camera, sees_light = s == 1 && to_lens;
  if (sees_light && sums(a, i, 0) == 0 && scene_->camera().delta_position()) return;
  JoinedEdge joined;
  if (!joined.find(*scene_, x, y, settings_.rules.strict_normals)) return;
  if (infinite) joined.a.onwards = technique.onwards[i];
  double certainty = sees_light && !x.vertex.at.in_medium() ? 1 : 0;
  if (scene_->has_passages()) {
    if (!to_lens) joined.a.onwards *= arrival(*scene_, b, i, joined.edge.w).probability();
    const double stops = arrival(*scene_, a, i, -joined.edge.w).probability();
    joined.b.onwards *= stops;
    certainty *= stops;
  }
  const double G = joined.edge.G, own = technique.own[i];
  double below = 0, above = 0;
  if (techniques_ == Techniques::all) {
    below = beta_.over(sums(a, i, joined.a.back), joined.b.onwards * G / a.forward[i]) / own;
    above = beta_.over(sums(b, i, joined.b.back), joined.a.onwards * G / b.forward[i]) / own;
  }
  auto ray = scene_->segment(x.vertex.at, y.vertex.at, time(sample));
  if (!ray) return;
  if (scene_->has_media() && !infinite) ray->medium = medium_towards(*scene_, a, i, ray->d);
  wait_for_shadow(
      {sample, !to_lens, a.survival[i] * b.survival[i], certainty,
       to_lens ? joined.raster : rasters_[sample]},
      {joined.light * mis_weight(1, below, above), joined.a.dispersed || joined.b.dispersed,
       to_lens ? below : below + above, to_lens ? above : 0, ray->medium},
      Vec3f(ray->o), Vec3f(ray->d), static_cast<float>(ray->t_max));
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
  const JointTechnique& technique = this->technique(s, block);
  const JointLanes* lenses = nullptr;
  const SurfacePoint& lens = lenses_[0].x.vertex.at;
  LensEdges edges;
  if (one_lens_) find_edges(a, technique, lens, settings_.rules.strict_normals, edges);
  for (int i = 0; i < JointLanes::size; ++i) {
    if (a.cosine[i] == 0) continue;
    const int sample = block * JointLanes::size + i;
    if (!one_lens_ || a.single[i]) {
      if (!lenses) lenses = &lens_joints(block);
      join_alone(s, sample, a, *lenses);
      continue;
    }
    if (!(edges.G[i] > 0) || (s == 1 && a.sums[i] == 0)) continue;
    const Vec3 w(edges.x[i], edges.y[i], edges.z[i]);
    const auto projection = camera.project(lens, -w);
    if (!projection) continue;
    const double G = edges.G[i];
    double below = 0;
    if (techniques_ == Techniques::all)
      below = beta_.over(a.sums[i], projection->pdf_direction * G / a.forward[i]);
    const Light light{sample, false, a.survival[i], s == 1 ? 1. : 0., projection->raster};
    const double own = technique.own[i];
    const double share = projection->importance * G * mis_weight(own, below);
    const bool infinite = technique.near[i] == 0;
    const Waiting waiting{a.value.get(i, lanes()) * share, a.dispersed[i], below / own, 0,
                          infinite ? camera.surroundings() : a.medium[i]};
    const Vec3 entrance = camera.entrance(lens, -w);
    if (infinite) {
      wait_for_shadow(light, waiting, Vec3f(entrance), Vec3f(-w), endless);
      continue;
    }
    const Vec3f start = ray_origin(a.p[i], a.ng[i], Vec3f(w), a.extent[i]);
    const Vec3 ray = entrance - Vec3(start);
    if (!(dot(ray, w) > 0)) continue;  // behind the camera
    const double length = mlt::length(ray);
    wait_for_shadow(light, waiting, start, Vec3f(ray * (1 / length)),
                    static_cast<float>(length * (1 - ray_offset)));
  }
}

/// Makes room for eight more shadow rays.
inline void BidirectionalWave::make_room_for_shadows(RayCounts& rays) {
  if (shadows_.count() + JointLanes::size > wave_size) find_shadows(rays);
}

}  // namespace mlt
