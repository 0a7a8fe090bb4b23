#include "scene/bsdf/openpbr_fuzz.h"

namespace mlt {
namespace {

/// The mean of the BRDF over directions that the lobe from `from` draws.
double fuzz_reflected(const Vec3& from, double roughness) {
  constexpr int order = 48;
  const FuzzLobe<double> lobe(from, roughness);
  double sum = 0;
  for (int i = 0; i < order; ++i)
    for (int k = 0; k < order; ++k) {
      const Vec3 to = lobe.sample({(i + 0.5) / order, (k + 0.5) / order});
      const double density = lobe.density(to);
      if (to.z > 0 && density > 0)
        sum += fuzz_brdf(FuzzLobe<double>(to, roughness), lobe, to, from) * to.z / density;
    }
  return sum / (order * order);
}

EnergyTable make_fuzz_reflectance() {
  EnergyTable table;
  for (int j = 0; j < EnergyTable::roughnesses; ++j)
    for (int i = 0; i < EnergyTable::cosines; ++i) {
      const double z = EnergyTable::cosine(i);
      table.node(j, i) = fuzz_reflected({std::sqrt(1 - z * z), 0, z}, EnergyTable::roughness(j));
    }
  return table;
}

}  // namespace

const EnergyTable& fuzz_reflectance() {
  static const EnergyTable table = make_fuzz_reflectance();
  return table;
}

}  // namespace mlt
