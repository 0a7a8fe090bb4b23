// Another texture times a factor, as in Mitsuba 0.6 for heights and brightness.
#include "base/registry.h"
#include "scene/nested.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

class Scale final : public Texture {
 public:
  explicit Scale(Params& params)
      : scale_(to_spectral(params, "scale", SpectrumUse::unbounded)),
        nested_(only_nested<Texture>(params, "texture")) {}

  Spectrum eval(const SurfacePoint& at) const override {
    return scale_.at(at.wavelength) * nested_->eval(at);
  }
  /// The gradient, exact if the factor is the same in all channels.
  Vec2 gradient(const SurfacePoint& at) const override {
    return luminance(scale_.rgb()) * nested_->gradient(at);
  }
  bool is_constant() const override { return nested_->is_constant(); }
  TexturePtr own_light() const override {
    const TexturePtr light = nested_->own_light();
    if (!light) return nullptr;
    auto scaled = std::make_shared<Scale>(*this);
    scaled->nested_ = light;
    return scaled;
  }
  Color mean() const override { return scale_.rgb() * nested_->mean(); }
  Color maximum() const override { return scale_.rgb() * nested_->maximum(); }

 private:
  SpectralColor scale_;
  TexturePtr nested_;
};

}  // namespace

Plugin texture_scale() {
  Plugin plugin = make_plugin<Scale>(
      "texture", "scale", "Multiplies the one nested texture, whatever its name.",
      {{"scale", ParamType::radiance, 1.0, "The factor: a number or a colour."}});
  plugin.schema.unnamed_texture = true;
  return plugin;
}

}  // namespace mlt
