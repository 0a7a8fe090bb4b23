#include "scene/texture/animation.h"

#include "base/registry.h"

#include <algorithm>

namespace mlt {

ColorKey::ColorKey(Params& params)
    : time_(params.real("time")),
      texture_(unbounded_texture_param(params, "value")),
      is_color_(!std::holds_alternative<ObjectPtr>(params.value("value")) ||
                texture_->spectrum(SpectrumUse::unbounded)),
      light_(is_color_ ? constant_texture(to_spectral(params, "value", SpectrumUse::emission))
                       : as_light(texture_)) {}

AnimatedTexture::AnimatedTexture(Params& params) {
  for (const auto& key : params.objects<ColorKey>("texture")) keys_.push_back(key);
  if (keys_.size() < 2)
    params.fail(fmt::format("has {} key{}, but needs two or more", keys_.size(),
                            keys_.size() == 1 ? "" : "s"));
  for (size_t i = 1; i < keys_.size(); ++i)
    if (!(time(i) > time(i - 1)))
      params.fail(fmt::format("has a key at time {:g} after one at time {:g}; times must increase",
                              time(i), time(i - 1)));
  for (const auto& key : keys_) values_.push_back(key->texture());
  shutter_.open = keys_.front()->time();
  shutter_.close = keys_.back()->time();
  find_shares();
}

std::shared_ptr<AnimatedTexture> AnimatedTexture::during(const Shutter& shutter) const {
  auto seen = std::make_shared<AnimatedTexture>(*this);
  seen->shutter_ = shutter;
  seen->find_shares();
  return seen;
}

/// Where the shutter opens for one instant alone, points may have any time.
AnimatedTexture::Place AnimatedTexture::place_of(double time) const {
  if (!shutter_.opens()) time = shutter_.open;
  size_t next = 0;
  while (next < keys_.size() && this->time(next) <= time) ++next;
  if (next == 0) return {0, 0};
  if (next == keys_.size()) return {next - 1, 0};
  const double before = this->time(next - 1);
  return {next - 1, (time - before) / (this->time(next) - before)};
}

/// The trapezoidal rule, which is exact between one key and the next.
void AnimatedTexture::find_shares() {
  shares_.assign(keys_.size(), 0);
  const auto add = [&](double time, double weight) {
    const auto [key, share] = place_of(time);
    shares_[key] += weight * (1 - share);
    if (share > 0) shares_[key + 1] += weight * share;
  };
  if (!shutter_.opens()) return add(shutter_.open, 1);
  double from = shutter_.open;
  const auto add_up_to = [&](double to) {
    const double weight = 0.5 * (to - from) / (shutter_.close - shutter_.open);
    add(from, weight);
    add(to, weight);
    from = to;
  };
  for (const auto& key : keys_)
    if (key->time() > shutter_.open && key->time() < shutter_.close) add_up_to(key->time());
  add_up_to(shutter_.close);
}

Spectrum AnimatedTexture::eval(const SurfacePoint& at) const {
  const auto [key, share] = place_of(at.time);
  if (share == 0) return values_[key]->eval(at);
  return (1 - share) * values_[key]->eval(at) + share * values_[key + 1]->eval(at);
}

void AnimatedTexture::prefetch(const SurfacePoint& at) const {
  const auto [key, share] = place_of(at.time);
  values_[key]->prefetch(at);
  if (share > 0) values_[key + 1]->prefetch(at);
}

Vec2 AnimatedTexture::gradient(const SurfacePoint& at) const {
  const auto [key, share] = place_of(at.time);
  if (share == 0) return values_[key]->gradient(at);
  return (1 - share) * values_[key]->gradient(at) + share * values_[key + 1]->gradient(at);
}

bool AnimatedTexture::is_constant() const {
  return !shutter_.opens() && std::all_of(values_.begin(), values_.end(),
                                          [](const auto& value) { return value->is_constant(); });
}

TexturePtr AnimatedTexture::own_light() const {
  auto light = std::make_shared<AnimatedTexture>(*this);
  for (size_t i = 0; i < keys_.size(); ++i) light->values_[i] = keys_[i]->light();
  return light;
}

Color AnimatedTexture::mean() const {
  Color sum(0);
  for (size_t i = 0; i < keys_.size(); ++i)
    if (shares_[i] > 0) sum += shares_[i] * values_[i]->mean();
  return sum;
}

Color AnimatedTexture::maximum() const {
  Color most(0);
  for (size_t i = 0; i < keys_.size(); ++i)
    if (shares_[i] > 0) most = glm::max(most, values_[i]->maximum());
  return most;
}

bool AnimatedTexture::has_colors_alone() const {
  return std::all_of(keys_.begin(), keys_.end(), [](const auto& key) { return key->is_color(); });
}

double AnimatedTexture::largest_color() const {
  double most = 0;
  for (const auto& key : keys_)
    if (key->is_color()) most = std::max(most, max_component(key->texture()->mean()));
  return most;
}

TexturePtr lamp_animation(Params& params, const std::string& name) {
  const ObjectPtr* object = std::get_if<ObjectPtr>(&params.value(name));
  const auto* animation = object ? dynamic_cast<const AnimatedTexture*>(object->get()) : nullptr;
  if (!animation) return nullptr;
  if (!animation->has_colors_alone()) params.fail(name, "should have no textures at its keys");
  return texture_param(params, name);
}

Plugin texture_animation() {
  Plugin plugin = make_plugin<AnimatedTexture>(
      "texture", "animation", "Nested keys, which are textures or colours at times.", {});
  plugin.schema.unnamed_texture = true;
  return plugin;
}

Plugin texture_key() {
  return make_plugin<ColorKey>(
      "texture", "key", "A texture or a colour at one time, nested in an animation.",
      {{"time", ParamType::real, no_default, "The time, as that of the shutter."},
       {"value", ParamType::texture, no_default, "What there is at this time."}});
}

}  // namespace mlt
