#include "scene/bsdf/rough_coating.h"

#include "math/fresnel.h"

namespace mlt {
namespace {

/// Normals per direction, squared.
constexpr int external_order = 16;
constexpr int internal_order = 24;

double masking(const Microfacet& microfacet, const Vec3& w, const Vec3& m, bool expected_side) {
  return expected_side && w.z != 0 ? microfacet.g1_fit(w, m) : 0;
}

}  // namespace

RoughFresnel rough_fresnel(const Microfacet& microfacet, double cos_i, double eta, int order) {
  const Vec3 wi(std::sqrt(1 - cos_i * cos_i), 0, cos_i);
  RoughFresnel sum{0, 0};
  for (int i = 0; i < order; ++i)
    for (int j = 0; j < order; ++j) {
      const Vec3 m = microfacet.sample(wi, Vec2(i + 0.5, j + 0.5) / static_cast<double>(order));
      const Fresnel fresnel = fresnel_dielectric(dot(wi, m), eta);
      const Vec3 reflected = reflect(wi, m), refracted = refract(wi, m, fresnel.cos_t, fresnel.eta_ti);
      sum.reflectance +=
          fresnel.reflectance * masking(microfacet, reflected, m, reflected.z > 0);
      sum.transmittance += (1 - fresnel.reflectance) *
                           masking(microfacet, refracted, m, fresnel.cos_t < 0 && refracted.z < 0);
    }
  const double n = static_cast<double>(order) * order;
  return {sum.reflectance / n, sum.transmittance / n};
}

RoughCoating::RoughCoating(MicrofacetType type, double alpha, double eta) {
  const Microfacet microfacet(type, alpha, alpha, true);
  double sum = 0;
  for (size_t i = 0; i < size; ++i) {
    const double mu = std::max(1e-6, static_cast<double>(i) / (size - 1));
    table_[i] = rough_fresnel(microfacet, mu, eta, external_order);
    sum += mu * rough_fresnel(microfacet, mu, 1 / eta, internal_order).reflectance;
  }
  // The plain mean over the nodes, ends included, is up to 1.5 % below the integral. It is what
  // Mitsuba 3 defines the model by, so that pictures agree; it errs on the side of absorption.
  internal_reflectance_ = 2 * sum / size;
}

double RoughCoating::mean_transmittance() const {
  double sum = 0;
  for (size_t i = 0; i < size; ++i)
    sum += table_[i].transmittance * static_cast<double>(i) / (size - 1);
  return 2 * sum / size;
}

}  // namespace mlt
