// A thin pane of glass as one surface: all reflections between its two sides are summed. With the
// Fresnel reflectance F of one side, R = F + (1 - F)^2 F (1 + F^2 + F^4 + ...) = 2 F / (1 + F) is
// reflected, and 1 - R goes straight through (Stokes 1862, "On the intensity of the light reflected
// from or transmitted through a pile of plates").
#include "base/registry.h"
#include "math/fresnel.h"
#include "scene/bsdf.h"
#include "scene/bsdf/ior_params.h"
#include "scene/bsdf/lobes.h"
#include "scene/texture.h"

namespace mlt {
namespace {

class ThinDielectric final : public Bsdf {
 public:
  explicit ThinDielectric(Params& params)
      : eta_(relative_ior_param(params)),
        reflectance_(texture_param(params, "specular_reflectance")),
        transmittance_(texture_param(params, "specular_transmittance")),
        reflection_weight_(target_luminance(reflectance_->mean())),
        transmission_weight_(target_luminance(transmittance_->mean())) {}

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3&,
                        Lobe lobe) const override {
    const double R = reflected(wl), p = reflection_probability(R);
    if (lobe == Lobe::reflection) return {R * reflectance_->eval(at), p, p};
    if (lobe == Lobe::null) return {(1 - R) * transmittance_->eval(at), 1 - p, 1 - p};
    return {};
  }

  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3& from,
                                   const Vec3& u) const override {
    if (u.x < reflection_probability(reflected(from)))
      return BsdfSample{reflect(from), Lobe::reflection};
    return BsdfSample{-from, Lobe::null};
  }

  std::optional<Vec3> invert(const SurfacePoint&, const Vec3& from, const Vec3&,
                             Lobe lobe) const override {
    const double p = reflection_probability(reflected(from));
    if (lobe == Lobe::reflection && p > 0) return Vec3(u_of_first(p), 0.5, 0.5);
    if (lobe == Lobe::null && p < 1) return Vec3(u_of_second(p), 0.5, 0.5);
    return std::nullopt;
  }

  bool has_smooth() const override { return false; }
  bool has_delta() const override { return true; }
  bool has_transmission() const override { return true; }
  double roughness(const SurfacePoint&, const Vec3&, const Vec3&) const override { return 0; }
  Color albedo(const SurfacePoint& at) const override {
    const double R = reflected({0, 0, 1});
    return R * reflectance_->eval(at) + (1 - R) * transmittance_->eval(at);
  }

 private:
  /// The same from both sides.
  double reflected(const Vec3& w) const {
    const double F = fresnel_dielectric(std::abs(w.z), eta_).reflectance;
    return 2 * F / (1 + F);
  }
  double reflection_probability(double R) const {
    return first_share(R * reflection_weight_, (1 - R) * transmission_weight_);
  }

  double eta_;
  TexturePtr reflectance_, transmittance_;
  double reflection_weight_, transmission_weight_;
};

}  // namespace

Plugin bsdf_thindielectric() {
  return make_plugin<ThinDielectric>(
      "bsdf", "thindielectric",
      "A thin pane of glass: it reflects, and light goes straight through it.",
      concat({ior_parameters("bk7"), interface_factors()}));
}

}  // namespace mlt
