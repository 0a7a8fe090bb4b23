#include "scene/texture/texture.h"

#include "math/colorimetry.h"
#include "scene/light/brightest_light.h"
#include "scene/texture/animation.h"

namespace mlt {
namespace {

class Constant final : public Texture {
 public:
  explicit Constant(const SpectralColor& color) : color_(color) {}
  Spectrum eval(const SurfacePoint& at) const override { return color_.at(at.wavelength); }
  bool is_constant() const override { return true; }
  Color mean() const override { return color_.rgb(); }
  Color maximum() const override { return color_.rgb(); }

 private:
  SpectralColor color_;
};

/// A texture that lights up, such as an image: in a spectral scene its white is that of D65.
class Illuminated final : public Texture {
 public:
  explicit Illuminated(TexturePtr texture) : texture_(std::move(texture)) {}
  Spectrum eval(const SurfacePoint& at) const override {
    const Spectrum value = texture_->eval(at);
    return at.wavelength < 0 ? value : value * daylight(at.wavelength);
  }
  void prefetch(const SurfacePoint& at) const override { texture_->prefetch(at); }
  Vec2 gradient(const SurfacePoint& at) const override { return texture_->gradient(at); }
  Vec2i resolution() const override { return texture_->resolution(); }
  bool is_constant() const override { return texture_->is_constant(); }
  Color mean() const override { return texture_->mean(); }
  Color maximum() const override { return texture_->maximum(); }

 private:
  TexturePtr texture_;
};

UsedSpectrum used_spectrum(Params& params, const std::string& name, const WavelengthTable& table,
                           SpectrumUse use) {
  try {
    const UsedSpectrum used = spectrum_of_table(table, use);
    if (is_invisible(table))
      params.warn(fmt::format("'{}' has no wavelength from {:.0f} to {:.0f} nm, so it is black",
                              name, first_wavelength, last_wavelength));
    return used;
  } catch (const UsageError& error) {
    params.fail(name, std::string("is no valid spectrum: ") + error.what());
  }
}

/// The spectrum that is nested as this parameter, if one is.
std::optional<UsedSpectrum> nested_spectrum(const Value& value, SpectrumUse use) {
  const ObjectPtr* object = std::get_if<ObjectPtr>(&value);
  const Texture* texture = object ? dynamic_cast<const Texture*>(object->get()) : nullptr;
  return texture ? texture->spectrum(use) : std::nullopt;
}

}  // namespace

Color Texture::eval_rgb(const SurfacePoint& at) const {
  if (at.wavelength < 0) return eval(at).rgb();
  SurfacePoint in_rgb = at;
  in_rgb.wavelength = rgb_lanes;
  return eval(in_rgb).rgb();
}

TexturePtr constant_texture(const SpectralColor& color) {
  return std::make_shared<Constant>(color);
}

TexturePtr as_light(const TexturePtr& texture) {
  const TexturePtr own = texture->own_light();
  return own ? own : std::make_shared<Illuminated>(texture);
}

RgbMeaning meaning_of(SpectrumUse use) {
  switch (use) {
    case SpectrumUse::reflectance: return RgbMeaning::reflectance;
    case SpectrumUse::unbounded: return RgbMeaning::coefficient;
    case SpectrumUse::emission: break;
  }
  return RgbMeaning::light;
}

UsedSpectrum spectrum_of_table(const WavelengthTable& table, SpectrumUse use) {
  const Curve curve = Curve::table(table);
  if (use != SpectrumUse::unbounded)
    for (const auto& [wavelength, value] : table)
      if (value < 0)
        throw UsageError(
            fmt::format("its value at {} nm is {}, but must not be negative", wavelength, value));
  if (table.size() == 1) return {{uniform_spectrum_to_rgb(table[0].second, use), curve}};
  const SpectrumColor found = spectrum_to_rgb(table, use);
  return {{found.color, curve}, found.clamped && use != SpectrumUse::unbounded};
}

bool is_invisible(const WavelengthTable& table) {
  return table.size() > 1 &&
         (table.back().first < first_wavelength || table.front().first > last_wavelength);
}

SpectralColor to_spectral(Params& params, const std::string& name, SpectrumUse use) {
  const Value& value = params.value(name);
  if (const Triple* rgb = std::get_if<Triple>(&value))
    return {Color((*rgb)[0], (*rgb)[1], (*rgb)[2]), meaning_of(use)};
  std::optional<UsedSpectrum> used = nested_spectrum(value, use);
  if (const WavelengthTable* table = std::get_if<WavelengthTable>(&value))
    used = used_spectrum(params, name, *table, use);
  if (used && used->clamped)
    params.warn("'" + name + "' is outside of the sRGB gamut and was clamped");
  if (used) return used->color;
  if (std::holds_alternative<ObjectPtr>(value))
    params.fail(name, "should be a number, an rgb triple or a spectrum");
  return {Color(params.real(name)), meaning_of(use)};
}

void check_brightness(const Params& params, const std::string& name, const Color& light) {
  if (!(max_component(light) <= brightest_light))
    params.fail(name,
                fmt::format("reaches {:g}, but must be at most {:g}, so that images can hold it",
                            max_component(light), brightest_light));
}

namespace {

bool is_emission(const Params& params, const std::string& name) {
  const ParamType type = params.schema().find(name)->type;
  return type == ParamType::radiance || type == ParamType::lamp || type == ParamType::emission ||
         type == ParamType::volume;
}

SpectralColor color_from_0(Params& params, const std::string& name) {
  const bool emission = is_emission(params, name);
  SpectralColor color =
      to_spectral(params, name, emission ? SpectrumUse::emission : SpectrumUse::reflectance);
  if (min_component(color.rgb()) < 0) params.fail(name, "must not be negative");
  if (emission) check_brightness(params, name, color.rgb());
  return color;
}

void check_bound(const Params& params, const std::string& name, double most) {
  if (most > 1) params.fail(name, fmt::format("reaches {:f}, but must lie between 0 and 1", most));
}

}  // namespace

SpectralColor spectral_param(Params& params, const std::string& name) {
  SpectralColor color = color_from_0(params, name);
  if (!is_emission(params, name)) check_bound(params, name, max_component(color.rgb()));
  return color;
}

namespace {

/// The nested texture of this name, or nullptr if a colour is given instead. The values of a
/// spectrum are checked.
TexturePtr nested_texture(Params& params, const std::string& name, bool bounded) {
  const ObjectPtr* object = std::get_if<ObjectPtr>(&params.value(name));
  if (!object) return nullptr;
  TexturePtr texture = std::dynamic_pointer_cast<const Texture>(*object);
  if (!texture) params.fail(name, "is an object, but not a texture");
  if (texture->spectrum(SpectrumUse::unbounded)) {
    const SpectralColor color = bounded ? spectral_param(params, name) : color_from_0(params, name);
    if (is_emission(params, name)) return constant_texture(color);
    return texture;
  }
  if (!is_emission(params, name)) {
    if (const auto* animated = dynamic_cast<const AnimatedTexture*>(texture.get());
        bounded && animated)
      check_bound(params, name, animated->largest_color());
    return texture;
  }
  check_brightness(params, name, texture->mean());
  return as_light(texture);
}

}  // namespace

TexturePtr texture_param(Params& params, const std::string& name) {
  const TexturePtr texture = nested_texture(params, name, true);
  return texture ? texture : constant_texture(spectral_param(params, name));
}

TexturePtr unbounded_texture_param(Params& params, const std::string& name) {
  const TexturePtr texture = nested_texture(params, name, false);
  return texture ? texture : constant_texture(color_from_0(params, name));
}

}  // namespace mlt
