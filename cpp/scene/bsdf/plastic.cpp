// Smooth plastic: a diffuse base below a smooth dielectric coating. Light is mirrored by the
// coating with the fraction F; the rest enters, is scattered by the base, and is reflected back to
// it by the coating from inside any number of times: with d the reflectance of the base, T = 1 - F
// and F_i the mean internal reflectance,
//   f = d / (1 - d F_i) T(wl) T(wc) / (pi eta^2)
// (Wolff 1994, "Diffuse-reflectance model for smooth dielectric surfaces"). The linear
// variant does not let the base colour the multiple reflections: 1 - F_i in the denominator.
#include "base/registry.h"
#include "math/fresnel.h"
#include "math/warp.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/coated_base.h"
#include "scene/bsdf/ior_params.h"

namespace mlt {
namespace {

class Plastic final : public Bsdf {
 public:
  explicit Plastic(Params& params)
      : eta_(relative_ior_param(params)),
        base_(params, eta_, fresnel_diffuse_reflectance(1 / eta_),
              1 - fresnel_diffuse_reflectance(eta_)) {}

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (!above(wl, wc)) return {};
    const double Fl = fresnel(wl), Fc = fresnel(wc);
    const double pl = specular_share(Fl), pc = specular_share(Fc);
    if (lobe == Lobe::reflection) return {Fl * base_.specular(at), pl, pc};
    if (lobe == Lobe::smooth)
      return {base_.eval(at) * ((1 - Fl) * (1 - Fc)), (1 - pl) * inv_pi * wc.z,
              (1 - pc) * inv_pi * wl.z};
    return {};
  }

  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3& from,
                                   const Vec3& u) const override {
    if (from.z <= 0) return std::nullopt;
    if (u.x < specular_share(fresnel(from))) return BsdfSample{reflect(from), Lobe::reflection};
    const Vec3 to = sample_cosine_hemisphere(direction_part(u));
    if (to.z <= 0) return std::nullopt;
    return BsdfSample{to, Lobe::smooth};
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (!(pdf(at, from, to, lobe) > 0)) return std::nullopt;
    const double p = specular_share(fresnel(from));
    if (lobe == Lobe::reflection) return Vec3(u_of_first(p, v.x), v.y, v.z);
    return u_of(u_of_second(p, v.x), invert_cosine_hemisphere(to));
  }

  bool has_delta() const override { return true; }

  Spectrum albedo(const SurfacePoint& at) const override { return base_.albedo(at); }

 private:
  double fresnel(const Vec3& w) const { return fresnel_dielectric(w.z, eta_).reflectance; }
  double specular_share(double F) const { return base_.specular_share(F, 1 - F); }

  double eta_;
  CoatedBase base_;
};

}  // namespace

Plugin bsdf_plastic() {
  return make_plugin<Plastic>("bsdf", "plastic",
                              "Smooth plastic: a diffuse base below a smooth transparent coating.",
                              concat({ior_parameters("polypropylene"), CoatedBase::parameters()}));
}

}  // namespace mlt
