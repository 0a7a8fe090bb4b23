// A surface that darkens towards its rim, as the moon's seas do (Minnaert 1941, "The reciprocity
// principle in lunar photometry"):
//   f = reflectance (k + 1) / (2 pi) (cos_l cos_c)^(k - 1).
// Lambertian for k = 1. Left out: k < 1, where more light may leave than arrives.
#include "base/registry.h"
#include "math/warp.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/lobes.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

class Minnaert final : public Bsdf {
 public:
  explicit Minnaert(Params& params)
      : rho_(texture_param(params, "reflectance")), k_(params.real_in("k", 1, 100)) {}

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (lobe != Lobe::smooth || !above(wl, wc)) return {};
    const double f = (k_ + 1) / (2 * pi) * std::pow(wl.z * wc.z, k_ - 1);
    return {f * rho_->eval(at), cosine_power_pdf(wc, k_), cosine_power_pdf(wl, k_)};
  }
  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3& from,
                                   const Vec3& u) const override {
    const Vec3 to = sample_cosine_power(direction_part(u), k_);
    return above(from, to) ? std::optional(BsdfSample{to, Lobe::smooth}) : std::nullopt;
  }
  std::optional<Vec3> invert(const SurfacePoint&, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (lobe != Lobe::smooth || !above(from, to)) return std::nullopt;
    return u_of(v.x, invert_cosine_power(to, k_));
  }
  Spectrum albedo(const SurfacePoint& at) const override { return 2 / (k_ + 1) * rho_->eval(at); }

 private:
  TexturePtr rho_;
  double k_;
};

}  // namespace

Plugin bsdf_minnaert() {
  return make_plugin<Minnaert>(
      "bsdf", "minnaert", "A surface that darkens towards its rim (Minnaert 1941).",
      {{"reflectance", ParamType::texture, 0.5, "Fraction scattered of light from right above."},
       {"k", ParamType::real, 1.5, "1 is diffuse; the larger, the darker the rim."}});
}

}  // namespace mlt
