// Scattering about a microfacet normal h, by which a perturbation is propagated at a (nearly)
// specular vertex: the half vector is kept and the incident direction changed, so that the outgoing
// direction turns as at a mirror; for a delta vertex h is the shading normal itself. (The
// half-vector space of Kaplanyan, Hanika & Dachsbacher 2014; Jacobians from Walter et al. 2007,
// eqs. 14 and 17.)
//
// Directions are local and point away from the surface: `in` to where the walk comes from, `out` to
// where it goes. eta = eta_in / eta_out.
#pragma once

#include "math/frame.h"

#include <optional>

namespace mlt {

/// The normal about which `in` is reflected or refracted into `out`, on the side of z > 0; nullopt
/// if there is none.
inline std::optional<Vec3> half_vector(const Vec3& in, const Vec3& out, double eta) {
  const Vec3 sum = same_side(in, out) ? in + out : eta * in + out;
  const double l2 = length_squared(sum);
  if (!(l2 > 1e-12)) return std::nullopt;
  const Vec3 h = sum / std::sqrt(l2);
  return h.z < 0 ? -h : h;
}

/// The direction `in`, reflected about h; nullopt if the result is on the other side.
inline std::optional<Vec3> reflect_about(const Vec3& in, const Vec3& h) {
  const Vec3 out = reflect(in, h);
  if (!same_side(in, out)) return std::nullopt;
  return out;
}

/// The direction `in`, refracted about h; nullopt on total internal reflection.
inline std::optional<Vec3> refract_about(const Vec3& in, const Vec3& h, double eta) {
  const double cos_in = dot(in, h);
  const double cos2_out = 1 - sqr(eta) * (1 - sqr(cos_in));
  if (!(cos2_out > 0)) return std::nullopt;
  const Vec3 out =
      normalize((eta * cos_in - std::copysign(std::sqrt(cos2_out), cos_in)) * h - eta * in);
  if (same_side(in, out)) return std::nullopt;
  return out;
}

/// |d omega_h / d omega_out| for a fixed `in`.
inline double half_vector_jacobian(const Vec3& in, const Vec3& out, const Vec3& h, double eta) {
  if (same_side(in, out)) return 1 / (4 * std::abs(dot(out, h)));
  return std::abs(dot(out, h)) / sqr(eta * dot(in, h) + dot(out, h));
}

}  // namespace mlt
