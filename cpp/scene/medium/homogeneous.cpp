// A medium that is the same everywhere.
#include "base/registry.h"
#include "scene/medium/coefficients.h"
#include "scene/phase/isotropic.h"

namespace mlt {
namespace {

class Homogeneous final : public Medium {
 public:
  explicit Homogeneous(Params& params)
      : Medium(phase_param(params)),
        coefficients_(params),
        radiance_(spectral_param(params, "emission")) {
    in_rgb_ = coefficients_.at(rgb_lanes);
    check_extinction(params, max_component(in_rgb_.extinction));
  }

  MediumCoefficients at(const Vec3&, double wavelength) const override {
    return wavelength < 0 ? in_rgb_ : coefficients_.at(wavelength);
  }
  bool scatters() const override { return !is_black(in_rgb_.scattering); }
  Spectrum emission(const Vec3& p, double wavelength) const override {
    return at(p, wavelength).absorption() * radiance_.at(wavelength);
  }
  bool emits() const override { return !is_black(emission(Vec3(0), rgb_lanes)); }
  bool grey() const override { return coefficients_.grey(); }

  Flight fly(const Ray& ray, const FlightLimit& limit) const override {
    return uniform_flight(at(ray.o, ray.wavelength).extinction, limit);
  }

 private:
  Coefficients coefficients_;
  MediumCoefficients in_rgb_;
  SpectralColor radiance_;  ///< L_e.
};

}  // namespace

Plugin medium_homogeneous() {
  std::vector<Parameter> parameters = coefficient_parameters();
  parameters.push_back(emission_parameter(ParamType::radiance));
  return make_plugin<Homogeneous>("medium", "homogeneous", "A medium that is the same everywhere.",
                                  std::move(parameters));
}

}  // namespace mlt
