// What the walks of a wave meet beside Lambertian surfaces: lights, the lens, single vertices.
#include "wave/subpath_wave.h"

namespace mlt {

void SubpathWave::find_surface_point(int walk, SurfacePoint& at) {
  const PacketHits& found = found_[walk / RayPacket::size];
  scene_->find_surface_point(exact_ray(walk), found.hit(walk % RayPacket::size), at);
}

void SubpathWave::leave_scene(int walk, int place) {
  if (from_light_ || !rules_.wants(place) || scene_->infinite_emitters().empty()) return;
  const Ray& ray = exact_ray(walk);
  for (const uint32_t emitter : scene_->infinite_emitters())
    hit_light(*scene_->emitters()[emitter], walk, place,
              Scene::point_at_infinity(ray.d, ray.wavelength));
}

void SubpathWave::find_light(int walk, int place, const SurfacePoint& at) {
  if (from_light_ || !rules_.wants(place)) return;
  if (const Emitter* emitter = scene_->emitter(at)) hit_light(*emitter, walk, place, at);
}

/// Finds a vertex that is not Lambertian, or is behind a surface that the walk passes.
void SubpathWave::find_other(int i, int place, RayCounts& rays) {
  const int walk = begin_ + i;
  SurfacePoint at;
  find_surface_point(walk, at);
  Spectrum passed(1);
  if (scene_->bsdf(at).has_passage() && !go_through(walk, place, at, passed, rays)) return;
  find_light(walk, place, at);
  single_[i] = &(BsdfAt(*scene_, at).has_smooth() ? singles_ : passed_).add();
  WalkVertex& x = single_[i]->x;
  x.vertex.at = at;
  x.towards_previous = -ray_[walk].d;
  x.passed = passed;
  x.throughput = throughput_[walk];
  x.survival = survival_[walk];
  x.dispersed = dispersed_[walk];
  lambertian_.set_position(i, at);
}

/// Follows a walk on from a surface that light passes, and takes what it passes (Subpath::pass);
/// false if it does not stop in the scene.
bool SubpathWave::go_through(int walk, int place, SurfacePoint& at, Spectrum& passed,
                             RayCounts& rays) {
  const Ray& ray = exact_ray(walk);
  Passage leg;
  const double u = numbers_.read(leg_, walk);
  const bool hit = Walker{*scene_, ray.time, rays}.go_on(ray, u, true, at, leg);
  if (leg.is_blocked()) return false;
  if (!hit) at = Scene::point_at_infinity(ray.d, ray.wavelength);
  const double passes = scene_->arrival(leg, at, ray.d).probability();
  passed = leg.transmittance / passes;
  throughput_[walk] *= passed;
  pdf_[walk] *= static_cast<float>(passes);
  if (from_light_ || place > 1) stops_back_[walk] *= leg.probability;
  if (!from_light_) certainty_[walk] *= passes;
  if (!hit) leave_scene(walk, place);
  return hit;
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
