// A mixture of two textures by a third one, channel by channel, as in pbrt-v4 (Pharr, Jakob &
// Humphreys 2023, sec. 10.3.1).
#include "base/registry.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

template <class Value>
Value between(const Value& first, const Value& second, const Value& amount) {
  return max(first + amount * (second - first), Value(0));
}

class Mix final : public Texture {
 public:
  explicit Mix(Params& params)
      : first_(unbounded_texture_param(params, "first")),
        second_(unbounded_texture_param(params, "second")),
        amount_(unbounded_texture_param(params, "amount")) {}

  Spectrum eval(const SurfacePoint& at) const override {
    return between(first_->eval(at), second_->eval(at), amount_->eval(at));
  }
  void prefetch(const SurfacePoint& at) const override {
    for (const TexturePtr& texture : {first_, second_, amount_}) texture->prefetch(at);
  }
  /// By the product rule, exact for greys.
  Vec2 gradient(const SurfacePoint& at) const override {
    const auto height = [&](const TexturePtr& t) { return luminance(t->eval_rgb(at)); };
    const double amount = height(amount_);
    return (1 - amount) * first_->gradient(at) + amount * second_->gradient(at) +
           (height(second_) - height(first_)) * amount_->gradient(at);
  }
  bool is_constant() const override {
    return first_->is_constant() && second_->is_constant() && amount_->is_constant();
  }
  TexturePtr own_light() const override {
    auto light = std::make_shared<Mix>(*this);
    light->first_ = as_light(first_);
    light->second_ = as_light(second_);
    return light;
  }
  /// Exact if the textures have nothing to do with each other.
  Color mean() const override { return between(first_->mean(), second_->mean(), amount_->mean()); }
  /// It is linear in the amount, of which the least is not known.
  Color maximum() const override {
    const Color first = first_->maximum(), amount = amount_->maximum();
    return glm::max(first,
                    glm::max(Color(1) - amount, Color(0)) * first + amount * second_->maximum());
  }

 private:
  TexturePtr first_, second_, amount_;
};

}  // namespace

Plugin texture_mix() {
  return make_plugin<Mix>(
      "texture", "mix", "A mixture of two textures: (1 - amount) first + amount second.",
      {{"first", ParamType::texture, 0.0, "What there is where the amount is 0."},
       {"second", ParamType::texture, 1.0, "What there is where the amount is 1."},
       {"amount", ParamType::texture, 0.5, "The share of the second one, also by channels."}});
}

}  // namespace mlt
