// The modified Phong model: a diffuse part and a lobe cos^n about the mirror direction (Phong 1975;
// made reciprocal and normalised by Lafortune & Willems 1994, "Using the modified Phong reflectance
// model for physically based rendering"):
//   f = k_d / pi + k_s (n + 2) / (2 pi) cos^n alpha.
#include "base/registry.h"
#include "scene/bsdf/glossy_over_diffuse.h"

namespace mlt {
namespace {

template <class F>
struct PhongLobe {
  F exponent;

  Gloss<F> eval(const Vec3Of<F>& wl, const Vec3Of<F>& wc) const {
    const F cos_alpha = min(dot(reflect(wl), wc), F(1));
    const F cos_n = select(cos_alpha > 0, power(max(cos_alpha, F(0)), exponent), F(0));
    return {(exponent + 2) * number<F>(0.5 * inv_pi) * cos_n,
            (exponent + 1) * number<F>(0.5 * inv_pi) * cos_n};
  }
  Vec3Of<F> sample(const Vec3Of<F>& from, const Vec2Of<F>& u) const {
    return sample_lobe(u, reflect(from), exponent);
  }
  Vec2 invert(const Vec3& from, const Vec3& to) const {
    return invert_lobe(to, reflect(from), exponent);
  }
  /// A lobe cos^n is as wide as a Beckmann lobe with alpha^2 = 2 / (n + 2) (Walter et al. 2007,
  /// sec. 5.2).
  F least_alpha() const { return sqrt(2 / (exponent + 2)); }
};

class PhongLobes {
 public:
  explicit PhongLobes(Params& params) : exponent_(params.real_in("exponent", 0, 1e9)) {}
  template <class F>
  PhongLobe<F> at(const SurfacePoint* const*) const {
    return {number<F>(exponent_)};
  }
  double typical_alpha() const { return at<double>(nullptr).least_alpha(); }

 private:
  double exponent_;
};

}  // namespace

Plugin bsdf_phong() {
  return make_plugin<GlossyOverDiffuse<PhongLobes>>(
      "bsdf", "phong",
      "The modified Phong model: a diffuse part and a glossy lobe about the mirror direction.",
      concat(
          {{{"exponent", ParamType::real, 30.0, "Exponent of the glossy lobe; larger is shinier."}},
           GlossyReflectances::parameters()}));
}

}  // namespace mlt
