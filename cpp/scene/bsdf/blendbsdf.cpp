// A blend of two materials, by a weight that may vary over the surface: (1 - w) f_1 + w f_2.
#include "base/registry.h"
#include "scene/bsdf.h"
#include "scene/bsdf/lobes.h"
#include "scene/texture.h"

namespace mlt {
namespace {

class Blend final : public Bsdf {
 public:
  explicit Blend(Params& params) : weight_(texture_param(params, "weight")) {
    const auto nested = params.objects<Bsdf>();
    if (nested.size() != 2)
      params.fail("needs two nested bsdfs, but has " + std::to_string(nested.size()));
    first_ = nested[0];
    second_ = nested[1];
    const Vec3 up(0, 0, 1);
    if (refracts(*first_) && refracts(*second_) &&
        first_->relative_eta({}, up) != second_->relative_eta({}, up))
      params.fail("cannot blend two bsdfs that refract light differently");
  }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    const Scattering a = first_->scattering(at, wl, wc, lobe);
    const Scattering b = second_->scattering(at, wl, wc, lobe);
    const double w = weight(at);
    const auto blend = [&](const auto& x, const auto& y) { return (1 - w) * x + w * y; };
    return {blend(a.f, b.f), blend(a.pdf_from_light, b.pdf_from_light),
            blend(a.pdf_from_camera, b.pdf_from_camera)};
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    const double p = 1 - weight(at);
    if (u.x < p) return first_->sample(at, from, {u.x / p, u.y, u.z});
    return second_->sample(at, from, {(u.x - p) / (1 - p), u.y, u.z});
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to,
                             Lobe lobe) const override {
    const double p = 1 - weight(at);
    if (p > 0)
      if (const auto u = first_->invert(at, from, to, lobe)) return Vec3(u->x * p, u->y, u->z);
    if (p < 1)
      if (const auto u = second_->invert(at, from, to, lobe))
        return u_of(std::min(p + u->x * (1 - p), 1 - 0x1p-53), {u->y, u->z});
    return std::nullopt;
  }

  bool has_smooth() const override { return first_->has_smooth() || second_->has_smooth(); }
  bool has_delta() const override { return first_->has_delta() || second_->has_delta(); }
  bool has_transmission() const override {
    return first_->has_transmission() || second_->has_transmission();
  }
  double relative_eta(const SurfacePoint& at, const Vec3& w) const override {
    return (refracts(*first_) ? *first_ : *second_).relative_eta(at, w);
  }
  /// Of the part that scatters more between these directions.
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    const auto strength = [&](const Bsdf& part) {
      return target_luminance(part.eval(at, wl, wc, Lobe::smooth));
    };
    const double w = weight(at);
    return ((1 - w) * strength(*first_) >= w * strength(*second_) ? *first_ : *second_)
        .roughness(at, wl, wc);
  }
  Color albedo(const SurfacePoint& at) const override {
    return (1 - weight(at)) * first_->albedo(at) + weight(at) * second_->albedo(at);
  }

 private:
  /// Rather than letting light straight through.
  static bool refracts(const Bsdf& part) {
    const Vec3 up(0, 0, 1);
    return part.has_transmission() &&
           (part.relative_eta({}, up) != 1 || part.pdf({}, up, -up, Lobe::transmission) > 0);
  }
  double weight(const SurfacePoint& at) const { return weight_->eval_scalar(at); }

  TexturePtr weight_;
  BsdfPtr first_, second_;
};

}  // namespace

Plugin bsdf_blendbsdf() {
  Plugin plugin =
      make_plugin<Blend>("bsdf", "blendbsdf", "A blend of two nested bsdfs.",
                         {{"weight", ParamType::texture, 0.5,
                           "Share of the second bsdf; that of the first is 1 less it."}});
  plugin.schema.reciprocal = false;  // one of them may refract
  return plugin;
}

}  // namespace mlt
