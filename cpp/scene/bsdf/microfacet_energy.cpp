#include "scene/bsdf/microfacet_energy.h"

#include "math/fresnel.h"
#include "math/ggx.h"

#include <map>
#include <mutex>
#include <vector>

namespace mlt {
namespace {

#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr int visible_normals = 4;  // Accuracy is not what fuzzing is about.
#else
constexpr int visible_normals = 400;
#endif

Ggx<double> facets(int j) {
  const double alpha = std::max(1e-4, sqr(EnergyTable::roughness(j)));
  return {alpha, alpha};
}

/// Calls f(m, weight) for normals that are visible from wi, by the points of Fibonacci's lattice;
/// the weights sum to one.
template <class F>
void for_visible_normals(const Ggx<double>& facets, const Vec3& wi, F&& f) {
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < visible_normals; ++i)
    f(facets.sample(wi, {(i + 0.5) / visible_normals, std::fmod(0.5 + i * golden, 1.0)}),
      1.0 / visible_normals);
}

Vec3 direction_of(double cosine) { return {std::sqrt(1 - sqr(cosine)), 0, cosine}; }

/// Light from one node that is scattered once and leaves to `side` with a cosine.
struct ScatteredOnce {
  int side;
  double cosine, weight;
};
using ScatteredLight = std::vector<ScatteredOnce>;

/// Light from above that meets facets; `eta` = 0: they are mirrors. A weight is that of light which
/// is not masked on its way out.
ScatteredLight scatter_once(const Ggx<double>& facets, double cosine, double eta) {
  ScatteredLight light;
  const Vec3 wi = direction_of(cosine);
  for_visible_normals(facets, wi, [&](const Vec3& m, double weight) {
    const Fresnel F = eta > 0 ? fresnel_dielectric(dot(wi, m), eta) : Fresnel{1, 0, 1, 1};
    const Vec3 mirrored = reflect(wi, m);
    if (mirrored.z > 0)
      light.push_back({0, mirrored.z, weight * F.reflectance * facets.g1(mirrored, m)});
    if (F.cos_t == 0) return;
    const Vec3 refracted = refract(wi, m, F.cos_t, F.eta_ti);
    if (refracted.z < 0)
      light.push_back({1, -refracted.z, weight * (1 - F.reflectance) * facets.g1(refracted, m)});
  });
  return light;
}

/// The scales of one roughness, on one side or on both.
void balance(int j, const std::vector<double>& etas, const std::vector<EnergyTable*>& scales) {
  std::vector<ScatteredLight> light;
  for (size_t side = 0; side < etas.size(); ++side)
    for (int i = 0; i < EnergyTable::cosines; ++i) {
      light.push_back(scatter_once(facets(j), EnergyTable::cosine(i), etas[side]));
      for (ScatteredOnce& s : light.back()) s.side ^= static_cast<int>(side);
      scales[side]->node(j, i) = 1;
    }
  constexpr int rounds = 40;
  constexpr double target = 0.997;  // a margin for interpolation
  for (int round = 0; round < rounds; ++round)
    for (size_t side = 0; side < etas.size(); ++side)
      for (int i = 0; i < EnergyTable::cosines; ++i) {
        double kept = 0;
        for (const ScatteredOnce& s : light[side * EnergyTable::cosines + i])
          kept += s.weight * scales[s.side]->at(s.cosine, EnergyTable::roughness(j));
        double& scale = scales[side]->node(j, i);
        scale = std::sqrt(scale * target / kept);  // half of the step, in its logarithm
      }
}

BalancedScales balanced(const std::vector<double>& etas) {
  BalancedScales made;
  std::vector<EnergyTable*> scales{&made.above, &made.below};
  scales.resize(etas.size());
  for (int j = 0; j < EnergyTable::roughnesses; ++j) balance(j, etas, scales);
  return made;
}

InterfaceEnergy interface_energy(double eta) {
  InterfaceEnergy made;
  for (int j = 0; j < EnergyTable::roughnesses; ++j)
    for (int i = 0; i < EnergyTable::cosines; ++i)
      for (const ScatteredOnce& s : scatter_once(facets(j), EnergyTable::cosine(i), eta))
        if (s.side == 0) made.reflectance.node(j, i) += s.weight;
  made.mean = RoughnessTable(made.reflectance);
  return made;
}

/// One T for each index, made when it is first asked for.
template <class T, class Make>
std::shared_ptr<const T> once_for(double eta, Make&& make) {
  static std::mutex mutex;
  static std::map<double, std::shared_ptr<const T>> made;
  const std::lock_guard lock(mutex);
  auto& found = made[eta];
  if (!found) found = std::make_shared<const T>(make());
  return found;
}

}  // namespace

std::shared_ptr<const InterfaceEnergy> InterfaceEnergy::of(double eta) {
  return once_for<InterfaceEnergy>(eta, [eta] { return interface_energy(eta); });
}

const BalancedScales& BalancedScales::of_mirrors() {
  static const BalancedScales made = balanced({0});
  return made;
}

std::shared_ptr<const BalancedScales> BalancedScales::of_glass(double eta) {
  return once_for<BalancedScales>(eta, [eta] { return balanced({eta, 1 / eta}); });
}

}  // namespace mlt
