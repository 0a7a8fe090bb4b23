// Layers of light: images of the light of some paths alone, those that begin at a lamp, or those of
// a class of paths.
#pragma once

#include "path/path.h"
#include "scene/scene.h"

#include <cstdint>
#include <optional>
#include <regex>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace mlt {

/// The layers that a render is asked for.
struct LightLayerSettings {
  bool groups = false;  ///< One for each lamp.
  /// Names, and regular expressions over path_class().
  std::vector<std::pair<std::string, std::string>> classes;
  bool exposures = false;  ///< One for each exposure of the shutter, in place of those of lamps.

  bool any() const { return groups || exposures || !classes.empty(); }
  /// The classes as the parameter light_layers names them.
  std::string text() const;
};

/// The letters of a path from the light to the eye (Heckbert 1990; Veach 1997, sec. 8.3): L, then
/// for each vertex between S where it scatters by a delta, M in a medium, else D; then E.
std::string path_class(const Path& path);

/// The regular expression of a class. Throws UsageError.
std::regex class_expression(const std::string& name, const std::string& expression);

/// A set of layers, as bits.
using LayerMask = uint64_t;

/// Calls use(layer) for each layer of the set.
template <class Use>
void for_each_layer(LayerMask layers, Use&& use) {
  for (; layers != 0; layers &= layers - 1) use(__builtin_ctzll(layers));
}

/// Throws RenderError if a set that was saved has other layers than the first `count`.
void check_layers(LayerMask layers, int count);

class LightLayers {
 public:
  static constexpr size_t most = 63;

  /// Throws UsageError for names that other layers have, and for more layers than `most`.
  LightLayers(const Scene& scene, const LightLayerSettings& settings);

  /// First those of lamps: "light." with the id of the emitter, else that of its shape, else
  /// "light.rest", where blanks become underscores; or those of exposures: "exposure.1".
  const std::vector<std::string>& names() const { return names_; }
  int count() const { return static_cast<int>(names_.size()); }
  /// The number of layers of lamps, or of exposures: they add up to the image.
  int group_count() const { return groups_; }

  /// Finds the layers of paths, and remembers those of each class.
  class Finder {
   public:
    /// nullptr: there are no layers.
    explicit Finder(const LightLayers* layers) : layers_(layers) {}
    int count() const { return layers_ ? layers_->count() : 0; }
    LayerMask of(const Path& path);
    bool tells_exposures() const { return layers_ && layers_->shutter_; }
    bool tells_lamps() const { return layers_ && !layers_->of_emitter_.empty(); }
    bool tells_classes() const { return layers_ && !layers_->classes_.empty(); }
    /// The layers of any path from this emitter, seen in this exposure, if there are no classes.
    LayerMask of(uint32_t emitter, int exposure) const {
      return tells_exposures() ? LayerMask{1} << exposure : layers_->of_emitter_[emitter];
    }

   private:
    const LightLayers* layers_;
    std::unordered_map<std::string, LayerMask> known_;
  };

 private:
  void add_groups(const Scene& scene);
  void add_exposures(const Shutter& shutter);
  LayerMask group_of(const Path& path) const;
  void add(const std::string& name);
  LayerMask layers_of_class(const std::string& letters) const;

  std::vector<std::string> names_;
  int groups_ = 0;
  std::vector<LayerMask> of_emitter_;  ///< By index of the emitter; empty without groups.
  std::optional<Shutter> shutter_;     ///< If there are layers of exposures.
  std::vector<std::regex> classes_;
};

}  // namespace mlt
