#include "math/wavelengths.h"

#include "math/colorimetry.h"

#include <array>

namespace mlt {
namespace {

constexpr int cells = 512;

/// The inverse of the distribution of the density 0.0039398042 / cosh^2(0.0072 (nm - 538)) over the
/// visible range.
double inverse_distribution(double u) {
  const auto area = [](double nm) { return std::tanh(0.0072 * (nm - 538)); };
  const double low = area(first_wavelength), high = area(last_wavelength);
  return 538 + std::atanh(low + u * (high - low)) / 0.0072;
}

std::array<double, cells + 1> tabulated() {
  std::array<double, cells + 1> nm;
  for (int i = 0; i <= cells; ++i) nm[i] = inverse_distribution(double(i) / cells);
  nm[0] = first_wavelength;
  nm[cells] = last_wavelength;
  return nm;
}

const Vec3& white() {
  static const Vec3 xyz = [] {
    Vec3 sum(0);
    for (double nm = first_wavelength; nm <= last_wavelength; ++nm)
      sum += matching_functions(nm) * d65(nm);
    return sum;
  }();
  return xyz;
}

}  // namespace

Wavelength wavelength_of(double u) {
  static const std::array<double, cells + 1> table = tabulated();
  const int i = std::min(static_cast<int>(u * cells), cells - 1);
  const double across = table[i + 1] - table[i];
  return {table[i] + (u * cells - i) * across, across * cells};
}

Color recorded_spectrum(const Spectrum& light, double u, bool dispersed) {
  const int lanes = dispersed ? 1 : Spectrum::lanes;
  Vec3 xyz(0);
  for (int j = 0; j < lanes; ++j) {
    const Wavelength w = wavelength_of(lane_of(u, j));
    xyz += matching_functions(w.nm) * (light[j] * w.per_u / lanes);
  }
  return xyz / white();
}

Color developed(const Color& recorded) { return xyz_to_srgb(recorded * white()); }

}  // namespace mlt
