// A medium that is the same everywhere.
#include "base/registry.h"
#include "scene/medium/medium.h"
#include "scene/medium/presets.h"
#include "scene/phase/isotropic.h"
#include "scene/texture/texture.h"

#include <fmt/format.h>

namespace mlt {
namespace {

/// sigma_s and sigma_a or, `by_albedo`, sigma_t and the albedo.
struct Coefficients {
  SpectralColor first, second;
  bool by_albedo;
  double scale;

  MediumCoefficients at(double wavelength) const {
    const Spectrum a = first.at(wavelength), b = second.at(wavelength);
    return by_albedo ? MediumCoefficients{scale * a, scale * (b * a)}
                     : MediumCoefficients{scale * (b + a), scale * a};
  }
  bool grey() const {
    return is_grey(at(rgb_lanes).extinction) && first.grey() && (by_albedo || second.grey());
  }
};

Coefficients read_coefficients(Params& params) {
  const bool by_albedo = params.has("sigma_t") || params.has("albedo");
  const bool by_parts = params.has("sigma_s") || params.has("sigma_a");
  if (by_albedo + by_parts + params.has("material") > 1)
    params.fail("is given twice: give sigma_t and albedo, or sigma_s and sigma_a, or material");
  const double scale = params.real_in("scale", 0, 1e12);
  if (params.has("material")) {
    const MediumPreset& preset = medium_preset(params, "material");
    return {{preset.scattering, RgbMeaning::coefficient},
            {preset.absorption, RgbMeaning::coefficient},
            false,
            scale};
  }
  const auto coefficient = [&](const char* name) {
    return spectral_param(params, name).meaning(RgbMeaning::coefficient);
  };
  if (by_parts) return {coefficient("sigma_s"), coefficient("sigma_a"), false, scale};
  return {coefficient("sigma_t"), spectral_param(params, "albedo"), true, scale};
}

class Homogeneous final : public Medium {
 public:
  explicit Homogeneous(Params& params)
      : Medium(phase_param(params)), coefficients_(read_coefficients(params)) {
    in_rgb_ = coefficients_.at(rgb_lanes);
    check_extinction(params, max_component(in_rgb_.extinction));
  }

  MediumCoefficients at(const Vec3&, double wavelength) const override {
    return wavelength < 0 ? in_rgb_ : coefficients_.at(wavelength);
  }
  bool scatters() const override { return !is_black(in_rgb_.scattering); }
  bool grey() const override { return coefficients_.grey(); }

  Flight fly(const Ray& ray, const FlightLimit& limit) const override {
    return uniform_flight(at(ray.o, ray.wavelength).extinction, limit);
  }

 private:
  Coefficients coefficients_;
  MediumCoefficients in_rgb_;
};

}  // namespace

Plugin medium_homogeneous() {
  return make_plugin<Homogeneous>(
      "medium", "homogeneous", "A medium that is the same everywhere.",
      {{"sigma_t", ParamType::radiance, 1.0, "Extinction coefficient, per unit of length."},
       {"albedo", ParamType::reflectance, 0.75, "Share of the extinction that is scattered."},
       {"sigma_s", ParamType::radiance, 0.0,
        "Scattering coefficient, per unit of length; with sigma_a instead of sigma_t and albedo."},
       {"sigma_a", ParamType::radiance, 0.0, "Absorption coefficient, per unit of length."},
       {"material", ParamType::text, no_default,
        fmt::format("A measured material instead of coefficients, in millimetres: {}.",
                    fmt::join(medium_preset_names(), ", "))},
       {"scale", ParamType::real, 1.0, "Factor of all coefficients."}});
}

}  // namespace mlt
