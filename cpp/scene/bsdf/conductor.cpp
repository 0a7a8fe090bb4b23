// A perfectly smooth metal: a mirror whose reflectance follows Fresnel's equations for a complex
// index of refraction.
#include "base/registry.h"
#include "math/fresnel.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/ior_params.h"
#include "scene/bsdf/lobes.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

class Conductor final : public Bsdf {
 public:
  explicit Conductor(Params& params)
      : ior_(conductor_param(params)),
        reflectance_(texture_param(params, "specular_reflectance")) {}

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (lobe != Lobe::reflection || !above(wl, wc)) return {};
    return {reflectance_->eval(at) * ior_.fresnel(std::min(wl.z, 1.0), at.wavelength), 1, 1};
  }

  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3& from,
                                   const Vec3&) const override {
    if (from.z <= 0) return std::nullopt;
    return BsdfSample{reflect(from), Lobe::reflection};
  }

  std::optional<Vec3> invert(const SurfacePoint&, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (lobe != Lobe::reflection || !above(from, to)) return std::nullopt;
    return v;
  }

  bool has_smooth() const override { return false; }
  bool has_delta() const override { return true; }
  double roughness(const SurfacePoint&, const Vec3&, const Vec3&) const override { return 0; }

  Spectrum albedo(const SurfacePoint& at) const override {
    return reflectance_->eval(at) * ior_.fresnel(1, at.wavelength);
  }

 private:
  ConductorIor ior_;
  TexturePtr reflectance_;
};

}  // namespace

Plugin bsdf_conductor() {
  return make_plugin<Conductor>("bsdf", "conductor",
                                "A smooth metal: a mirror with the colour of its material.",
                                conductor_parameters());
}

}  // namespace mlt
