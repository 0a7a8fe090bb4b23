// Normals from an image of heights h, as if the surface were moved along its normal by h (Blinn
// 1978, "Simulation of wrinkled surfaces"): N is (-dh/ds, -dh/dt, 1), with lengths s and t along
// the surface.
#include "base/registry.h"
#include "scene/bsdf/bent_normal.h"
#include "scene/nested.h"
#include "scene/shape/shape_reader.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

class BumpMap final : public BentNormal, public ShapeReader {
 public:
  explicit BumpMap(Params& params)
      : BentNormal(params),
        height_(only_nested<Texture>(params, "texture")),
        scale_(params.real("scale")) {}

 private:
  Vec3 normal(const SurfacePoint& at) const override {
    const Vec2 by_uv = scale_ * height_->gradient(at);
    const Frame& frame = at.shading;
    const Shape::UvTangents d = uv_tangents(at);
    const Vec2 du(dot(d.du, frame.s), dot(d.du, frame.t)),
        dv(dot(d.dv, frame.s), dot(d.dv, frame.t));
    const double det = du.x * dv.y - du.y * dv.x;
    const Vec2 slope = Vec2(by_uv.x * dv.y - by_uv.y * du.y, by_uv.y * du.x - by_uv.x * dv.x) / det;
    const Vec3 n(-slope.x, -slope.y, 1);
    const double l2 = length_squared(n);
    return std::isfinite(l2) ? n / std::sqrt(l2) : Vec3(0, 0, 1);
  }

  TexturePtr height_;
  double scale_;
};

}  // namespace

Plugin bsdf_bumpmap() {
  return make_plugin<BumpMap>(bent_normal_schema(
      "bumpmap",
      "Bends the normals of the nested bsdf by an image of heights: the one nested texture.",
      {{"scale", ParamType::real, 1.0,
        "Multiplies the heights, which are lengths in the scene."}}));
}

}  // namespace mlt
