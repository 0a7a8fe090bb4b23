#include "scene/texture.h"

#include "math/colorimetry.h"
#include "scene/matrix_rows.h"
#include "scene/motion.h"

namespace mlt {
namespace {

class Constant final : public Texture {
 public:
  explicit Constant(const Color& color) : color_(color) {}
  Spectrum eval(const SurfacePoint&) const override { return Spectrum(color_); }
  bool is_constant() const override { return true; }
  Color mean() const override { return color_; }
  Color maximum() const override { return color_; }

 private:
  Color color_;
};

Color spectrum_color(Params& params, const std::string& name, const WavelengthTable& spectrum,
                     SpectrumUse use) {
  if (spectrum.size() == 1) return uniform_spectrum_to_rgb(spectrum[0].second, use);
  try {
    const SpectrumColor found = spectrum_to_rgb(spectrum, use);
    if (found.clamped && use != SpectrumUse::unbounded)
      params.warn("'" + name + "' is outside of the sRGB gamut and was clamped");
    return found.color;
  } catch (const UsageError& error) {
    params.fail(name, std::string("is no valid spectrum: ") + error.what());
  }
}

}  // namespace

double Texture::eval_scalar(const SurfacePoint& at) const {
  const Color c = eval(at).rgb();
  return (c.x + c.y + c.z) / 3;
}

TexturePtr constant_texture(const Color& color) { return std::make_shared<Constant>(color); }

Color to_color(Params& params, const std::string& name, SpectrumUse use) {
  const Value& value = params.value(name);
  if (const Triple* rgb = std::get_if<Triple>(&value)) return {(*rgb)[0], (*rgb)[1], (*rgb)[2]};
  if (const WavelengthTable* spectrum = std::get_if<WavelengthTable>(&value))
    return spectrum_color(params, name, *spectrum, use);
  if (std::holds_alternative<ObjectPtr>(value))
    params.fail(name, "should be a number, an rgb triple or a spectrum");
  return Color(params.real(name));
}

namespace {

bool is_emission(const Params& params, const std::string& name) {
  const ParamType type = params.schema().find(name)->type;
  return type == ParamType::radiance || type == ParamType::emission || type == ParamType::volume;
}

Color color_from_0(Params& params, const std::string& name) {
  const bool emission = is_emission(params, name);
  const Color color =
      to_color(params, name, emission ? SpectrumUse::emission : SpectrumUse::reflectance);
  if (min_component(color) < 0) params.fail(name, "must not be negative");
  return color;
}

/// The nested texture of this name, or nullptr if a colour is given instead.
TexturePtr nested_texture(Params& params, const std::string& name) {
  const ObjectPtr* object = std::get_if<ObjectPtr>(&params.value(name));
  if (!object) return nullptr;
  TexturePtr texture = std::dynamic_pointer_cast<const Texture>(*object);
  if (!texture) params.fail(name, "is an object, but not a texture");
  return texture;
}

}  // namespace

Color color_param(Params& params, const std::string& name) {
  const Color color = color_from_0(params, name);
  if (!is_emission(params, name) && max_component(color) > 1)
    params.fail(name,
                fmt::format("reaches {:f}, but must lie between 0 and 1", max_component(color)));
  return color;
}

TexturePtr texture_param(Params& params, const std::string& name) {
  const TexturePtr texture = nested_texture(params, name);
  return texture ? texture : constant_texture(color_param(params, name));
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
