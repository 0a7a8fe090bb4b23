// Makes an opaque one-sided material visible from both sides. Seen from the back, the local z axis
// is mirrored, so that the nested material always finds itself on its front.
#include "base/registry.h"
#include "scene/bsdf/bsdf.h"

namespace mlt {
namespace {

class TwoSided final : public Bsdf {
 public:
  explicit TwoSided(Params& params) {
    const auto nested = params.objects<Bsdf>("bsdf");
    if (nested.empty() || nested.size() > 2)
      params.fail("needs one nested bsdf, or two (front and back), but has " +
                  std::to_string(nested.size()));
    for (const auto& bsdf : nested)
      if (bsdf->has_transmission())
        params.fail("cannot hold a bsdf that transmits light: it is two-sided already");
    front_ = nested.front();
    back_ = nested.back();
    supports_lanes_ = front_ == back_ && front_->supports_lanes();
    if (front_ == back_ && front_->lambertian().known()) {
      lambertian_ = front_->lambertian();
      lambertian_.lambertian.sides = Lambertian::Sides::both;
    }
  }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (!same_side(wl, wc)) return {};
    return nested(wl).scattering(at, to_front(wl), to_front(wc), lobe);
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    auto sampled = nested(from).sample(at, to_front(from), u);
    if (sampled && from.z < 0) sampled->to.z = -sampled->to.z;
    return sampled;
  }

  void scatter(ScatteringLanes& x) const override {
    Block<float> side;
    for (int i = 0; i < x.count; ++i) {
      side[i] = std::copysign(1.0f, x.wc.z[i]);
      x.wc.z[i] *= side[i];
      x.wl.z[i] *= side[i];
    }
    front_->scatter(x);
    for (int i = 0; i < x.count; ++i) x.to.z[i] *= side[i];
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (!same_side(from, to)) return std::nullopt;
    return nested(from).invert(at, to_front(from), to_front(to), lobe, v);
  }

  bool has_smooth() const override { return front_->has_smooth() || back_->has_smooth(); }
  bool has_delta() const override { return front_->has_delta() || back_->has_delta(); }

  Vec3 delta_normal(const SurfacePoint& at, const Vec3& w) const override {
    const Vec3 n = nested(w).delta_normal(at, to_front(w));
    return w.z < 0 ? Vec3(n.x, n.y, -n.z) : n;
  }
  bool bends_normal() const override { return front_->bends_normal() || back_->bends_normal(); }

  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    return nested(wl).roughness(at, to_front(wl), to_front(wc));
  }

  double least_roughness() const override {
    return std::min(front_->least_roughness(), back_->least_roughness());
  }

  Spectrum albedo(const SurfacePoint& at) const override {
    return 0.5 * (front_->albedo(at) + back_->albedo(at));
  }

 private:
  const Bsdf& nested(const Vec3& w) const { return w.z < 0 ? *back_ : *front_; }
  static Vec3 to_front(const Vec3& w) { return {w.x, w.y, std::abs(w.z)}; }

  BsdfPtr front_, back_;
};

}  // namespace

Plugin bsdf_twosided() {
  return make_plugin<TwoSided>(
      "bsdf", "twosided",
      "Shows one nested opaque bsdf on both sides of a surface, or a first one on the front and "
      "a second one on the back.");
}

}  // namespace mlt
