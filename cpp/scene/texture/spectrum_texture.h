// Textures that are spectra: the same everywhere, and a colour that depends on the use.
#pragma once

#include "scene/texture/texture.h"

#include <functional>

namespace mlt {

/// A spectrum that reflects is seen under D65 where there are no wavelengths; one that emits is
/// seen as it is. It is taken for a reflectance until a parameter asks for something else.
class SpectrumTexture final : public Texture {
 public:
  using OfUse = std::function<UsedSpectrum(SpectrumUse)>;

  explicit SpectrumTexture(OfUse of_use)
      : of_use_(std::move(of_use)), reflected_(of_use_(SpectrumUse::reflectance).color) {}

  Spectrum eval(const SurfacePoint& at) const override { return reflected_.at(at.wavelength); }
  bool is_constant() const override { return true; }
  Color mean() const override { return reflected_.rgb(); }
  Color maximum() const override { return reflected_.rgb(); }
  std::optional<UsedSpectrum> spectrum(SpectrumUse use) const override { return of_use_(use); }
  TexturePtr own_light() const override {
    return constant_texture(of_use_(SpectrumUse::emission).color);
  }

 private:
  OfUse of_use_;
  SpectralColor reflected_;
};

/// One spectrum for every use, light by itself.
std::shared_ptr<SpectrumTexture> emitted_spectrum(const UsedSpectrum& light);
/// The spectrum of a table, linear between its values and zero outside. Throws SceneError about the
/// parameter `name` unless two or more wavelengths increase, the range is partly visible, and no
/// value is negative.
std::shared_ptr<SpectrumTexture> table_spectrum(Params& params, const std::string& name,
                                                const WavelengthTable& table);
/// The numbers of a text parameter. Throws SceneError if one of its words is no number.
std::vector<double> numbers_param(Params& params, const std::string& name);

}  // namespace mlt
