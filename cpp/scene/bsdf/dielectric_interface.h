// The common part of all interfaces between transparent media: the relative index of refraction,
// factors of reflection and transmission, and the probabilities of sampling them.
#pragma once

#include "scene/bsdf/ior_params.h"
#include "scene/bsdf/lobes.h"
#include "scene/texture/texture.h"

namespace mlt {

class DielectricInterface {
 public:
  explicit DielectricInterface(Params& params)
      : reflectance(texture_param(params, "specular_reflectance")),
        transmittance(texture_param(params, "specular_transmittance")),
        index_(relative_index_param(params)),
        eta_(index_.in_rgb()),
        reflection_weight_(target_luminance(reflectance->mean())),
        transmission_weight_(target_luminance(transmittance->mean())) {}

  /// n_below / n_above where there are no wavelengths, and at the first wavelength of a point.
  double eta() const { return eta_; }
  double eta(const SurfacePoint& at) const {
    return disperses(at) ? index_.at_nm(wavelength_of(at.wavelength)) : eta_;
  }
  /// Whether light of different wavelengths is refracted differently.
  bool disperses(const SurfacePoint& at) const { return at.wavelength >= 0 && index_.disperses(); }
  /// reflected(eta) at the wavelengths of a point, of which the first has `first`.
  template <class Reflected>
  Spectrum at_wavelengths(const SurfacePoint& at, double first, Reflected&& reflected) const {
    if (!disperses(at)) return Spectrum(first);
    return mlt::at_wavelengths(at.wavelength,
                               [&](double nm) { return reflected(index_.at_nm(nm)); });
  }
  /// Light that is refracted, of which the first wavelength goes on where the others do not.
  Scattering refracted(const SurfacePoint& at, const Spectrum& f, double from_light,
                       double from_camera) const {
    const bool alone = disperses(at);
    return {alone ? first_lane(f) : f, from_light, from_camera, alone};
  }

  /// Probability of choosing reflection where the fraction F is reflected: in proportion to the
  /// mean power of both.
  double reflection_probability(double F) const {
    return first_share(F * reflection_weight_, (1 - F) * transmission_weight_);
  }
  /// The albedo of an interface that reflects the fraction F.
  Spectrum albedo(const SurfacePoint& at, double F) const {
    return F * reflectance->eval(at) + (1 - F) * transmittance->eval(at);
  }

  const SideIndex& inside() const { return index_.inside; }
  /// Puts something else above the surface.
  void immerse(const SideIndex& outside) {
    index_.outside = outside;
    eta_ = index_.in_rgb();
  }

  TexturePtr reflectance, transmittance;

 private:
  RelativeIndex index_;
  double eta_;
  double reflection_weight_, transmission_weight_;
};

}  // namespace mlt
