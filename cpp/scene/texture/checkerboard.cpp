// Two colours in the four quarters of the uv square, repeated in both directions.
#include "base/registry.h"
#include "scene/texture/texture.h"
#include "scene/texture/uv_transform.h"

namespace mlt {
namespace {

class Checkerboard final : public Texture {
 public:
  explicit Checkerboard(Params& params)
      : color0_(unbounded_texture_param(params, "color0")),
        color1_(unbounded_texture_param(params, "color1")),
        to_uv_(params) {}

  Spectrum eval(const SurfacePoint& at) const override {
    const Vec2 uv = to_uv_(at.uv);
    return upper_half(uv.x) == upper_half(uv.y) ? color0_->eval(at) : color1_->eval(at);
  }
  TexturePtr own_light() const override {
    auto board = std::make_shared<Checkerboard>(*this);
    board->color0_ = as_light(color0_);
    board->color1_ = as_light(color1_);
    return board;
  }
  Color mean() const override { return 0.5 * (color0_->mean() + color1_->mean()); }
  Color maximum() const override { return glm::max(color0_->maximum(), color1_->maximum()); }

 private:
  static bool upper_half(double x) { return x - std::floor(x) > 0.5; }

  TexturePtr color0_, color1_;
  UvTransform to_uv_;
};

}  // namespace

Plugin texture_checkerboard() {
  return make_plugin<Checkerboard>(
      "texture", "checkerboard", "A board of two colours, 2 x 2 fields in the uv square.",
      concat({{{"color0", ParamType::texture, 0.4,
                "Colour of the quarters at the lower left, upper right."},
               {"color1", ParamType::texture, 0.2, "Colour of the other two quarters."}},
              uv_parameters()}));
}

}  // namespace mlt
