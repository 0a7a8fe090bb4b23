#include "math/microfacet.h"

#include "math/erf_inverse.h"
#include "math/warp.h"

#include <glm/common.hpp>

namespace mlt {

// All normals of GGX: as those of Beckmann, with 1 - u = 1 / (1 + t) (Walter et al. 2007, eq. 35).

Vec3 Microfacet::sample_any(const Vec2& u) const {
  if (type_ == MicrofacetType::beckmann) return beckmann().sample(u);
  const double r = std::sqrt(u.x / (1 - u.x));
  const SinCos phi = sincos_turns(u.y);
  return stretch({r * phi.cos, r * phi.sin, 1});
}

Vec2 Microfacet::invert_any(const Vec3& m) const {
  if (type_ == MicrofacetType::beckmann) return beckmann().invert(m);
  const double x = m.x / (alpha_u_ * m.z), y = m.y / (alpha_v_ * m.z);
  const double t = x * x + y * y;
  return {t / (1 + t), turns(x, y)};
}

// Visible GGX normals: the inverse of Ggx::sample.

Vec2 Microfacet::invert_visible_ggx(const Vec3& wi, const Vec3& m) const {
  const Vec3 w = stretch(wi);
  const Vec3 c = reflect(w, unstretch(m));
  return {glm::clamp((1 - c.z) / (1 + w.z), 0.0, 1 - 0x1p-53), turns(c.x, c.y)};
}

// Visible Beckmann normals. With wi in the x-z plane at angle theta, the slope along y is Gaussian
// and the slope s along x has, for s < cot(theta), the cumulative function
//   C(s) / C(cot theta),  C(s) = cos(theta) (1 + erf(s)) + sin(theta) exp(-s^2) / sqrt(pi)
// (Heitz & d'Eon 2014, appendix A). It is inverted numerically, to the last digits, so that the map
// is smooth and has an inverse, as Jakob 2014 advises ("An improved visible normal sampling routine
// for the Beckmann distribution").

namespace {

struct VisibleSlope {
  double cos, sin;  // of theta
  double top;       // the largest visible slope, cot(theta), or where erf(top) is 1 anyway
  double erf_top;
  double total;  // C(top)

  VisibleSlope(double cos_theta, double sin_theta)
      : cos(cos_theta), sin(sin_theta), top(6 * sin < cos ? 6 : cos / sin) {
    erf_top = top == 6 ? 1 : std::erf(top);
    total = cos * (1 + erf_top) + (top == 6 ? 0 : sin * gauss(top));
  }

  static double gauss(double s) { return (0.5 * two_over_sqrt_pi) * std::exp(-s * s); }

  double sample(double u) const {
    const double target = u * total;
    double low = -26, high = top;
    double s = guess(u);
    for (int i = 0; i < 60; ++i) {
      const double g = gauss(s);
      const double error = cos * std::erfc(-s) + sin * g - target;
      (error > 0 ? high : low) = s;
      // Halley's method; C'(s) = slope g.
      const double slope = 2 * (cos - s * sin);
      const double newton = error / (slope * g);
      const double step = newton / (1 + newton * (s + sin / slope));
      const double next = s - step;
      const bool inside = next > low && next < high;
      // The method is cubic: after a step this small the error is below rounding.
      if (std::abs(step) < 1e-6 || !(high - low > 1e-15)) return inside ? next : s;
      s = inside ? next : 0.5 * (low + high);
    }
    return s;
  }

  double invert(double s) const {
    return s < top ? (cos * std::erfc(-s) + sin * gauss(s)) / total : 1;
  }

  /// A first guess of the slope, exact at normal incidence (C(s) is 1 + erf(s)) or, for larger
  /// angles, at grazing incidence (C(s) is exp(-s^2) for s < 0; Jakob 2014).
  double guess(double u) const {
    const double y = 3 * sin < cos ? std::min(u * (total / cos) - 1, 1 - 0x1p-52)
                                   : erf_top - (1 + erf_top) * std::erf(std::sqrt(-std::log(u)));
    return std::min(top, erf_inverse_estimate(std::max(y, -1 + 0x1p-52)));
  }
};

/// A direction's projection onto the surface, and its angle to the normal.
struct Incidence {
  double cos_phi = 1, sin_phi = 0;
  VisibleSlope slope;

  explicit Incidence(const Vec3& w) : slope(w.z, std::sqrt(sin2_theta(w))) {
    if (slope.sin == 0) return;
    cos_phi = w.x / slope.sin;
    sin_phi = w.y / slope.sin;
  }
};

}  // namespace

Vec3 Microfacet::sample_visible_beckmann(const Vec3& wi, const Vec2& u) const {
  const Incidence in(stretch(wi));
  const double x = in.slope.sample(std::max(u.x, 0x1p-54));
  const double y = erf_inverse(2 * std::max(u.y, 0x1p-53) - 1);
  return stretch({-(in.cos_phi * x - in.sin_phi * y), -(in.sin_phi * x + in.cos_phi * y), 1});
}

Vec2 Microfacet::invert_visible_beckmann(const Vec3& wi, const Vec3& m) const {
  const Incidence in(stretch(wi));
  const double mx = -m.x / (alpha_u_ * m.z), my = -m.y / (alpha_v_ * m.z);
  const double x = in.cos_phi * mx + in.sin_phi * my;
  const double y = in.cos_phi * my - in.sin_phi * mx;
  return {std::min(in.slope.invert(x), 1 - 0x1p-53), 0.5 * std::erfc(-y)};
}

}  // namespace mlt
