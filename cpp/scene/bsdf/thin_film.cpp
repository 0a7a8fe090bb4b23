#include "scene/bsdf/thin_film.h"

#include "math/colorimetry.h"
#include "math/wavelengths.h"

#include <glm/common.hpp>

namespace mlt {
namespace {

/// The amplitudes that an interface between indices n1 and n2 reflects of s and p polarised light,
/// with the same sign at normal incidence; both 1 under total reflection.
struct Amplitudes {
  double s, p;

  Amplitudes(double n1, double cos1, double n2, double cos2) {
    s = cos2 > 0 ? (n1 * cos1 - n2 * cos2) / (n1 * cos1 + n2 * cos2) : 1;
    p = cos2 > 0 ? (n1 * cos2 - n2 * cos1) / (n1 * cos2 + n2 * cos1) : 1;
  }
};

/// The reflectance of two interfaces with these amplitudes, and a phase between them.
double airy(double r12, double r23, double cos_phase) {
  const double product = r12 * r23, both = 2 * product * cos_phase;
  return (sqr(r12) + sqr(r23) + both) / (1 + sqr(product) + both);
}

/// The amplitude below a film which, with r12 above it and no film between them, makes r.
double bottom_amplitude(double r, double r12) {
  const double product = std::min(r * r12, 1 - 1e-9);
  return std::clamp((r - r12) / (1 - product), -1.0, 1.0);
}

/// The cosine behind an interface with n = n2 / n1; 0 under total reflection.
double refracted_cosine(double cosine, double n) {
  return std::sqrt(std::max(0.0, 1 - (1 - sqr(cosine)) / sqr(n)));
}

/// f(nm) as R, G and B of a surface that reflects it, under D65.
template <class F>
Color colour_of(F&& f) {
  const Vec3 xyz = xyz_of([&](double nm) { return d65(nm) * f(nm); });
  static const Color white = xyz_to_srgb(xyz_of([](double nm) { return d65(nm); }));
  return glm::clamp(xyz_to_srgb(xyz) / white, Color(0), Color(1));
}

/// A place between the nodes of a table over [0, 1].
struct NodePlace {
  int first;
  double within;

  NodePlace(double x, int nodes) {
    const double scaled = std::clamp(x, 0.0, 1.0) * (nodes - 1);
    first = std::min(static_cast<int>(scaled), nodes - 2);
    within = scaled - first;
  }
};

}  // namespace

ThinFilm::ThinFilm(double nanometres, double film, double base)
    : nanometres_(nanometres), film_(film), base_(base) {
  for (int i = 0; i < cosines; ++i) {
    const double cosine = static_cast<double>(i) / (cosines - 1);
    dielectric_[i] = colour_of([&](double nm) { return dielectric_at(cosine, nm); });
    for (int k = 0; k < levels; ++k) {
      const double bare = sqr(static_cast<double>(k) / (levels - 1));
      metal_[i][k] = colour_of([&](double nm) { return metal_at(cosine, nm, bare); });
    }
  }
}

double ThinFilm::cosine_inside(double cosine) const { return refracted_cosine(cosine, film_); }

double ThinFilm::path(double cosine) const {
  return 4 * pi * film_ * nanometres_ * cosine_inside(cosine);
}

double ThinFilm::dielectric_at(double cosine, double nm) const {
  const double inside = cosine_inside(cosine);
  if (!(inside > 0)) return 1;
  const Amplitudes top(1, cosine, film_, inside);
  const Amplitudes bottom(film_, inside, base_, refracted_cosine(cosine, base_));
  const double cos_phase = std::cos(path(cosine) / nm);
  return 0.5 * (airy(top.s, bottom.s, cos_phase) + airy(top.p, bottom.p, cos_phase));
}

double ThinFilm::metal_at(double cosine, double nm, double bare) const {
  const double inside = cosine_inside(cosine);
  if (!(inside > 0)) return 1;
  const Amplitudes top(1, cosine, film_, inside);
  const double cos_phase = std::cos(path(cosine) / nm);
  const auto polarised = [&](double r12) {
    return airy(r12, bottom_amplitude(-std::sqrt(bare), r12), cos_phase);
  };
  return 0.5 * (polarised(top.s) + polarised(top.p));
}

Spectrum ThinFilm::dielectric(double cosine, double wavelength) const {
  if (wavelength >= 0)
    return at_wavelengths(wavelength, [&](double nm) { return dielectric_at(cosine, nm); });
  const NodePlace at(cosine, cosines);
  return Spectrum(glm::mix(dielectric_[at.first], dielectric_[at.first + 1], at.within));
}

Spectrum ThinFilm::mean(double wavelength) const {
  constexpr int steps = 16;
  Spectrum sum(0);
  for (int i = 0; i < steps; ++i)  // at even steps of cos^2, 2 int_0^1 f(c) c dc
    sum += dielectric(std::sqrt((i + 0.5) / steps), wavelength);
  return sum / steps;
}

Spectrum ThinFilm::metal(double cosine, double wavelength, const Spectrum& bare) const {
  if (is_single(wavelength)) return Spectrum(metal_at(cosine, wavelength, bare[0]));
  if (wavelength >= 0)
    return lane_by_lane(wavelengths::look_up(wavelengths::tables.nm, wavelength), bare,
                        [&](double nm, double r) { return metal_at(cosine, nm, r); });
  const NodePlace at(cosine, cosines);
  const auto channel = [&](int c, double r) {
    const NodePlace level(std::sqrt(r), levels);
    const auto row = [&](int i) {
      return glm::mix(metal_[i][level.first][c], metal_[i][level.first + 1][c], level.within);
    };
    return glm::mix(row(at.first), row(at.first + 1), at.within);
  };
  return Spectrum(Color(channel(0, bare[0]), channel(1, bare[1]), channel(2, bare[2])));
}

}  // namespace mlt
