// A medium that varies in space. What lies along a ray is integrated exactly, cell by cell, without
// null collisions: so a path has no other vertices than those where it is scattered, and all that
// holds for homogeneous media holds here.
#include "base/registry.h"
#include "scene/medium/medium.h"
#include "scene/medium/radiance.h"
#include "scene/phase/isotropic.h"
#include "scene/volume/volume.h"

namespace mlt {
namespace {

class Heterogeneous final : public Medium {
 public:
  explicit Heterogeneous(Params& params)
      : Medium(phase_param(params)),
        extinction_(volume_param(params, "sigma_t")),
        albedo_(volume_param(params, "albedo")),
        radiance_(params),
        scale_(params.real_in("scale", 0, 1e12)) {
    if (max_component(albedo_->maximum()) > 1)
      params.fail("albedo", fmt::format("reaches {:f}, but must lie between 0 and 1",
                                        max_component(albedo_->maximum())));
    check_extinction(params, scale_ * max_component(extinction_->maximum()));
  }

  MediumCoefficients at(const Vec3& p, double wavelength) const override {
    const Spectrum extinction = scale_ * extinction_->at(p, wavelength);
    return {extinction, albedo_->at(p, wavelength) * extinction};
  }
  Flight fly(const Ray& ray, const FlightLimit& limit) const override {
    return extinction_->fly(ray, limit, scale_);
  }
  bool scatters() const override {
    return scale_ > 0 && !is_black(albedo_->maximum() * extinction_->maximum());
  }
  Spectrum emission(const Vec3& p, double wavelength) const override {
    const Spectrum radiance = radiance_.at(p, wavelength);
    return is_black(radiance) ? radiance : at(p, wavelength).absorption() * radiance;
  }
  bool emits() const override {
    return scale_ > 0 && !is_black(extinction_->maximum() * radiance_.maximum());
  }
  bool varies() const override { return true; }
  bool grey() const override { return extinction_->grey(); }

 private:
  VolumePtr extinction_, albedo_;
  MediumRadiance radiance_;  ///< L_e.
  double scale_;
};

}  // namespace

Plugin medium_heterogeneous() {
  std::vector<Parameter> parameters = {
      {"sigma_t", ParamType::volume, 1.0, "Extinction coefficient, per unit of length."},
      {"albedo", ParamType::volume, 0.75, "Share of the extinction that is scattered."},
      {"scale", ParamType::real, 1.0, "Factor of the extinction."}};
  for (Parameter& parameter : radiance_parameters()) parameters.push_back(std::move(parameter));
  return make_plugin<Heterogeneous>(
      "medium", "heterogeneous", "A medium that varies in space: smoke, clouds, fire.",
      std::move(parameters),
      {"majorant_resolution_factor", "majorant_grid", "sample_emitters", "majorant_factor"});
}

}  // namespace mlt
