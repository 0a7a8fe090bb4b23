#include "scene/bsdf/glossy_over_diffuse.h"

#include "math/warp.h"
#include "scene/bsdf/lobes.h"

namespace mlt {
namespace {

/// The factor of both reflectances that keeps their sum below 1: the rule of Mitsuba 0.6, which
/// leaves a margin of 1 % if it is needed.
double energy_scale(const Color& largest) {
  const double sum = max_component(largest);
  return sum > 1 ? 0.99 / sum : 1;
}

}  // namespace

std::vector<Parameter> GlossyOverDiffuse::parameters() {
  return {{"specular_reflectance", ParamType::texture, 0.2, "Reflectance of the glossy lobe."},
          {"diffuse_reflectance", ParamType::texture, 0.5, "Reflectance of the diffuse part."},
          {"ensure_energy_conservation", ParamType::boolean, true,
           "If the largest values of both reflectances add up to more than 1, scale both so that "
           "they add up to 0.99. Without it the surface may reflect more than it receives."}};
}

GlossyOverDiffuse::GlossyOverDiffuse(Params& params)
    : diffuse_(texture_param(params, "diffuse_reflectance")),
      specular_(texture_param(params, "specular_reflectance")) {
  if (params.boolean("ensure_energy_conservation"))
    scale_ = energy_scale(diffuse_->maximum() + specular_->maximum());
  specular_share_ =
      first_share(target_luminance(specular_->mean()), target_luminance(diffuse_->mean()));
}

Scattering GlossyOverDiffuse::scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                                         Lobe lobe) const {
  if (lobe != Lobe::smooth || !above(wl, wc)) return {};
  const Gloss g = gloss(at, wl, wc);
  return {diffuse_part(at) + glossy_part(at, g),
          diffuse_pdf(wc) + specular_share_ * g.pdf_from_light,
          diffuse_pdf(wl) + specular_share_ * g.pdf_from_camera};
}

std::optional<BsdfSample> GlossyOverDiffuse::sample(const SurfacePoint& at, const Vec3& from,
                                                    const Vec3& u) const {
  if (from.z <= 0) return std::nullopt;
  const Vec3 to = u.x < specular_share_ ? sample_gloss(at, from, direction_part(u))
                                        : sample_cosine_hemisphere(direction_part(u));
  if (to.z <= 0) return std::nullopt;
  return BsdfSample{to, Lobe::smooth};
}

std::optional<Vec3> GlossyOverDiffuse::invert(const SurfacePoint& at, const Vec3& from,
                                              const Vec3& to, Lobe lobe, const Vec3& v) const {
  if (lobe != Lobe::smooth || !above(from, to)) return std::nullopt;
  const double glossy = specular_share_ * gloss(at, from, to).pdf_from_light;
  const double lambertian = diffuse_pdf(to);
  if (!(glossy + lambertian > 0)) return std::nullopt;
  const LobeGuess guess = guess_lobe(glossy, lambertian, v.x);
  if (guess.first) return u_of(u_of_first(specular_share_, guess.rest), invert_gloss(at, from, to));
  return u_of(u_of_second(specular_share_, guess.rest), invert_cosine_hemisphere(to));
}

/// The roughness of the larger part: of the lobe, or that of a diffuse surface.
double GlossyOverDiffuse::roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const {
  if (!above(wl, wc)) return infinity;
  const double glossy = target_luminance(glossy_part(at, gloss(at, wl, wc)));
  return glossy > target_luminance(diffuse_part(at)) ? gloss_roughness(at) : infinity;
}

Spectrum GlossyOverDiffuse::albedo(const SurfacePoint& at) const {
  return scale_ * (diffuse_->eval(at) + specular_->eval(at));
}

Spectrum GlossyOverDiffuse::diffuse_part(const SurfacePoint& at) const {
  return scale_ * inv_pi * diffuse_->eval(at);
}

Spectrum GlossyOverDiffuse::glossy_part(const SurfacePoint& at, const Gloss& gloss) const {
  return scale_ * gloss.f * specular_->eval(at);
}

double GlossyOverDiffuse::diffuse_pdf(const Vec3& to) const {
  return (1 - specular_share_) * inv_pi * to.z;
}

}  // namespace mlt
