#include "math/fresnel.h"

namespace mlt {

namespace {

/// 2 int_0^1 F(c) c dc for eta > 1. F is analytic on (0, 1) but has, for eta near 1, a root almost
/// at c = 0; the double-exponential rule (Takahasi & Mori 1974) handles it.
double external_reflectance(double eta) {
  constexpr double step = 1.0 / 64;
  double sum = 0;
  for (int i = -288; i <= 288; ++i) {
    const double t = i * step;
    const double u = 0.5 * pi * std::sinh(t);
    const double c = 1 / (1 + std::exp(-2 * u));
    const double weight = 0.5 * pi * std::cosh(t) / sqr(std::cosh(u)) * 0.5;
    if (c > 0) sum += weight * c * fresnel_dielectric(c, eta).reflectance;
  }
  return 2 * step * sum;
}

}  // namespace

double fresnel_diffuse_reflectance(double eta) {
  if (eta == 1) return 0;
  if (eta > 1) return external_reflectance(eta);
  // By reciprocity n^2 (1 - F_internal) = 1 - F_external with n = 1 / eta (Judd 1942,
  // "Fresnel reflection of diffusely incident light", eq. 4).
  return 1 - eta * eta * (1 - external_reflectance(1 / eta));
}

}  // namespace mlt
