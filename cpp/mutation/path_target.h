// The target of Metropolis light transport: its value for each path of a scene.
//
//   T(x) = L*(x) m(x),   T'(x) = T(x) w2(x)
//
// m is the factor of two-stage sampling, and w2 the share of T that is left to chains where there
// are independent samples beside them (ClampingWeights). Chains have the target T'.
// A factor that depends on the whole path makes another target of T.
#pragma once

#include "markov/clamping_weights.h"
#include "mutation/certain_light.h"
#include "mutation/path_state.h"
#include "mutation/target_map.h"
#include "path/manifold_sampler.h"
#include "path/path_rules.h"

#include <functional>
#include <memory>
#include <optional>

namespace mlt {

class PathSeeds;

/// The techniques of independent samples: all of bidirectional path tracing, or the two of path
/// tracing.
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
  /// The map of two-stage sampling, a factor of the target; nullptr without.
  const TargetMap* map() const { return map_ ? &*map_ : nullptr; }
  void set_map(TargetMap map) { map_ = std::move(map); }

  /// A factor of the target, for a path whose T is known without it. Threads share the function.
  using PathFactor = std::function<double(const PathState&)>;
  void set_path_factor(PathFactor factor) { path_factor_ = std::move(factor); }
  bool has_path_factor() const { return path_factor_ != nullptr; }

  /// The techniques of the independent samples, which find the paths of chains too.
  SampleTechniques techniques() const { return techniques_; }
  void set_techniques(SampleTechniques techniques) { techniques_ = techniques; }

  /// What the samples of bidirectional path tracing know of chains that join lights; nullptr if
  /// they do not join any.
  const std::shared_ptr<const ManifoldGuide>& manifolds() const { return manifolds_; }
  void set_manifolds(std::shared_ptr<const ManifoldGuide> guide) {
    manifolds_ = std::move(guide);
    if (manifolds_) manifold_ = std::make_shared<ManifoldSampler>(*scene_, manifolds_);
  }

  /// The light that is left to the samples; nullptr if there is none.
  const CertainLight* certain_light() const { return certain_light_ ? &*certain_light_ : nullptr; }
  void leave_to_samples(CertainLight light) { certain_light_ = std::move(light); }
  /// The certainty above which paths have no target at this raster position.
  double most_certain(const Vec2& raster) const {
    return certain_light_ ? certain_light_->most_certain(raster) : CertainLight::no_bound;
  }

  /// The factor of two-stage sampling.
  double factor(const Vec2& raster, double certainty) const {
    return map_ ? (*map_)(raster, certainty) : 1.0;
  }
  /// The weights of samples and chains; without any samples, T' is T.
  const ClampingWeights& weights() const { return weights_; }
  void set_weights(const ClampingWeights& weights) { weights_ = weights; }

  /// T for light of this color, f or f / p, at a raster position, by a path of this certainty.
  double of(const Color& color, const Vec2& raster, double certainty) const {
    return certainty > most_certain(raster) ? 0
                                            : target_luminance(color) * factor(raster, certainty);
  }
  /// tau(x) = T(x) / P(x), where P is the density of the samples of the image.
  double over_density(const PathState& x) const {
    return x.known.over_density.get([&] { return x.target / density(x); });
  }
  /// T'(x) / S(x), where S is the density of all techniques of bidirectional path tracing, from
  /// whose samples tours start.
  double over_starts(const PathState& x) const {
    return x.known.over_starts.get([&] { return x.target / bidirectional_density(x); });
  }
  /// The density of samples of path tracing, over |f(x)|.
  double path_tracing_density(const PathState& x) const {
    return mlt::path_tracing_density(ContributionMeasure{x.terms}, refracted_technique(x));
  }
  /// Computes the terms that depend on vertices first ... last and their neighbours, then f and L*,
  /// without visibility. target = 0 if the path has no light, misses the image or breaks the rules.
  void evaluate(int first, int last, PathState& x) const;
  /// Computes all terms of a path, then f and L*, as above.
  void evaluate(PathState& x) const;

  /// The path in Heckbert's notation, by near_specular.
  std::string signature(const Path& path) const {
    return mlt::signature(*scene_, path, near_specular_);
  }

  /// Paths to start chains from; the target must outlive them.
  PathSeeds seeds() const;

 private:
  TermSettings term_settings() const { return {true, rules_.strict_normals, near_specular_}; }
  void evaluate_target(PathState& x) const;
  // Over |f(x)|:
  double density(const PathState& x) const {
    return techniques_ == SampleTechniques::all ? bidirectional_density(x)
                                                : path_tracing_density(x);
  }
  double bidirectional_density(const PathState& x) const {
    return total_density(ContributionMeasure{x.terms}, extra_technique(x));
  }
  /// The technique beside those of can_sample, of which a path has one at most.
  ExtraTechnique extra_technique(const PathState& x) const;
  ExtraTechnique refracted_technique(const PathState& x) const;

  ScenePtr scene_;
  PathRules rules_;
  double near_specular_;
  std::optional<TargetMap> map_;
  PathFactor path_factor_;
  std::optional<CertainLight> certain_light_;
  std::shared_ptr<const ManifoldGuide> manifolds_;
  std::shared_ptr<const ManifoldSampler> manifold_;
  SampleTechniques techniques_ = SampleTechniques::all;
  ClampingWeights weights_;
};

}  // namespace mlt
