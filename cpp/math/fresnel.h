// Fresnel reflectance of smooth interfaces for unpolarised light, and refraction.
// Convention: `eta` is the index of refraction below the surface relative to that above (where the
// normal points): eta = n_below / n_above = int_ior / ext_ior.
// Cosines are signed: positive above. Directions point away from the surface.
#pragma once

#include "math/frame.h"
#include "math/number.h"
#include "math/spectrum.h"

namespace mlt {

struct Fresnel {
  double reflectance;  // F; 1 under total internal reflection
  double cos_t;        // signed cosine of the refracted direction, on the other side; 0 if none
  double eta_it;       // n_transmitted / n_incident
  double eta_ti;       // n_incident / n_transmitted: scales the tangential component on refraction
};

/// Fresnel's equations for a dielectric, for positive cosines and eta = n_t / n_i: Born & Wolf,
/// "Principles of Optics", 7th ed., sec. 1.5.2, eqs. (32) and (33).
template <class F>
F dielectric_reflectance(F cos_i, F cos_t, F eta) {
  const F r_s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  const F r_p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return number<F>(0.5) * (r_s * r_s + r_p * r_p);
}
/// The reflectance for light from above, 0 <= cos_i.
template <class F>
F dielectric_reflectance(F cos_i, double eta) {
  const F ci = min(F(1), cos_i);
  const F cos2_t = 1 - number<F>(1 / (eta * eta)) * (1 - ci * ci);  // Snell's law
  const F reflected = dielectric_reflectance(ci, sqrt(max(cos2_t, F(0))), number<F>(eta));
  return select(cos2_t > 0, reflected, F(1));
}

/// A dielectric.
inline Fresnel fresnel_dielectric(double cos_i, double eta) {
  if (eta == 1) return {0, -cos_i, 1, 1};
  const bool above = cos_i >= 0;
  const double eta_it = above ? eta : 1 / eta;
  const double eta_ti = above ? 1 / eta : eta;
  const double ci = std::min(1.0, std::abs(cos_i));
  const double cos2_t = 1 - eta_ti * eta_ti * (1 - ci * ci);  // Snell's law
  if (!(cos2_t > 0)) return {1, 0, eta_it, eta_ti};
  const double ct = std::sqrt(cos2_t);
  return {dielectric_reflectance(ci, ct, eta_it), above ? -ct : ct, eta_it, eta_ti};
}

/// The direction refracted at a surface with normal (0, 0, 1), for `w` with a cos_t and eta_ti from
/// fresnel_dielectric(w.z, eta).
inline Vec3 refract(const Vec3& w, double cos_t, double eta_ti) {
  return {-eta_ti * w.x, -eta_ti * w.y, cos_t};
}

/// The direction refracted at a normal `m`, with values from fresnel_dielectric(dot(w, m), eta).
inline Vec3 refract(const Vec3& w, const Vec3& m, double cos_t, double eta_ti) {
  return m * (dot(w, m) * eta_ti + cos_t) - w * eta_ti;
}

/// A conductor with complex index eta + i k relative to the outside; 0 <= cos_i <= 1.
/// Born & Wolf, sec. 14.4.1; in real arithmetic n_t cos_t = a + i b gives
///   R_s = ((a - c)^2 + b^2) / ((a + c)^2 + b^2),   c = cos_i,
///   R_p = R_s ((a - s t)^2 + b^2) / ((a + s t)^2 + b^2),   s t = sin_i tan_i.
inline double fresnel_conductor(double cos_i, double eta, double k) {
  const double c2 = cos_i * cos_i, s2 = 1 - c2;
  const double real = eta * eta - k * k - s2;                   // Re (eta + ik)^2 - sin^2
  const double norm = std::sqrt(sqr(real) + sqr(2 * eta * k));  // a^2 + b^2
  const double ac2 = 2 * cos_i * std::sqrt(std::max(0.0, 0.5 * (norm + real)));  // 2 a cos_i
  const double r_s = (norm + c2 - ac2) / (norm + c2 + ac2);
  const double p = c2 * norm + s2 * s2, q = ac2 * s2;
  return 0.5 * r_s * (1 + (p - q) / (p + q));
}

inline Spectrum fresnel_conductor(double cos_i, const Spectrum& eta, const Spectrum& k) {
  return lane_by_lane(eta, k, [&](double n, double a) { return fresnel_conductor(cos_i, n, a); });
}

/// The mean reflectance for diffuse light that arrives from above, 2 int_0^1 F(c) c dc. Use 1 / eta
/// for light inside the medium. A quadrature to about 1e-12: for construction, not for shading.
double fresnel_diffuse_reflectance(double eta);

}  // namespace mlt
