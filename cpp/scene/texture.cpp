#include "scene/texture.h"

#include "math/colorimetry.h"
#include "scene/matrix_rows.h"
#include "scene/motion.h"

namespace mlt {
namespace {

class Constant final : public Texture {
 public:
  explicit Constant(const SpectralColor& color) : color_(color) {}
  Spectrum eval(const SurfacePoint& at) const override { return color_.at(at.wavelength); }
  double eval_scalar(const SurfacePoint&) const override { return mlt::mean(color_.rgb()); }
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
    return at.wavelength < 0 ? value : value * at_wavelengths(at.wavelength, d65);
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

RgbMeaning meaning_of(SpectrumUse use) {
  switch (use) {
    case SpectrumUse::reflectance: return RgbMeaning::reflectance;
    case SpectrumUse::unbounded: return RgbMeaning::coefficient;
    case SpectrumUse::emission: break;
  }
  return RgbMeaning::light;
}

SpectralColor spectrum_color(Params& params, const std::string& name,
                             const WavelengthTable& spectrum, SpectrumUse use) {
  try {
    const Curve curve = Curve::table(spectrum);
    if (spectrum.size() == 1) return {uniform_spectrum_to_rgb(spectrum[0].second, use), curve};
    const SpectrumColor found = spectrum_to_rgb(spectrum, use);
    if (found.clamped && use != SpectrumUse::unbounded)
      params.warn("'" + name + "' is outside of the sRGB gamut and was clamped");
    return {found.color, curve};
  } catch (const UsageError& error) {
    params.fail(name, std::string("is no valid spectrum: ") + error.what());
  }
}

}  // namespace

double Texture::eval_scalar(const SurfacePoint& at) const {
  const Color c = eval(at).rgb();
  return mlt::mean(c);
}

TexturePtr constant_texture(const SpectralColor& color) {
  return std::make_shared<Constant>(color);
}

SpectralColor to_spectral(Params& params, const std::string& name, SpectrumUse use) {
  const Value& value = params.value(name);
  if (const Triple* rgb = std::get_if<Triple>(&value))
    return {Color((*rgb)[0], (*rgb)[1], (*rgb)[2]), meaning_of(use)};
  if (const WavelengthTable* spectrum = std::get_if<WavelengthTable>(&value))
    return spectrum_color(params, name, *spectrum, use);
  if (std::holds_alternative<ObjectPtr>(value))
    params.fail(name, "should be a number, an rgb triple or a spectrum");
  return {Color(params.real(name)), meaning_of(use)};
}

namespace {

bool is_emission(const Params& params, const std::string& name) {
  const ParamType type = params.schema().find(name)->type;
  return type == ParamType::radiance || type == ParamType::emission || type == ParamType::volume;
}

SpectralColor color_from_0(Params& params, const std::string& name) {
  const bool emission = is_emission(params, name);
  SpectralColor color =
      to_spectral(params, name, emission ? SpectrumUse::emission : SpectrumUse::reflectance);
  if (min_component(color.rgb()) < 0) params.fail(name, "must not be negative");
  return color;
}

/// The nested texture of this name, or nullptr if a colour is given instead.
TexturePtr nested_texture(Params& params, const std::string& name) {
  const ObjectPtr* object = std::get_if<ObjectPtr>(&params.value(name));
  if (!object) return nullptr;
  TexturePtr texture = std::dynamic_pointer_cast<const Texture>(*object);
  if (!texture) params.fail(name, "is an object, but not a texture");
  return is_emission(params, name) ? std::make_shared<Illuminated>(texture) : texture;
}

}  // namespace

SpectralColor spectral_param(Params& params, const std::string& name) {
  SpectralColor color = color_from_0(params, name);
  const double most = max_component(color.rgb());
  if (!is_emission(params, name) && most > 1)
    params.fail(name, fmt::format("reaches {:f}, but must lie between 0 and 1", most));
  return color;
}

TexturePtr texture_param(Params& params, const std::string& name) {
  const TexturePtr texture = nested_texture(params, name);
  return texture ? texture : constant_texture(spectral_param(params, name));
}

TexturePtr unbounded_texture_param(Params& params, const std::string& name) {
  const TexturePtr texture = nested_texture(params, name);
  return texture ? texture : constant_texture(color_from_0(params, name));
}

Vec3 vector_param(Params& params, const std::string& name) {
  const Triple t = params.triple(name);
  return {t[0], t[1], t[2]};
}

Mat4 matrix_param(Params& params, const std::string& name) {
  const Parameter* parameter = params.schema().find(name);
  const bool has_default = !std::holds_alternative<std::monostate>(parameter->default_value);
  if (!has_default && !params.has(name)) return Mat4(1);
  if (const auto* animation = std::get_if<Animation>(&params.value(name)))
    return at_rest(*animation);
  return from_rows(params.matrix(name));
}

}  // namespace mlt
