// A texture of numbers, such as a roughness, for one point or for eight side by side.
#pragma once

#include "math/number.h"
#include "scene/texture/texture.h"

namespace mlt {

class ScalarTexture {
 public:
  explicit ScalarTexture(TexturePtr texture)
      : texture_(std::move(texture)), mean_(mean(texture_->mean())) {
    if (texture_->is_constant()) texture_ = nullptr;
  }

  bool is_constant() const { return !texture_; }
  double mean() const { return mean_; }
  /// Whether it is 0 everywhere.
  bool vanishes() const { return is_constant() && mean_ == 0; }
  /// The values at as many points as F has lanes.
  template <class F>
  F eval(const SurfacePoint* const* at) const {
    if (is_constant()) return number<F>(mean_);
    return for_each_lane<F>([&](int i) { return texture_->eval_scalar(*at[i]); });
  }
  double eval(const SurfacePoint& at) const {
    return is_constant() ? mean_ : texture_->eval_scalar(at);
  }

 private:
  /// Exact for greys.
  static double mean(const Color& c) { return c == Color(c.x) ? c.x : mlt::mean(c); }

  TexturePtr texture_;  ///< Null if the value is the same everywhere.
  double mean_;
};

/// The texture parameter `name`, as numbers.
inline ScalarTexture scalar_param(Params& params, const std::string& name) {
  return ScalarTexture(texture_param(params, name));
}

}  // namespace mlt
