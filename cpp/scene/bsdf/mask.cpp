// A surface with holes: where its opacity is o, light is scattered by the nested material with the
// weight o, and passes straight through with 1 - o. The passage is a null lobe, and so a vertex of
// the path: every integrator knows its probability, and none has to trace through surfaces.
#include "base/registry.h"
#include "scene/bsdf.h"
#include "scene/bsdf/lobes.h"
#include "scene/nested.h"
#include "scene/texture.h"

namespace mlt {
namespace {

class Mask final : public Bsdf {
 public:
  explicit Mask(Params& params)
      : opacity_(texture_param(params, "opacity")), nested_(only_nested<Bsdf>(params, "bsdf")) {}

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    const Color opacity = opacity_->eval(at);
    const double p = target_luminance(opacity);
    Scattering s = nested_->scattering(at, wl, wc, lobe);
    s.f *= opacity;
    s.pdf_from_light *= p;
    s.pdf_from_camera *= p;
    if (lobe == Lobe::null) {
      s.f += Color(1) - opacity;
      s.pdf_from_light += 1 - p;
      s.pdf_from_camera += 1 - p;
    }
    return s;
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    const double p = target_luminance(opacity_->eval(at));
    if (u.x >= p) return BsdfSample{-from, Lobe::null};
    return nested_->sample(at, from, {u.x / p, u.y, u.z});
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    const double p = target_luminance(opacity_->eval(at));
    const double first = p * nested_->pdf(at, from, to, lobe),
                 second = lobe == Lobe::null ? 1 - p : 0;
    if (!(first + second > 0)) return std::nullopt;
    const LobeGuess guess = guess_lobe(first, second, v.x);
    if (!guess.first) return Vec3(u_of_second(p, guess.rest), v.y, v.z);
    auto u = nested_->invert(at, from, to, lobe, {guess.rest, v.y, v.z});
    if (u) u->x = u_of_first(p, u->x);
    return u;
  }

  bool has_smooth() const override { return nested_->has_smooth(); }
  bool has_delta() const override { return true; }
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
  Color albedo(const SurfacePoint& at) const override {
    const Color opacity = opacity_->eval(at);
    return opacity * nested_->albedo(at) + Color(1) - opacity;
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
