// Light paths to start chains from, drawn by bidirectional path tracing. One candidate is one
// sample of it: several paths, each with the weight L*(x) mis(x) / p(x).
#pragma once

#include "markov/bootstrap.h"
#include "mutation/path_target.h"
#include "path/bidirectional_sampler.h"
#include "path/samplers.h"

namespace mlt {

class PathSeeds {
 public:
  explicit PathSeeds(const PathTarget& target) : PathSeeds(target, settings(target)) {}
  PathSeeds(const PathTarget& target, const BidirectionalSettings& settings)
      : target_(&target), paths_(target.scene(), settings) {}

  /// With the balance heuristic f / P is the weighted f / p of a path, without roulette.
  static BidirectionalSettings settings(const PathTarget& target) {
    BidirectionalSettings settings;
    settings.heuristic = Heuristic::balance;
    settings.rules = target.rules();
    settings.manifolds = target.manifolds();
    return settings;
  }

  /// Sum of the weights of a candidate's paths.
  double weigh(Rng& rng) {
    double sum = 0;
    draw(RandomSampler(rng), [&](const Connection&, double weight) { sum += weight; });
    return sum;
  }

  /// Chooses one of a candidate's paths in proportion to its weight.
  PathState pick(Rng rng, Rng choice) {
    PathState x;
    double sum = 0;
    draw(RandomSampler(rng), [&](const Connection& connection, double weight) {
      sum += weight;
      if (choice.next() * sum < weight) paths_.assemble(connection, x.path);
    });
    if (!x.path.vertices.empty()) target_->evaluate(x);
    return x;
  }

  /// Calls found(connection, weight) for each path of a candidate that carries light, whether or
  /// not it is a part of the target.
  template <class Sampler, class Found>
  void draw(Sampler sampler, Found&& found) {
    draw(position(sampler), sampler, found);
  }
  /// As above, at a raster position.
  template <class Sampler, class Found>
  void draw(const Vec2& raster, Sampler& sampler, Found&& found) {
    paths_.sample(raster, sampler, rays_);
    paths_.connect_all(rays_, [&](const Connection& c) {
      if (!(target_luminance(c.contribution) * c.weight > 0)) return;
      double weight = target_->of(c.contribution, c.raster, c.certainty) * c.weight;
      if (target_->has_path_factor() && weight > 0) weight *= path_factor(c);
      if (std::isfinite(weight)) found(c, weight);
    });
  }

  /// Calls found(connection) for each path of a candidate, also for paths without a weight.
  template <class Sampler, class Found>
  void draw_all(Sampler sampler, Found&& found) {
    paths_.sample(position(sampler), sampler, rays_);
    paths_.connect_all(rays_, found);
  }

  /// Assembles and evaluates the path of a connection that was just found.
  void assemble(const Connection& connection, PathState& x) const {
    paths_.assemble(connection, x.path);
    target_->evaluate(x);
  }

  /// Rays traced so far.
  const RayCounts& rays() const { return rays_; }
  /// Rays traced since the last call; resets rays().
  RayCounts take_rays() { return std::exchange(rays_, {}); }

 private:
  template <class Sampler>
  Vec2 position(Sampler& sampler) const {
    return target_->scene().camera().raster().sample(sampler.next2());
  }
  /// T with the factor that depends on the path over T without.
  double path_factor(const Connection& connection) {
    PathState& x = assembled_;
    assemble(connection, x);
    const double without = target_->of(x.rgb, x.raster, certainty(x.terms));
    return without > 0 ? x.target / without : 0;
  }

  const PathTarget* target_;
  BidirectionalSampler paths_;
  RayCounts rays_;
  PathState assembled_;
};

struct PathStarts {
  double b = 0, b_error = 0;     ///< See Bootstrap.
  std::vector<PathState> paths;  ///< One for each chain; none if no path with light was found.
};

/// Paths to start `chains` chains from without start-up bias. Random streams of the candidates
/// beyond candidates.count + chains are free for the chains.
PathStarts bootstrap(const PathTarget& target, const Candidates& candidates, uint32_t chains,
                     int threads, const std::atomic<bool>& cancelled);

}  // namespace mlt
