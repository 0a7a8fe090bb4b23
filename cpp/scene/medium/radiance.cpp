#include "scene/medium/radiance.h"

#include "math/planck.h"
#include "scene/medium/coefficients.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

/// What is colder is dark, for the eye.
constexpr double coldest = 500;
/// So many steps that colours between them are linear: within 0.1 % from 1900 K on in a fire of at
/// most 10000 K.
constexpr int color_steps = 1024;
constexpr double most_kelvin = 1e6;

}  // namespace

std::vector<Parameter> radiance_parameters() {
  return {emission_parameter(ParamType::volume),
          {"emission_scale", ParamType::real, 1.0, "Factor of the emission."},
          {"temperature", ParamType::volume, 0.0,
           "In place of `emission`: the temperature, of which the radiance is that of a black "
           "body, in W / (m^2 sr nm); below 500 K none."},
          {"temperature_scale", ParamType::real, 1.0,
           "Factor that makes kelvin of the temperature, after the offset."},
          {"temperature_offset", ParamType::real, 0.0, "Is subtracted from the temperature."},
          {"temperature_normalized", ParamType::boolean, false,
           "Divide each black body's spectrum by its greatest value, as pbrt does."}};
}

MediumRadiance::MediumRadiance(Params& params)
    : scale_(params.real_in("emission_scale", 0, 1e12)),
      kelvin_scale_(params.real_in("temperature_scale", 0, 1e12)),
      offset_(params.real("temperature_offset")),
      normalized_(params.boolean("temperature_normalized")),
      by_temperature_(params.has("temperature")) {
  const std::string name = by_temperature_ ? "temperature" : "emission";
  if (by_temperature_ && params.has("emission"))
    params.fail(name, "and 'emission' exclude each other");
  volume_ = volume_param(params, name);
  maximum_ = volume_->maximum();
  if (by_temperature_) {
    if (!volume_->grey()) params.fail(name, "should have one number at each point, not a colour");
    hottest_ = kelvin(std::max(0.0, volume_->maximum().x));
    if (!(hottest_ <= most_kelvin))
      params.fail(
          name, fmt::format("reaches {:g} K, but at most {:g} K is right", hottest_, most_kelvin));
    find_colors();
  }
  maximum_ *= scale_;
  check_brightness(params, name, maximum_);
}

void MediumRadiance::find_colors() {
  maximum_ = Color(0);
  if (!(hottest_ > coldest)) return;
  for (int i = 0; i <= color_steps; ++i) {
    const double kelvin = coldest + i * (hottest_ - coldest) / color_steps;
    const Curve curve = Curve::blackbody(kelvin).scaled(brightness(kelvin));
    colors_.push_back(glm::max(curve_to_rgb(curve), Color(0)));
    maximum_ = glm::max(maximum_, colors_.back());
  }
}

/// The factor of Planck's law.
double MediumRadiance::brightness(double kelvin) const {
  return normalized_ ? 1 / planck_radiance(wien / kelvin, kelvin) : 1;
}

Spectrum MediumRadiance::black_body(double kelvin, double wavelength) const {
  if (!(kelvin > coldest)) return Spectrum(0);
  if (wavelength >= 0)
    return at_wavelengths(
        wavelength, [&](double nm) { return brightness(kelvin) * planck_radiance(nm, kelvin); });
  const double x = std::min((kelvin - coldest) / (hottest_ - coldest), 1.0) * color_steps;
  const auto i = std::min(static_cast<size_t>(x), size_t(color_steps - 1));
  return Spectrum(glm::mix(colors_[i], colors_[i + 1], x - double(i)));
}

Spectrum MediumRadiance::at(const Vec3& p, double wavelength) const {
  if (!by_temperature_) return scale_ * volume_->light_at(p, wavelength);
  return scale_ * black_body(kelvin(volume_->at(p, rgb_lanes)[0]), wavelength);
}

}  // namespace mlt
