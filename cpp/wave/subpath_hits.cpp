// What the walks of a wave meet: vertices in lanes and single ones, lights, the lens.
#include "wave/subpath_wave.h"

namespace mlt {

void SubpathWave::find_surface_point(int walk, SurfacePoint& at) {
  const Ray& ray = exact_ray(walk);
  if (const WaveLeg* leg = this->leg(walk))
    scene_->find_surface_point(leg->ray, leg->hit, at);
  else
    scene_->find_surface_point(ray, hit(walk), at);
}

void SubpathWave::find_vertices(int place) {
  for (int i = 0; i < count_; ++i) find_vertex(i, place);
}

/// Whether vertices on a Lambertian mesh are computed together. Rays from boundaries may go into
/// two media; behind panes, where there are no media, double precision is kept.
inline bool SubpathWave::is_in_lanes(uint32_t shape, const WaveLeg* leg) const {
  return scene_->has_media() ? !scene_->media().is_boundary(shape) : !leg;
}

inline void SubpathWave::find_vertex(int i, int place) {
  const int walk = begin_ + i;
  lambertian_.f[i] = nullptr;
  single_[i] = nullptr;
  if (const WaveLeg* leg = this->leg(walk))
    find_behind(i, place, *leg);
  else
    find_on_surface(i, place, hit(walk), nullptr);
}

/// Finds the vertex at the end of a leg.
void SubpathWave::find_behind(int i, int place, const WaveLeg& leg) {
  if (leg.in_medium())
    find_in_medium(i, place, leg);
  else
    find_on_surface(i, place, leg.hit, &leg);
}

/// Finds the vertex where a ray has hit a surface, or none.
inline void SubpathWave::find_on_surface(int i, int place, const mlt::Hit& hit,
                                         const WaveLeg* leg) {
  const int walk = begin_ + i;
  if (hit.shape == SurfacePoint::no_shape) {
    if (pass(i, place, nullptr)) leave_scene(walk, place);
    return;
  }
  const LaneMesh& shape = scene_->lane_mesh(hit.shape);
  if (!(shape.lambertian && is_in_lanes(hit.shape, leg))) return find_other(i, place);
  if (!pass(i, place, nullptr)) return;
  if (shape.emits && !from_light_) {
    SurfacePoint at;
    find_surface_point(walk, at);
    find_light(walk, place, at);
  }
  const int sample = sample_[walk];
  lambertian_.set(i, shape, hit.primitive, hit.u, hit.v, time_[sample], wavelength_[sample]);
}

void SubpathWave::leave_scene(int walk, int place) {
  if (from_light_ || !rules_.wants(place) || scene_->infinite_emitters().empty()) return;
  const Ray& ray = exact_ray(walk);
  for (const uint32_t emitter : scene_->infinite_emitters())
    hit_light(*scene_->emitters()[emitter], walk, place, Scene::point_at_infinity(ray));
}

void SubpathWave::find_light(int walk, int place, const SurfacePoint& at) {
  if (from_light_ || !rules_.wants(place)) return;
  if (const Emitter* emitter = scene_->emitter(at)) hit_light(*emitter, walk, place, at);
}

/// Finds a vertex that is not a Lambertian one on a mesh.
void SubpathWave::find_other(int i, int place) {
  SurfacePoint at;
  find_surface_point(begin_ + i, at);
  if (!pass(i, place, &at)) return;
  find_light(begin_ + i, place, at);
  add_single(i, at);
}

/// Adds a vertex that is computed alone.
void SubpathWave::add_single(int i, const SurfacePoint& at) {
  const int walk = begin_ + i;
  single_[i] = &(BsdfAt(*scene_, at).has_smooth() ? singles_ : passed_).add();
  WalkVertex& x = single_[i]->x;
  x.vertex.at = at;
  x.towards_previous = -ray_[walk].d;
  if (scene_->has_passages()) x.passed = transmitted_[i];
  x.throughput = throughput_[walk];
  x.survival = survival_[walk];
  x.dispersed = dispersed_[walk];
  lambertian_.set_position(i, at);
}

/// How often next-event estimation at a point counts as technique s = 1 with x_0 where the walk has
/// started (TechniqueSums): its density over that of a walk.
double SubpathWave::direct_technique(int walk, const SurfacePoint& from) const {
  if (const SingleWalkVertex* light = single_light_[walk])
    return beta_.raise(direct_position_pdf(*scene_, light->x.vertex, from) / light->x.forward);
  const uint32_t light = light_[walk];
  double quotient = 1;
  if (scene_->light_choice().depends_on_point())
    quotient *= scene_->emitter_probability_for(light, from.p) / scene_->emitter_probability(light);
  if (const Mesh& mesh = *scene_->mesh_light(light).mesh; mesh.chooses_by_point())
    quotient *= mesh.direct_density(triangle_[walk], from.p) * mesh.area();
  return beta_.raise(quotient);
}

/// See BidirectionalSampler::evaluate_hit_light.
void SubpathWave::hit_light(const Emitter& emitter, int walk, int place, const SurfacePoint& at) {
  const Vertex x0 = light_vertex(emitter, at);
  if (!can_be_hit(*scene_, x0)) return;
  const Vec3 w = -ray_[walk].d;
  const VertexTerms terms = vertex_terms(*scene_, x0, w, w, rules_.strict_normals);
  if (is_black(terms.f)) return;
  SurfacePoint previous;
  previous.p = previous_[walk];
  const double from_light = light_position_pdf(*scene_, x0);
  const double direct = can_join_before(walk, place)
                            ? beta_.raise(direct_position_pdf(*scene_, x0, previous) / from_light)
                            : 0;
  const double per_area = at.infinite() ? 1 : abs_cos(at, w) / distance2(walk, at.p);
  const double reverse = terms.pdf_from_light * cosine_[walk] * per_area * stops_back_[walk];
  const double above = beta_.over(direct + beta_.over(sums_[walk], reverse / forward_[walk]),
                                  from_light / (pdf_[walk] * per_area));
  hits_.push_back({sample_[walk], throughput_[walk] * terms.f, 0, above, dispersed_[walk],
                   survival_[walk], certainty_[walk], emitter.index()});
}

/// See BidirectionalSampler::evaluate_hit_lens; the walk goes on at its vertex of this place.
void SubpathWave::hit_lens(int walk, int place) {
  if (!rules_.wants(place + 1)) return;
  const Camera& camera = scene_->camera();
  Ray ray = exact_ray(walk);
  auto hit = camera.hit_lens(ray);
  if (!hit) return;
  hit->wavelength = ray.wavelength;
  const auto [terms, raster] = lens_terms(*scene_, *hit, -ray.d);
  if (is_black(terms.f) || !raster) return;
  const double technique = place == 0 ? direct_technique(walk, *hit) : !delta_[walk];
  const double per_area = abs_cos(*hit, ray.d) / distance2(walk, hit->p);
  const double stops = stops_back_[walk];
  const double reverse = terms.pdf_from_camera * cosine_[walk] * per_area * stops;
  const double over_lens = camera.pdf_position(*hit) / (pdf_[walk] * per_area);
  const double before = beta_.over(sums_[walk], reverse / forward_[walk]);
  const double distance = dot(camera.entrance(*hit, -ray.d) - ray.o, ray.d);
  if (!(distance > 0)) return;
  ray.t_max = distance * (1 - ray_offset);
  hits_.push_back({sample_[walk], throughput_[walk] * terms.f, beta_.over(before, over_lens),
                   beta_.over(technique, over_lens), dispersed_[walk], survival_[walk],
                   certainty_[walk] * stops, 0, *raster, ray});
}

}  // namespace mlt
