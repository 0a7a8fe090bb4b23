// Multiplexed Metropolis light transport (Hachisuka, Kaplanyan & Dachsbacher 2014): the technique
// (s, t) is a part of the state, and the numbers make one path by it. The target is L* of the path's
// f / p, weighted among the techniques, so that a path is visited as often as its L* says, whichever
// technique makes it.
//
// In that paper each chain keeps the length of its paths, and there are as many chains for a length
// as its light needs. Here a large step may change the length, so that one chain sees them all.
#pragma once

#include "markov/step.h"
#include "path/path_terms.h"
#include "primary/primary_numbers.h"
#include "primary/technique_choice.h"

#include <array>

namespace mlt {

struct MultiplexedState {
  PrimaryNumbers numbers;
  Technique technique;
  Vec2 raster{0};
  Color rgb{0};                    ///< f / p, weighted among techniques.
  double target = 0;               ///< L* of it.
  double target_over_density = 0;  ///< See FamilyWeights.

  void clear() {
    rgb = Color(0);
    target = target_over_density = 0;
  }
  void show(const Connection& c) {
    raster = c.raster;
    rgb = c.contribution * c.weight;
    target = min_component(rgb) >= 0 ? target_luminance(rgb) : std::nan("");
    target_over_density = target_luminance(c.contribution) * c.own_share;
  }
};

/// Makes the path that the numbers stand for.
struct MultiplexedPaths {
  const Scene* scene;
  BidirectionalSampler paths;  ///< Without Russian roulette: the technique says where walks end.
  SmallStep small_step;
  RayCounts rays = {};

  void operator()(MultiplexedState& state, Rng& rng) {
    make(state, rng, [](const Connection&) {});
  }
  /// The path as well.
  void operator()(MultiplexedState& state, Rng& rng, Path& path) {
    make(state, rng, [&](const Connection& c) { paths.assemble(c, path); });
  }

 private:
  template <class Found>
  void make(MultiplexedState& state, Rng& rng, Found&& found) {
    PrimarySampler sampler(state.numbers, small_step, rng);
    state.clear();
    paths.sample_technique(state.technique, sampler, rays, [&](const Connection& c) {
      state.show(c);
      found(c);
    });
  }
};

/// How a chain changes the technique, beside large steps.
enum class TechniqueChange {
  keeps_numbers,  ///< They make another path, and move a little (Hachisuka et al. 2014).
  keeps_path      ///< Its numbers are found by inversion (Bitterli et al. 2018).
};

/// Large steps draw technique and numbers afresh, small steps move the numbers a little, and others
/// change the technique for the same length.
class MultiplexedStep {
 public:
  using State = MultiplexedState;
  enum Move { large = 0, small = 1, technique = 2 };

  MultiplexedStep(double large_probability, double technique_probability, TechniqueChange change,
                  MultiplexedPaths paths, const TechniqueChoice& choice)
      : large_probability_(large_probability),
        technique_probability_(technique_probability),
        change_(change),
        paths_(std::move(paths)),
        choice_(&choice) {}

  Transition propose(const State& x, std::array<State, 1>& proposals, size_t, Rng& rng) {
    State& y = proposals[0];
    last_ = choose_move(rng.next());
    if (last_ == technique && change_ == TechniqueChange::keeps_path) return keep_path(x, y, rng);
    y.technique = x.technique;
    if (last_ != small) {
      const int edges = last_ == large ? choice_->sample_length(rng.next()) : x.technique.edges();
      y.technique = choice_->sample_technique(edges, rng.next());
    }
    y.numbers = x.numbers;
    y.numbers.step(last_ == large);
    paths_(y, rng);
    if (!generated(y)) return impossible;
    return {density(y.technique) / y.target, density(x.technique) / x.target};
  }

  Move last() const { return last_; }
  static bool generated(const State& y) { return y.target != 0; }
  MultiplexedPaths& paths() { return paths_; }

 private:
  Transition keep_path(const State& x, State& y, Rng& rng);

  Move choose_move(double u) const {
    if (u < large_probability_) return large;
    return u < large_probability_ + technique_probability_ ? technique : small;
  }
  /// With which the last move chooses a technique; all else that it does is symmetric.
  double density(const Technique& technique_of_state) const {
    switch (last_) {
      case large:
        return choice_->pdf_length(technique_of_state.edges()) *
               choice_->pdf_technique(technique_of_state);
      case technique: return choice_->pdf_technique(technique_of_state);
      case small: break;
    }
    return 1;
  }

  double large_probability_, technique_probability_;
  TechniqueChange change_;
  MultiplexedPaths paths_;
  const TechniqueChoice* choice_;
  Move last_ = large;
  Path path_;  ///< Memory of keep_path.
  PathTerms terms_;
};

}  // namespace mlt
