// The modified Phong model: a diffuse part and a lobe cos^n about the mirror direction (Phong 1975;
// made reciprocal and normalised by Lafortune & Willems 1994, "Using the modified Phong reflectance
// model for physically based rendering"):
//   f = k_d / pi + k_s (n + 2) / (2 pi) cos^n alpha.
#include "base/registry.h"
#include "math/warp.h"
#include "scene/bsdf/glossy_over_diffuse.h"

namespace mlt {
namespace {

class Phong final : public GlossyOverDiffuse {
 public:
  explicit Phong(Params& params)
      : GlossyOverDiffuse(params), exponent_(params.real_in("exponent", 0, 1e9)) {}

 private:
  Gloss gloss(const SurfacePoint&, const Vec3& wl, const Vec3& wc) const override {
    const double cos_alpha = dot(reflect(wl), wc);
    const double cos_n = cos_alpha > 0 ? std::pow(std::min(cos_alpha, 1.0), exponent_) : 0;
    const double pdf = (exponent_ + 1) * (0.5 * inv_pi) * cos_n;
    return {(exponent_ + 2) * (0.5 * inv_pi) * cos_n, pdf, pdf};
  }
  Vec3 sample_gloss(const SurfacePoint&, const Vec3& from, const Vec2& u) const override {
    return sample_lobe(u, reflect(from), exponent_);
  }
  Vec2 invert_gloss(const SurfacePoint&, const Vec3& from, const Vec3& to) const override {
    return invert_lobe(to, reflect(from), exponent_);
  }
  /// A lobe cos^n is as wide as a Beckmann lobe with alpha^2 = 2 / (n + 2) (Walter et al. 2007,
  /// sec. 5.2).
  double gloss_roughness(const SurfacePoint&) const override {
    return std::sqrt(2 / (exponent_ + 2));
  }

  double exponent_;
};

}  // namespace

Plugin bsdf_phong() {
  return make_plugin<Phong>(
      "bsdf", "phong",
      "The modified Phong model: a diffuse part and a glossy lobe about the mirror direction.",
      concat(
          {{{"exponent", ParamType::real, 30.0, "Exponent of the glossy lobe; larger is shinier."}},
           GlossyOverDiffuse::parameters()}));
}

}  // namespace mlt
