// A Lambertian surface: light is scattered equally to all directions above it (Lambert 1760,
// "Photometria"). f = reflectance / pi.
#include "base/registry.h"
#include "scene/bsdf/cosine_sampled.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

class Diffuse final : public CosineSampled {
 public:
  explicit Diffuse(Params& params) : reflectance_(texture_param(params, "reflectance")) {
    lambertian_.lambertian = {Spectrum(reflectance_->mean() * inv_pi), Lambertian::Sides::front};
    lambertian_.reflectance = reflectance_.get();
    lambertian_.textured = !reflectance_->is_constant();
  }

  Spectrum albedo(const SurfacePoint& at) const override { return reflectance_->eval(at); }

 private:
  Spectrum value(const SurfacePoint& at, const Vec3&, const Vec3&) const override {
    return reflectance_->eval(at) * inv_pi;
  }

  TexturePtr reflectance_;
};

}  // namespace

Plugin bsdf_diffuse() {
  return make_plugin<Diffuse>(
      "bsdf", "diffuse",
      "A Lambertian surface that scatters light equally to all directions on its front side.",
      {{"reflectance", ParamType::texture, 0.5, "Fraction of the light that is scattered."}});
}

}  // namespace mlt
