// Mitsuba's daylight: CIE standard illuminant D65, which is white in RGB, times a colour or a
// texture.
#include "base/registry.h"
#include "scene/nested.h"
#include "scene/texture/spectrum_texture.h"

namespace mlt {
namespace {

constexpr double brightest_d65 = 1e30;

/// A texture under D65, whether it reflects or emits.
class UnderD65 final : public Texture {
 public:
  UnderD65(const TexturePtr& texture, double scale) : light_(as_light(texture)), scale_(scale) {}

  Spectrum eval(const SurfacePoint& at) const override { return scale_ * light_->eval(at); }
  void prefetch(const SurfacePoint& at) const override { light_->prefetch(at); }
  Vec2 gradient(const SurfacePoint& at) const override { return scale_ * light_->gradient(at); }
  Vec2i resolution() const override { return light_->resolution(); }
  bool is_constant() const override { return light_->is_constant(); }
  Color mean() const override { return scale_ * light_->mean(); }
  Color maximum() const override { return scale_ * light_->maximum(); }
  TexturePtr own_light() const override { return std::make_shared<UnderD65>(*this); }

 private:
  TexturePtr light_;
  double scale_;
};

ObjectPtr make_d65(Params& params) {
  const double scale = params.real_in("scale", 0, brightest_d65);
  TexturePtr nested = optional_nested<Texture>(params, "texture");
  if (nested && params.has("color")) params.fail("color", "cannot be given beside a texture");
  if (const auto* object = std::get_if<ObjectPtr>(&params.value("color")))
    nested = std::dynamic_pointer_cast<const Texture>(*object);
  if (nested && !nested->spectrum(SpectrumUse::unbounded))
    return std::make_shared<UnderD65>(nested, scale);
  const Color rgb = nested ? nested->mean() : to_color(params, "color", SpectrumUse::unbounded);
  if (min_component(rgb) < 0) params.fail("color", "must not be negative");
  return emitted_spectrum({{scale * rgb, RgbMeaning::light}});
}

}  // namespace

Plugin texture_d65() {
  Plugin plugin{{"texture",
                 "d65",
                 "Daylight, which is white in RGB, times a colour or the one nested texture.",
                 {{"color", ParamType::emission, 1.0, "The colour: RGB, or a texture."},
                  {"scale", ParamType::real, 1.0, "A factor."}}},
                make_d65};
  plugin.schema.unnamed_texture = true;
  return plugin;
}

}  // namespace mlt
