// A matte surface: light is scattered equally to all directions above it (Lambert 1760,
// "Photometria"). f = reflectance / pi.
#include "base/registry.h"
#include "math/warp.h"
#include "scene/bsdf.h"
#include "scene/bsdf/lobes.h"
#include "scene/texture.h"

namespace mlt {
namespace {

class Diffuse final : public Bsdf {
 public:
  explicit Diffuse(Params& params) : reflectance_(texture_param(params, "reflectance")) {
    if (reflectance_->is_constant()) matte_ = Matte{reflectance_->mean() * inv_pi};
  }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (lobe != Lobe::smooth || !above(wl, wc)) return {};
    return {reflectance_->eval(at) * inv_pi, wc.z * inv_pi, wl.z * inv_pi};
  }

  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3& from,
                                   const Vec3& u) const override {
    const Vec3 to = sample_cosine_hemisphere(direction_part(u));
    if (!above(from, to)) return std::nullopt;
    return BsdfSample{to, Lobe::smooth};
  }

  std::optional<Vec3> invert(const SurfacePoint&, const Vec3& from, const Vec3& to,
                             Lobe lobe) const override {
    if (lobe != Lobe::smooth || !above(from, to)) return std::nullopt;
    return u_of(0.5, invert_cosine_hemisphere(to));
  }

  Color albedo(const SurfacePoint& at) const override { return reflectance_->eval(at); }

 private:
  TexturePtr reflectance_;
};

}  // namespace

Plugin bsdf_diffuse() {
  return make_plugin<Diffuse>(
      "bsdf", "diffuse",
      "A matte surface that scatters light equally to all directions on its front side.",
      {{"reflectance", ParamType::texture, 0.5, "Fraction of the light that is scattered."}});
}

}  // namespace mlt
