#include "math/wavelengths.h"

#include "math/colorimetry.h"

namespace mlt {
namespace {

/// The inverse of the distribution of the density 0.0039398042 / cosh^2(0.0072 (nm - 538)) over the
/// visible range.
double inverse_distribution(double u) {
  const auto area = [](double nm) { return std::tanh(0.0072 * (nm - 538)); };
  const double low = area(first_wavelength), high = area(last_wavelength);
  return std::clamp(538 + std::atanh(low + u * (high - low)) / 0.0072, first_wavelength,
                    last_wavelength);
}

/// d nm / d u, one over the density.
double nm_per_u(double nm) {
  const double total =
      std::tanh(0.0072 * (last_wavelength - 538)) - std::tanh(0.0072 * (first_wavelength - 538));
  return total * sqr(std::cosh(0.0072 * (nm - 538))) / 0.0072;
}

/// The X, Y and Z of D65 that a film records by this response.
Vec3 white_of(const wavelengths::Tables& tables) {
  constexpr int points = 16;  // in each cell
  Vec3 sum(0);
  for (int i = 0; i < points * wavelengths::cells; ++i) {
    const wavelengths::Place place((i + 0.5) / (points * wavelengths::cells));
    sum += place.at(tables.response, 0) * d65(place.at(tables.nm, 0));
  }
  return sum / (1.0 * points * wavelengths::cells);
}

}  // namespace

namespace wavelengths {

Tables::Tables() {
  for (int i = 0; i <= cells; ++i) {
    nm[i] = inverse_distribution(double(i) / cells);
    d65[i] = mlt::d65(nm[i]);
    response[i] = matching_functions(nm[i]) * nm_per_u(nm[i]);
  }
  const Vec3 unit = white_of(*this);
  for (Color& xyz : response) xyz /= unit;
}

const Tables tables;

}  // namespace wavelengths

Spectrum daylight(double u) {
  return is_single(u) ? Spectrum(d65(u)) : wavelengths::look_up(wavelengths::tables.d65, u);
}

Color recorded_spectrum(const Spectrum& light, double u, bool dispersed) {
  if (is_single(u)) return Color(light[0]);
  const wavelengths::Place place(u);
  const int lanes = dispersed ? 1 : Spectrum::lanes;
  Color sum(0);
  for (int j = 0; j < lanes; ++j)
    sum += place.at(wavelengths::tables.response, j) * (light[j] / lanes);
  return sum;
}

/// XYZ of white light of 1. Without the quadrature's own error, it is shown as 1.
static const Vec3& white() {
  static const Vec3 xyz = xyz_of(d65), white = xyz / xyz.y;
  return white;
}

Color developed(const Color& recorded) { return xyz_to_srgb(recorded * white()); }
Color undeveloped(const Color& rgb) { return srgb_to_xyz(rgb) / white(); }

}  // namespace mlt
