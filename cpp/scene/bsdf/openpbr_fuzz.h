// The fuzz of OpenPBR: a layer of fibres as a linearly transformed cosine (Zeltner, Burley & Chiang
// 2022, "Practical multiple-scattering sheen using linearly transformed cosines"), by MaterialX's
// rational fits of its coefficients. Their lobe is not symmetric: here the BRDF is the harmonic
// mean of the lobe from one direction and from the other, which never reflects more than arrives.
#pragma once

#include "math/warp.h"
#include "scene/bsdf/energy_table.h"

namespace mlt {

/// The lobe as seen from one direction above the surface.
template <class F>
class FuzzLobe {
 public:
  FuzzLobe(const Vec3Of<F>& from, F roughness) {
    const F x = min(from.z, F(1)), y = max(roughness, number<F>(0.01));
    a_ = (number<F>(2.58126) * x + number<F>(0.813703) * y) * y /
         (1 + number<F>(0.310327) * x * x + number<F>(2.60994) * x * y);
    b_ = sqrt(1 - x) * (y - 1) * y * y * y /
         (number<F>(0.0000254053) + number<F>(1.71228) * x - number<F>(1.71506) * x * y +
          number<F>(1.34174) * y * y);
    reflectance_ = reflectance(x, y);
    const F r2 = from.x * from.x + from.y * from.y, r = sqrt(max(r2, number<F>(1e-20)));
    cos_phi_ = select(r2 > number<F>(1e-20), from.x / r, F(1));
    sin_phi_ = select(r2 > number<F>(1e-20), from.y / r, F(0));
  }

  /// The density of `to`, whose integral is one.
  F density(const Vec3Of<F>& to) const {
    const Vec3Of<F> w = inverse(to);
    return max(F(0), to.z) * number<F>(inv_pi) * sqr(a_ / dot(w, w));
  }
  /// The lobe's BRDF for white fibres.
  F brdf(const Vec3Of<F>& to) const {
    const Vec3Of<F> w = inverse(to);
    return number<F>(inv_pi) * reflectance_ * sqr(a_ / dot(w, w));
  }
  Vec3Of<F> sample(const Vec2Of<F>& u) const {
    const Vec3Of<F> w = sample_cosine_hemisphere(u);
    const F x = (w.x - b_ * w.z) / a_, y = w.y / a_;
    return normalize(Vec3Of<F>(cos_phi_ * x - sin_phi_ * y, sin_phi_ * x + cos_phi_ * y, w.z));
  }
  Vec2 invert(const Vec3Of<F>& to) const {
    return invert_cosine_hemisphere(normalize(inverse(to)));
  }

 private:
  /// `to` by the inverse of the linear transform, whose z axis is the normal.
  Vec3Of<F> inverse(const Vec3Of<F>& to) const {
    const F x = cos_phi_ * to.x + sin_phi_ * to.y, y = cos_phi_ * to.y - sin_phi_ * to.x;
    return {a_ * x + b_ * to.z, a_ * y, to.z};
  }
  /// The share of light that the lobe scatters back, by a Gaussian fit.
  static F reflectance(F x, F y) {
    const F s = y * (number<F>(0.0206607) + number<F>(1.58491) * y) /
                (number<F>(0.0379424) + y * (number<F>(1.32227) + y));
    const F m = y *
                (number<F>(-0.193854) +
                 y * (number<F>(-1.14885) + y * (number<F>(1.7932) - number<F>(0.95943) * y * y))) /
                (number<F>(0.046391) + y);
    const F o = y *
                (number<F>(0.000654023) + (number<F>(-0.0207818) + number<F>(0.119681) * y) * y) /
                (number<F>(1.26264) + y * (number<F>(-1.92021) + y));
    const F z = (x - m) / s;
    const F gauss =
        for_each_lane<F>([&](int i) { return std::exp(-0.5 * sqr(double(lane_of(z, i)))); });
    return max(F(0), min(F(1), gauss / (s * number<F>(std::sqrt(2 * pi))) + o));
  }

  F a_, b_, reflectance_, cos_phi_, sin_phi_;
};

/// The symmetric BRDF of white fibres.
template <class F>
F fuzz_brdf(const FuzzLobe<F>& l, const FuzzLobe<F>& c, const Vec3Of<F>& wl, const Vec3Of<F>& wc) {
  const F from_l = l.brdf(wc), from_c = c.brdf(wl), sum = from_l + from_c;
  return select(sum > 0, 2 * from_l * from_c / max(sum, number<F>(1e-30)), F(0));
}

/// The share of light that the symmetric BRDF scatters back.
const EnergyTable& fuzz_reflectance();

}  // namespace mlt
