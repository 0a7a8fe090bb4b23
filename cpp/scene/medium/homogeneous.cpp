// A medium that is the same everywhere.
#include "base/registry.h"
#include "scene/medium.h"
#include "scene/medium/presets.h"
#include "scene/phase/isotropic.h"
#include "scene/texture.h"

#include <fmt/format.h>

namespace mlt {
namespace {

MediumCoefficients read_coefficients(Params& params) {
  const bool by_albedo = params.has("sigma_t") || params.has("albedo");
  const bool by_parts = params.has("sigma_s") || params.has("sigma_a");
  if (by_albedo + by_parts + params.has("material") > 1)
    params.fail("is given twice: give sigma_t and albedo, or sigma_s and sigma_a, or material");
  const double scale = params.real_in("scale", 0, 1e12);
  MediumCoefficients found;
  if (params.has("material")) {
    found = medium_preset(params, "material");
  } else if (by_parts) {
    found.scattering = Spectrum(color_param(params, "sigma_s"));
    found.extinction = Spectrum(color_param(params, "sigma_a")) + found.scattering;
  } else {
    found.extinction = Spectrum(color_param(params, "sigma_t"));
    found.scattering = Spectrum(color_param(params, "albedo")) * found.extinction;
  }
  return {scale * found.extinction, scale * found.scattering};
}

class Homogeneous final : public Medium {
 public:
  explicit Homogeneous(Params& params)
      : Medium(phase_param(params)), coefficients_(read_coefficients(params)) {}

  MediumCoefficients at(const Vec3&) const override { return coefficients_; }
  bool scatters() const override { return !is_black(coefficients_.scattering); }
  bool grey() const override { return is_grey(coefficients_.extinction); }

  Flight fly(const Ray&, const FlightLimit& limit) const override {
    return uniform_flight(coefficients_.extinction, limit);
  }

 private:
  MediumCoefficients coefficients_;
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
