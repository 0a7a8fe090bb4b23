// A Lambertian transmitter (Mitsuba 0.6): light is scattered equally to all directions on the other
// side, as by the thin leaf of a plant. f = transmittance / pi.
#include "base/registry.h"
#include "math/warp.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/lobes.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

class DiffuseTransmitter final : public Bsdf {
 public:
  explicit DiffuseTransmitter(Params& params)
      : transmittance_(texture_param(params, "transmittance")) {}

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (lobe != Lobe::smooth || !opposite(wl, wc)) return {};
    return {transmittance_->eval(at) * inv_pi, std::abs(wc.z) * inv_pi, std::abs(wl.z) * inv_pi};
  }
  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3& from,
                                   const Vec3& u) const override {
    const Vec3 up = sample_cosine_hemisphere(direction_part(u)), to = from.z > 0 ? -up : up;
    if (!opposite(from, to)) return std::nullopt;
    return BsdfSample{to, Lobe::smooth};
  }
  std::optional<Vec3> invert(const SurfacePoint&, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (lobe != Lobe::smooth || !opposite(from, to)) return std::nullopt;
    return u_of(v.x, invert_cosine_hemisphere(upwards(to)));
  }

  bool has_transmission() const override { return true; }
  Spectrum albedo(const SurfacePoint& at) const override { return transmittance_->eval(at); }

 private:
  static bool opposite(const Vec3& a, const Vec3& b) { return a.z * b.z < 0; }

  TexturePtr transmittance_;
};

}  // namespace

Plugin bsdf_difftrans() {
  return make_plugin<DiffuseTransmitter>(
      "bsdf", "difftrans",
      "A Lambertian transmitter: light is scattered equally to all directions on the other side.",
      {{"transmittance", ParamType::texture, 0.5, "Fraction of the light that is scattered."}});
}

}  // namespace mlt
