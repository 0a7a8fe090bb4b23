#include "mutation/chain_perturbation.h"

#include "path/half_vector.h"
#include "path/walk.h"

namespace mlt {

std::vector<Parameter> step_size_parameters() {
  const StepSizes steps;
  return {{"smallest_pixels", ParamType::real, steps.smallest_pixels,
           "Smallest move on the image, in pixels."},
          {"largest_share", ParamType::real, steps.largest_share,
           "Largest move on the image, as a share of its diagonal."}};
}

StepSizes step_sizes(Params& params) {
  return {params.real_in("smallest_pixels", 1e-6, 1e3), params.real_in("largest_share", 1e-6, 1)};
}

ChainPerturbation::ChainPerturbation(const Scene& scene, const StepSizes& steps) : scene_(&scene) {
  const Raster& raster = scene.camera().raster();
  const double diagonal = std::hypot(raster.size.x, raster.size.y);
  image_radius_ = ExponentialRadius(
      steps.smallest_pixels, std::max(2 * steps.smallest_pixels, steps.largest_share * diagonal));
}

double ChainPerturbation::raster_per_direction(const PathState& x) const {
  const Camera& camera = scene_->camera();
  const int k = x.edges();
  const double direction = x.terms.passages.empty()
                               ? x.terms[k].vertex.pdf_from_camera
                               : camera.pdf_direction(x[k].at, x.terms.direction(k, -1));
  return direction * camera.raster().sampled_area();
}

double ChainPerturbation::pixel_angle(const PathState& x) const {
  const int k = x.edges();
  const double cos_lens = abs_cos(x[k].at, x.terms.direction(k, -1));
  return std::sqrt(1 / (raster_per_direction(x) * cos_lens));
}

/// Veach 1997, eq. 11.11: the angle that a pixel subtends at the lens, times the length of the
/// path between the lens and the chain's near end over the length of the chain.
ExponentialRadius ChainPerturbation::angle(const PathState& x, int i, int stop, int step) const {
  const int k = x.edges();
  double seen = 0, chain = 0;
  for (int j = step > 0 ? stop : i; j < k; ++j) seen += x.terms[j].distance;
  for (int j = i; j != stop; j += step)
    if (const double edge = x.terms[std::min(j, j + step)].distance; edge < infinity) chain += edge;
  const ExponentialRadius radius = image_radius_ * (pixel_angle(x) * seen / chain);
  if (radius.largest <= 0.5 * pi) return radius;
  return {std::min(radius.smallest, 0.25 * pi), 0.5 * pi};
}

Vec3 ChainPerturbation::perturb(const Vec3& w, const ExponentialRadius& angle, Rng& rng) {
  const double theta = angle.sample(rng.next()), phi = 2 * pi * rng.next();
  const Frame frame = Frame::around(w);
  return frame.to_world(
      {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
}

bool ChainPerturbation::carry(const PathState& x, const Span& span, Ray ray, PathState& y,
                              MutationContext& context) const {
  const Walker walker{*scene_, y.path.time, context.rays};
  // A light at infinity stays the one that it is; a surface may be that of any light.
  const auto background = [&] {
    return x[0].at.infinite() ? scene_->emitters()[x[0].emitter].get() : nullptr;
  };
  for (int i = span.start + span.step;; i += span.step) {
    const double u_leg = walker.draw_leg(context.rng);
    const auto arrive = [&](SurfacePoint& at) {
      if (!scene_->has_media()) return walker.arrive(ray, u_leg, at);
      return walker.arrive_at(kept_distance(x, i, span.step, ray), ray, u_leg, at);
    };
    if (i == 0) {
      SurfacePoint at;
      const bool hit = arrive(at);
      return walker.find_light(ray, hit, at, background, y.path[0]) &&
             y[0].at.infinite() == x[0].at.infinite();
    }
    y.path[i] = {};
    if (!arrive(y.path[i].at)) return false;
    y.path[i].lobe = x[i].lobe;
    if (i == span.stop) return true;
    const auto out = carried_direction(x, y, i, span, -ray.d, context);
    if (!out) return false;
    ray = walker.leave(y[i].at, *out);
  }
}

double ChainPerturbation::kept_distance(const PathState& x, int i, int step, const Ray& ray) const {
  const SurfacePoint &from = x[i - step].at, &to = x[i].at;
  if (!to.in_medium()) return infinity;
  if (from.infinite()) return distance_to(to.p, ray);
  return length(to.p - scene_->edge_end(from, x.terms.direction(i - step, step)));
}

std::optional<Vec3> ChainPerturbation::carried_direction(const PathState& x, const PathState& y,
                                                         int i, const Span& span, const Vec3& in,
                                                         MutationContext& context) const {
  const int step = span.step;
  if (!x.specular(i)) {
    if (span.keeps) return x.terms.direction(i, step);
    const int stop = chain_end(x, i, step);
    return perturb(x.terms.direction(i, step), angle(x, i, stop, step), context.rng);
  }
  const SurfacePoint& from = x[i].at;
  const SurfacePoint& at = y[i].at;
  const Vec3 x_in = from.shading.to_local(x.terms.direction(i, -step));
  const Vec3 x_out = from.shading.to_local(x.terms.direction(i, step));
  const Vec3 y_in = at.shading.to_local(in);
  if (!same_side(x_in, y_in) && !x[i].delta()) return std::nullopt;
  const std::optional<Vec3> h =
      x[i].delta() ? scene_->bsdf(at).delta_normal(at, y_in)
                   : half_vector(x_in, x_out, scene_->bsdf(from).relative_eta(from, x_in));
  if (!h) return std::nullopt;
  const bool reflected = x[i].delta() ? x[i].lobe == Lobe::reflection : same_side(x_in, x_out);
  const auto y_out = reflected ? reflect_about(y_in, *h)
                               : refract_about(y_in, *h, scene_->bsdf(at).relative_eta(at, y_in));
  if (!y_out) return std::nullopt;
  return at.shading.to_world(*y_out);
}

double ChainPerturbation::coefficient(const PathState& x, const PathState& y, int i,
                                      const Span& span) const {
  const int step = span.step;
  const SurfacePoint& at = y[i].at;
  const Vec3 in = y.terms.direction(i, -step), out = y.terms.direction(i, step);
  const Arrival arrival = y.terms.arrival(i, step);
  if (!x.specular(i)) {
    if (span.keeps) return arrival.stops / abs_cos(at, out);
    const int stop = chain_end(x, i, step);
    const double theta = angle_between(out, x.terms.direction(i, step));
    return angle(x, i, stop, step).angular_pdf(theta) / abs_cos(at, out) * arrival.stops;
  }
  const Bsdf& bsdf = scene_->bsdf(at);
  const Vec3 local_in = at.shading.to_local(in), local_out = at.shading.to_local(out);
  if (y[i].delta()) {
    // A perturbation keeps the lobe, so the probability of choosing it is taken out of the
    // coefficient of the delta (VertexTerms).
    const double chosen = bsdf.pdf(at, local_in, local_out, y[i].lobe);
    const VertexTerms& terms = y.terms[i].vertex;
    return (step < 0 ? terms.pdf_from_camera : terms.pdf_from_light) / (chosen * arrival.flown());
  }
  const double eta = bsdf.relative_eta(at, local_in);
  const auto h = half_vector(local_in, local_out, eta);
  if (!h) return 0;
  return half_vector_jacobian(local_in, local_out, *h, eta) / abs_cos(at, out) * arrival.stops;
}

}  // namespace mlt
