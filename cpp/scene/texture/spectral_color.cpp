#include "scene/texture/spectral_color.h"

#include "math/colorimetry.h"

namespace mlt {
namespace {

/// The factor of the reflectance that stands for a colour. What has a unit is twice as large as its
/// largest component, in any unit, which leaves room for a smooth spectrum, as in Mitsuba 3.
double scale_of(const Color& rgb, RgbMeaning meaning) {
  const double most = max_component(rgb);
  return meaning == RgbMeaning::reflectance ? std::max(1.0, most) : 2 * most;
}

std::shared_ptr<const wavelengths::Table> table_of(const SmoothSpectrum& smooth) {
  auto table = std::make_shared<wavelengths::Table>();
  for (int i = 0; i <= wavelengths::cells; ++i)
    (*table)[i] = smooth.at(wavelengths::tables.nm[i])[0];
  return table;
}

}  // namespace

Spectrum SmoothSpectrum::at(double u) const {
  const Spectrum value = at_wavelengths(u, [&](double nm) { return scale * reflectance.at(nm); });
  return light ? value * daylight(u) : value;
}

Spectrum upsampled(const Color& rgb, RgbMeaning meaning, double u) {
  const bool light = meaning == RgbMeaning::light;
  if (is_grey(rgb)) return light ? rgb.x * daylight(u) : Spectrum(rgb.x);
  const double scale = scale_of(rgb, meaning);
  return SmoothSpectrum{ReflectanceTable::get().at(rgb / scale), scale, light}.at(u);
}

SpectralColor::SpectralColor(const Color& rgb, RgbMeaning meaning) : rgb_(rgb), meaning_(meaning) {
  if (is_grey(rgb)) return;
  const double scale = scale_of(rgb, meaning);
  smooth_ = {fit_reflectance(rgb / scale), scale, meaning == RgbMeaning::light};
  table_ = table_of(smooth_);
}

Spectrum SpectralColor::at_wavelengths_of(double u) const {
  if (curve_) return at_wavelengths(u, [&](double nm) { return curve_->at(nm); });
  if (table_ && !is_single(u)) return wavelengths::look_up(*table_, u);
  return is_grey(rgb_) ? upsampled(rgb(), meaning_, u) : smooth_.at(u);
}

SpectralColor SpectralColor::over(double divisor) const {
  SpectralColor color = *this;
  color.rgb_ /= divisor;
  color.smooth_.scale /= divisor;
  if (table_) color.table_ = table_of(color.smooth_);
  if (curve_) color.curve_ = curve_->scaled(1 / divisor);
  return color;
}

SpectralColor SpectralColor::meaning(RgbMeaning meaning) const {
  return curve_ ? *this : SpectralColor(rgb(), meaning);
}

LinearUpsampling::LinearUpsampling(double u)
    : red_(upsampled({1, 0, 0}, RgbMeaning::reflectance, u)),
      green_(upsampled({0, 1, 0}, RgbMeaning::reflectance, u)),
      blue_(upsampled({0, 0, 1}, RgbMeaning::reflectance, u)) {
  const Spectrum sum = red_ + green_ + blue_;
  red_ /= sum;
  green_ /= sum;
  blue_ /= sum;
}

}  // namespace mlt
