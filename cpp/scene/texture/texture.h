// A colour or number that varies over a surface.
#pragma once

#include "base/params.h"
#include "math/colorimetry.h"
#include "scene/surface_point.h"
#include "scene/texture/spectral_color.h"

namespace mlt {

class Texture;
using TexturePtr = std::shared_ptr<const Texture>;

/// A spectrum as the colour of a parameter, and whether its RGB was clamped to what is possible.
struct UsedSpectrum {
  SpectralColor color;
  bool clamped = false;
};

class Texture : public Object {
 public:
  virtual Spectrum eval(const SurfacePoint& at) const = 0;
  /// Prefetches the memory that eval() is about to read there.
  virtual void prefetch(const SurfacePoint& /*at*/) const {}
  /// The value in RGB, whatever the wavelength of the path.
  Color eval_rgb(const SurfacePoint& at) const;
  /// The mean of R, G and B, for textures of a scalar such as roughness.
  double eval_scalar(const SurfacePoint& at) const { return mlt::mean(eval_rgb(at)); }
  /// The derivatives of the luminance by u and v, for bump maps; 0 if it is piecewise constant.
  virtual Vec2 gradient(const SurfacePoint& /*at*/) const { return Vec2(0); }

  /// The resolution of an image, in texels.
  virtual Vec2i resolution() const { return Vec2i(1); }
  virtual bool is_constant() const { return false; }
  /// The colour of one that is a spectrum, such as a black body; it depends on the use. Others,
  /// which vary over a surface, have none.
  virtual std::optional<UsedSpectrum> spectrum(SpectrumUse /*use*/) const { return std::nullopt; }
  /// What it is where it emits light; nullptr if that is itself times D65, as for images.
  virtual TexturePtr own_light() const { return nullptr; }
  virtual Color mean() const = 0;     ///< Average over the texture, for sampling probabilities.
  virtual Color maximum() const = 0;  ///< Upper bound, for energy conservation.
};

TexturePtr constant_texture(const SpectralColor& color);
inline TexturePtr constant_texture(double grey) {
  return constant_texture({Color(grey), RgbMeaning::coefficient});
}

/// What a texture is where it emits light: spectra as they are, others under D65.
TexturePtr as_light(const TexturePtr& texture);
/// What a colour in RGB stands for in this use.
RgbMeaning meaning_of(SpectrumUse use);
/// The colour of a table of wavelengths. Throws UsageError if it is no spectrum, or has negative
/// values where only optical constants may.
UsedSpectrum spectrum_of_table(const WavelengthTable& table, SpectrumUse use);
/// Whether a table has no value at a visible wavelength.
bool is_invisible(const WavelengthTable& table);

/// The texture parameter `name`: a nested Texture, or a constant from a number, rgb or spectrum.
/// `texture` parameters are bounded to [0, 1] (SceneError otherwise), `emission` ones must be >= 0.
TexturePtr texture_param(Params& params, const std::string& name);
/// A texture parameter, as above, with a constant that may be larger than 1.
TexturePtr unbounded_texture_param(Params& params, const std::string& name);
/// The colour parameter `name` (type reflectance or radiance).
SpectralColor spectral_param(Params& params, const std::string& name);
/// Refuses light that would overflow the floats of an image, wherever it goes.
void check_brightness(const Params& params, const std::string& name, const Color& light);
inline Color color_param(Params& params, const std::string& name) {
  return spectral_param(params, name).rgb();
}
/// Converts a number, rgb or spectrum to a colour for `use`, without checking its range.
SpectralColor to_spectral(Params& params, const std::string& name, SpectrumUse use);
inline Color to_color(Params& params, const std::string& name, SpectrumUse use) {
  return to_spectral(params, name, use).rgb();
}

}  // namespace mlt
