// A surface with holes: where its opacity is o, light is scattered by the nested material with the
// weight o, and goes straight through with 1 - o.
#include "base/registry.h"
#include "scene/bsdf/bsdf.h"
#include "scene/nested.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

class Mask final : public Bsdf {
 public:
  explicit Mask(Params& params)
      : opacity_(texture_param(params, "opacity")), nested_(only_nested<Bsdf>(params, "bsdf")) {
    inside_ = nested_->inside();
    glow_ = nested_->glow();
  }

  Passage passage(const SurfacePoint& at, const Vec3& w) const override {
    const Spectrum opacity = opacity_->eval(at);
    const double p = target_luminance(opacity);
    const Passage nested = nested_->passage(at, w);
    return {Spectrum(1) - opacity + opacity * nested.transmittance, 1 - p + p * nested.probability};
  }
  bool has_passage() const override { return true; }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    Scattering s = nested_->scattering(at, wl, wc, lobe);
    s.f *= opacity_->eval(at);
    return s;
  }
  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    return nested_->sample(at, from, u);
  }
  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    return nested_->invert(at, from, to, lobe, v);
  }

  bool has_smooth() const override { return nested_->has_smooth(); }
  bool has_delta() const override { return nested_->has_delta(); }
  bool has_transmission() const override { return true; }
  double relative_eta(const SurfacePoint& at, const Vec3& w) const override {
    return nested_->relative_eta(at, w);
  }
  Vec3 delta_normal(const SurfacePoint& at, const Vec3& w) const override {
    return nested_->delta_normal(at, w);
  }
  bool bends_normal() const override { return nested_->bends_normal(); }
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    return nested_->roughness(at, wl, wc);
  }
  double least_roughness() const override { return nested_->least_roughness(); }
  Spectrum albedo(const SurfacePoint& at) const override {
    const Spectrum opacity = opacity_->eval(at);
    return opacity * nested_->albedo(at) + Spectrum(1) - opacity;
  }

 private:
  TexturePtr opacity_;
  BsdfPtr nested_;
};

}  // namespace

Plugin bsdf_mask() {
  Plugin plugin = make_plugin<Mask>(
      "bsdf", "mask", "Makes the nested bsdf transparent where its opacity is below 1.",
      {{"opacity", ParamType::texture, 0.5, "Share of the light that meets the nested bsdf."}});
  plugin.schema.reciprocal = false;  // the nested one may refract
  return plugin;
}

}  // namespace mlt
