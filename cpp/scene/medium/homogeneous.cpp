// A medium that is the same everywhere.
#include "base/registry.h"
#include "scene/medium.h"
#include "scene/medium/presets.h"
#include "scene/nested.h"
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
    found.scattering = color_param(params, "sigma_s");
    found.extinction = color_param(params, "sigma_a") + found.scattering;
  } else {
    found.extinction = color_param(params, "sigma_t");
    found.scattering = color_param(params, "albedo") * found.extinction;
  }
  return {scale * found.extinction, scale * found.scattering};
}

BsdfPtr read_phase(Params& params) {
  const BsdfPtr nested = optional_nested<Bsdf>(params, "phase");
  return nested ? nested : isotropic_phase();
}

class Homogeneous final : public Medium {
 public:
  explicit Homogeneous(Params& params)
      : Medium(read_phase(params)), coefficients_(read_coefficients(params)) {}

  MediumCoefficients at(const Vec3&) const override { return coefficients_; }
  bool scatters() const override { return !is_black(coefficients_.scattering); }

  Color optical_depth(const Ray&, double distance) const override {
    Color depth = coefficients_.extinction;
    for (int i = 0; i < 3; ++i) depth[i] = depth[i] > 0 ? depth[i] * distance : 0;
    return depth;
  }

  /// In a grey medium -log(left / flight) / sigma_t. In others Newton's method, from a distance
  /// that is too short: since the sum of exponentials is convex, it comes closer from there.
  double flight_distance(const Ray&, const Color& flight, double left) const override {
    const Color& sigma = coefficients_.extinction;
    double t = std::log(mean(flight) / left) / max_component(sigma);
    if (sigma.x == sigma.y && sigma.y == sigma.z) return t;
    for (int i = 0; i < 100; ++i) {
      const Color now = flight * exp(-sigma * t);
      const double step = (mean(now) - left) / mean(sigma * now);
      t += step;
      if (!(step > 1e-14 * t)) break;
    }
    return t;
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
