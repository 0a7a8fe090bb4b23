#include "math/curve.h"

#include "base/error.h"
#include "math/colorimetry.h"
#include "math/planck.h"

#include <fmt/format.h>

#include <algorithm>

namespace mlt {

namespace {

/// The reciprocal of the step between wavelengths, or 0 when steps differ by more than rounding.
double reciprocal_step(const WavelengthTable& samples) {
  const double first = samples.front().first;
  const double step = (samples.back().first - first) / static_cast<double>(samples.size() - 1);
  for (size_t i = 0; i < samples.size(); ++i)
    if (std::abs(samples[i].first - (first + static_cast<double>(i) * step)) > 1e-9 * step)
      return 0;
  return 1 / step;
}

}  // namespace

struct Curve::Samples {
  WavelengthTable pairs;
  double per_step;  // of equal steps, else 0
  bool held;

  double outside(double wavelength) const {
    if (!held) return 0;
    return wavelength < pairs.front().first ? pairs.front().second : pairs.back().second;
  }
  double within_equal(double wavelength) const {
    const double t = (wavelength - pairs.front().first) * per_step;
    const size_t i = std::min(static_cast<size_t>(t), pairs.size() - 2);
    const double a = pairs[i].second;
    return a + (t - static_cast<double>(i)) * (pairs[i + 1].second - a);
  }
  double within_unequal(double wavelength) const {
    const auto after = [](double w, const std::pair<double, double>& pair) {
      return w < pair.first;
    };
    const auto above = std::upper_bound(pairs.begin() + 1, pairs.end() - 1, wavelength, after);
    const auto [wb, b] = *above;
    const auto [wa, a] = *(above - 1);
    return a + (wavelength - wa) / (wb - wa) * (b - a);
  }
  double at(double wavelength) const {
    if (!(wavelength >= pairs.front().first && wavelength <= pairs.back().first))
      return outside(wavelength);
    return per_step > 0 ? within_equal(wavelength) : within_unequal(wavelength);
  }
};

Curve Curve::constant(double value) {
  if (!std::isfinite(value))
    throw UsageError(fmt::format("the value of a spectrum must be finite, not {}", value));
  return Curve().scaled(value);
}

Curve Curve::of_samples(const WavelengthTable& samples, bool held) {
  if (samples.size() == 1) return constant(samples.front().second);
  check_spectrum(samples);
  Curve curve;
  curve.samples_ = std::make_shared<Samples>(Samples{samples, reciprocal_step(samples), held});
  return curve;
}

Curve Curve::table(const WavelengthTable& samples) { return of_samples(samples, false); }

Curve Curve::held_table(const WavelengthTable& samples) { return of_samples(samples, true); }

Curve Curve::blackbody(double kelvin) {
  if (!std::isfinite(kelvin) || kelvin <= 0)
    throw UsageError(fmt::format(
        "the temperature of a black body must be finite and above 0 K, not {}", kelvin));
  Curve curve;
  curve.kelvin_ = kelvin;
  return curve;
}

Curve Curve::d65() {
  constexpr double step = 5;  // that of its table, between whose values it is linear
  WavelengthTable samples;
  for (double w = first_wavelength; w <= last_wavelength; w += step)
    samples.emplace_back(w, mlt::d65(w));
  return table(samples);
}

Curve Curve::scaled(double factor) const {
  Curve curve = *this;
  curve.scale_ *= factor;
  return curve;
}

double Curve::at(double wavelength) const {
  if (samples_) return scale_ * samples_->at(wavelength);
  return kelvin_ > 0 ? scale_ * planck_radiance(wavelength, kelvin_) : scale_;
}

double Curve::maximum() const {
  double largest = std::max(at(first_wavelength), at(last_wavelength));
  const auto consider = [&](double wavelength) {
    if (wavelength > first_wavelength && wavelength < last_wavelength)
      largest = std::max(largest, at(wavelength));
  };
  if (samples_)
    for (const auto& pair : samples_->pairs) consider(pair.first);
  if (kelvin_ > 0) consider(wien / kelvin_);
  return largest;
}

Color curve_to_rgb(const Curve& curve) {
  return xyz_to_srgb(xyz_of([&](double w) { return curve.at(w); }));
}

}  // namespace mlt
