// Normals from an image, whose colours are (N + 1) / 2 with N in the shading frame: x along dp/du.
#include "base/registry.h"
#include "scene/bsdf/bent_normal.h"
#include "scene/nested.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

class NormalMap final : public BentNormal {
 public:
  explicit NormalMap(Params& params)
      : BentNormal(params),
        map_(params.has("normalmap") ? texture_param(params, "normalmap")
                                     : only_nested<Texture>(params, "texture")) {}

 private:
  Vec3 normal(const SurfacePoint& at) const override {
    const Vec3 n = 2.0 * map_->eval_rgb(at) - Vec3(1);
    const double l2 = length_squared(n);
    return l2 > 1e-12 ? n / std::sqrt(l2) : Vec3(0, 0, 1);
  }

  TexturePtr map_;
};

}  // namespace

Plugin bsdf_normalmap() {
  return make_plugin<NormalMap>(bent_normal_schema(
      "normalmap", "Bends the normals of the nested bsdf by an image of normals.",
      {{"normalmap", ParamType::texture, no_default,
        "The image: (N + 1) / 2, with x along u. Give it raw = true. A nested texture of any other "
        "name will do."}}));
}

}  // namespace mlt
