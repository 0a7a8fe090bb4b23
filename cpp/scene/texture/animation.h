// A colour that changes over time: it has keys, and is linear between them, channel by channel.
// Before the first key and after the last one it is constant.
#pragma once

#include "scene/texture/texture.h"

#include <vector>

namespace mlt {

/// What an animated texture is at one time. It is no texture by itself.
class ColorKey final : public Object {
 public:
  explicit ColorKey(Params& params);

  double time() const { return time_; }
  const TexturePtr& texture() const { return texture_; }
  /// What it is where it emits light.
  const TexturePtr& light() const { return light_; }
  /// Whether it is one colour, and no texture.
  bool is_color() const { return is_color_; }

 private:
  double time_;
  TexturePtr texture_;
  bool is_color_;
  TexturePtr light_;
};

class AnimatedTexture final : public Texture {
 public:
  explicit AnimatedTexture(Params& params);

  Spectrum eval(const SurfacePoint& at) const override;
  void prefetch(const SurfacePoint& at) const override;
  Vec2 gradient(const SurfacePoint& at) const override;
  Vec2i resolution() const override { return values_.front()->resolution(); }
  /// Whether nothing changes while the shutter is open.
  bool is_constant() const override;
  TexturePtr own_light() const override;
  /// The mean from when the shutter opens first until it closes last.
  Color mean() const override;
  Color maximum() const override;

  /// The texture as this shutter sees it.
  std::shared_ptr<AnimatedTexture> during(const Shutter& shutter) const;
  /// Whether all keys are colours, and the largest component of those that are.
  bool has_colors_alone() const;
  double largest_color() const;

 private:
  /// A place between two keys: the next key counts for `share`, this one for the rest.
  struct Place {
    size_t key;
    double share;
  };
  double time(size_t key) const { return keys_[key]->time(); }
  Place place_of(double time) const;
  void find_shares();

  std::vector<std::shared_ptr<const ColorKey>> keys_;
  std::vector<TexturePtr> values_;  ///< At the keys.
  Shutter shutter_;
  std::vector<double> shares_;  ///< How much each key counts in the mean.
};

/// The light of the animation that is given for a parameter of type lamp, or nullptr if a colour
/// is given. Throws SceneError if its keys are no colours.
TexturePtr lamp_animation(Params& params, const std::string& name);

}  // namespace mlt
