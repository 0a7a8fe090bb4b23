#include "scene/bsdf/rough_coating.h"

#include "math/fresnel.h"

namespace mlt {
namespace {

/// With 32 nodes every T and R_i is accurate to 1e-3 (R has a kink at the critical angle). Fuzzing
/// does not need that, and the table would take nine tenths of its time.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr int order = 2;
#else
constexpr int order = 32;
#endif

/// Nodes and weights of the Gauss-Legendre rule on [0, 1], by Newton's method on the Legendre
/// polynomial P_n (Press et al., "Numerical Recipes", 3rd ed., sec. 4.6).
struct Quadrature {
  std::array<double, order> node, weight;

  Quadrature() {
    for (size_t i = 0; i < order; ++i) {
      double x = std::cos(pi * (static_cast<double>(i) + 0.75) / (order + 0.5));
      double slope = 0;
      for (int step = 0; step < 8; ++step) {
        double p = 1, previous = 0;
        for (int j = 0; j < order; ++j) {
          const double next = ((2 * j + 1) * x * p - j * previous) / (j + 1);
          previous = p;
          p = next;
        }
        slope = order * (x * p - previous) / (x * x - 1);
        x -= p / slope;
      }
      node[i] = 0.5 * (1 - x);
      weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};

RoughFresnel rough_fresnel(const Microfacet& microfacet, double cos_i, double eta,
                           const Quadrature& rule) {
  const Vec3 wi(std::sqrt(1 - cos_i * cos_i), 0, cos_i);
  RoughFresnel sum{0, 0};
  for (size_t i = 0; i < order; ++i)
    for (size_t j = 0; j < order; ++j) {
      const Vec3 m = microfacet.sample(wi, {rule.node[i], rule.node[j]});
      const Fresnel fresnel = fresnel_dielectric(dot(wi, m), eta);
      const Vec3 reflected = reflect(wi, m);
      const Vec3 refracted = refract(wi, m, fresnel.cos_t, fresnel.eta_ti);
      const double F = fresnel.reflectance, weight = rule.weight[i] * rule.weight[j];
      if (reflected.z > 0) sum.reflectance += weight * F * microfacet.g1_fit(reflected, m);
      if (F < 1 && refracted.z < 0)
        sum.transmittance += weight * (1 - F) * microfacet.g1_fit(refracted, m);
    }
  return sum;
}

}  // namespace

RoughCoating::RoughCoating(MicrofacetType type, double alpha, double eta) {
  const Microfacet microfacet(type, alpha, alpha, true);
  const Quadrature rule;
  double sum = 0;
  for (size_t i = 0; i < size; ++i) {
    const double mu = std::max(1e-6, static_cast<double>(i) / (size - 1));
    table_[i] = rough_fresnel(microfacet, mu, eta, rule);
    sum += mu * rough_fresnel(microfacet, mu, 1 / eta, rule).reflectance;
  }
  // The plain mean over the nodes, ends included, is up to 1.5 % below the integral. Mitsuba 3
  // defines the model by it, so that images agree; it errs on the side of absorption.
  internal_reflectance_ = 2 * sum / size;
}

double RoughCoating::mean_transmittance() const {
  double sum = 0;
  for (size_t i = 0; i < size; ++i)
    sum += table_[i].transmittance * static_cast<double>(i) / (size - 1);
  return 2 * sum / size;
}

}  // namespace mlt
