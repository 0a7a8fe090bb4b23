// L*(x), the target of Metropolis light transport: which paths of a scene count, and for how much.
#pragma once

#include "mutation/certain_light.h"
#include "mutation/path_state.h"
#include "mutation/target_map.h"
#include "path/path_rules.h"

#include <memory>
#include <optional>

namespace mlt {

class PathSeeds;

/// The techniques of independent samples: all of bidirectional path tracing, or those two of them
/// that path tracing has.
enum class SampleTechniques : uint8_t { all, path_tracing };

class PathTarget {
 public:
  /// Smooth vertices below the roughness `near_specular` count as specular in signatures.
  explicit PathTarget(ScenePtr scene, const PathRules& rules = {}, double near_specular = 0.1)
      : scene_(std::move(scene)), rules_(rules), near_specular_(near_specular) {}

  const Scene& scene() const { return *scene_; }
  const ScenePtr& scene_ptr() const { return scene_; }
  const PathRules& rules() const { return rules_; }
  double near_specular() const { return near_specular_; }
  /// Two-stage sampling: a factor of the target; nullptr without.
  const TargetMap* map() const { return map_ ? &*map_ : nullptr; }
  void set_map(TargetMap map) { map_ = std::move(map); }

  /// Which samples find the paths of chains, too.
  SampleTechniques techniques() const { return techniques_; }
  void set_techniques(SampleTechniques techniques) { techniques_ = techniques; }

  /// Paths that are left to the samples; nullptr if there are none.
  const CertainLight* certain_light() const { return certain_light_ ? &*certain_light_ : nullptr; }
  void leave_to_samples(CertainLight light) { certain_light_ = std::move(light); }
  /// Paths of a greater `certainty` have no target at this raster position.
  double most_certain(const Vec2& raster) const {
    return certain_light_ ? certain_light_->most_certain(raster) : CertainLight::no_bound;
  }

  /// The factor of two-stage sampling.
  double factor(const Vec2& raster) const { return map_ ? (*map_)(raster) : 1.0; }
  /// The target of light of this color, f or f / p, at a raster position, by a path of this
  /// certainty.
  double of(const Color& color, const Vec2& raster, double certainty) const {
    return certainty > most_certain(raster) ? 0 : target_luminance(color) * factor(raster);
  }
  /// T(x) / P(x), where P is the density of the techniques together (see FamilyWeights).
  double over_density(const PathState& x) const {
    return x.known.over_density.get([&] {
      return techniques_ == SampleTechniques::all
                 ? over_bidirectional_density(x)
                 : x.target / path_tracing_density(ContributionMeasure{x.terms});
    });
  }
  /// The same for all techniques of bidirectional path tracing.
  double over_bidirectional_density(const PathState& x) const {
    return x.known.over_bidirectional_density.get(
        [&] { return x.target / total_density(ContributionMeasure{x.terms}); });
  }
  /// Computes what depends on vertices first ... last and their neighbours, then f and L*. Without
  /// visibility. target = 0 if the path carries no light, misses the image or breaks the rules.
  void evaluate(int first, int last, PathState& x) const;
  /// The same for a path of which nothing has been computed yet.
  void evaluate(PathState& x) const;

  /// Heckbert's notation, by near_specular.
  std::string signature(const Path& path) const {
    return mlt::signature(*scene_, path, near_specular_);
  }

  /// Paths to start chains from; the target must outlive them.
  PathSeeds seeds() const;

 private:
  TermSettings term_settings() const { return {true, rules_.strict_normals, near_specular_}; }
  void evaluate_target(PathState& x) const;

  ScenePtr scene_;
  PathRules rules_;
  double near_specular_;
  std::optional<TargetMap> map_;
  std::optional<CertainLight> certain_light_;
  SampleTechniques techniques_ = SampleTechniques::all;
};

}  // namespace mlt
