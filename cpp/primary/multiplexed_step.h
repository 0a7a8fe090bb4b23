// Multiplexed Metropolis light transport (Hachisuka, Kaplanyan & Dachsbacher 2014): the technique
// (s, t) is a part of the state, and the numbers make one path by it. The target is L* of the
// path's f / p, weighted among the techniques, so that a path is visited in proportion to its L*,
// by whichever technique it is made.
//
// In that paper each chain keeps the length of its paths, and the number of chains for a length is
// chosen by its light. Here a large step may change the length, so that one chain samples them all.
#pragma once

#include "markov/step.h"
#include "path/light_layers.h"
#include "path/path_terms.h"
#include "primary/primary_samples.h"
#include "primary/technique_choice.h"

#include <array>

namespace mlt {

struct MultiplexedState {
  PrimarySamples numbers;
  Technique technique;
  Vec2 raster{0};
  Color rgb{0};                    ///< f / p, weighted among techniques.
  double target = 0;               ///< L* of rgb.
  double target_over_density = 0;  ///< See ClampingWeights.
  LayerMask layers = 0;            ///< Layers of its path.

  void clear() {
    layers = 0;
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

/// The numbers by which a technique makes its path, from those of a whole sample: the first ones of
/// each stream.
inline PrimarySamples numbers_of(const Technique& technique, PrimarySamples sample) {
  std::vector<double>& direct = sample[Stream::direct];
  if (technique.s == 1)
    direct.erase(direct.begin(), direct.begin() + count_of<DirectNumbers> * (technique.t - 1));
  return sample;
}

/// Makes the path of a state by its technique.
struct MultiplexedPaths {
  const Scene* scene;
  BidirectionalSampler paths;  ///< Without Russian roulette: the technique fixes the walks.
  SmallStep small_step;
  RayCounts rays = {};
  LightLayers::Finder finder{nullptr};
  Path found = {};  ///< Scratch space.

  /// Makes the path of numbers near x, or of fresh ones if x is nullptr.
  void operator()(const PrimarySamples* x, MultiplexedState& y, Rng& rng) {
    make(x, small_step, y, rng, nullptr);
  }
  /// Makes the path of the numbers u, and assembles it in `path`, if there is one.
  void make_from(const PrimarySamples& u, MultiplexedState& y, Rng& rng, Path* path = nullptr) {
    make(&u, no_step, y, rng, path);
  }

 private:
  void make(const PrimarySamples* x, const SmallStep& step, MultiplexedState& y, Rng& rng,
            Path* path) {
    PrimarySampler sampler(x, y.numbers, step, rng);
    y.clear();
    paths.sample_technique(y.technique, sampler, rays, [&](const Connection& c) {
      y.show(c);
      if (path) paths.assemble(c, *path);
      if (finder.count() == 0) return;
      paths.assemble(c, found);
      y.layers = finder.of(found);
    });
    if (x) y.numbers.add_rest(*x);
  }
};

/// How a chain changes the technique, beside large steps.
enum class TechniqueChange {
  keeps_numbers,  ///< The numbers make another path (Hachisuka et al. 2014).
  keeps_path      ///< The numbers of the path are found by inversion (Bitterli et al. 2018).
};

/// Large steps draw technique and numbers afresh, small steps move the numbers a little, and others
/// change the technique for the same length.
///
/// A technique draws the same count of numbers for each path, so small steps are symmetric although
/// they leave the numbers of other techniques alone. A change of the technique moves no number, and
/// draws those that are missing afresh.
class MultiplexedStep {
 public:
  using State = MultiplexedState;
  static constexpr size_t stages = 2;
  enum Move { large = 0, small = 1, technique = 2 };

  /// With delayed rejection a small step follows a large one that was rejected, as in PrimaryStep.
  struct Moves {
    double large_probability, technique_probability;
    TechniqueChange change;
    bool delayed_rejection = false;
  };

  MultiplexedStep(const Moves& moves, MultiplexedPaths paths, const TechniqueChoice& choice)
      : moves_(moves), paths_(std::move(paths)), choice_(&choice) {}

  Transition propose(const State& x, std::array<State, stages>& y, size_t stage, Rng& rng) {
    if (stage > 0) return propose_again(x, y[0], y[1], rng);
    last_ = choose_move(rng.next());
    if (last_ == technique && moves_.change == TechniqueChange::keeps_path)
      return keep_path(x, y[0], rng);
    Technique chosen = x.technique;
    if (last_ != small) {
      const int edges = last_ == large ? choice_->sample_length(rng.next()) : chosen.edges();
      chosen = choice_->sample_technique(edges, rng.next());
    }
    y[0].technique = chosen;
    if (last_ == technique)
      paths_.make_from(x.numbers, y[0], rng);
    else
      paths_(last_ == large ? nullptr : &x.numbers, y[0], rng);
    return quotients(last_, x, y[0]);
  }

  Move last() const { return last_; }
  static bool generated(const State& y) { return y.target != 0; }
  MultiplexedPaths& paths() { return paths_; }

 private:
  Transition keep_path(const State& x, State& y, Rng& rng);
  bool remake(const State& x, const Technique& technique, State& y, Rng& rng);

  Move choose_move(double u) const {
    if (u < moves_.large_probability) return large;
    return u < moves_.large_probability + moves_.technique_probability ? technique : small;
  }
  Transition quotients(Move of, const State& x, const State& y) const {
    if (!generated(y)) return impossible;
    return {density(of, y.technique) / y.target, density(of, x.technique) / x.target};
  }
  Transition propose_again(const State& x, const State& y1, State& y2, Rng& rng) {
    if (!moves_.delayed_rejection || last_ != large) return impossible;
    y2.technique = x.technique;
    paths_(&x.numbers, y2, rng);
    const Transition own = quotients(small, x, y2);
    return after_rejection(own, quotients(large, x, y1), quotients(large, y2, y1));
  }

  /// Probability with which a move chooses its technique; the rest of the move is symmetric.
  double density(Move of, const Technique& technique_of_state) const {
    switch (of) {
      case large:
        return choice_->pdf_length(technique_of_state.edges()) *
               choice_->pdf_technique(technique_of_state);
      case technique: return choice_->pdf_technique(technique_of_state);
      case small: break;
    }
    return 1;
  }

  Moves moves_;
  MultiplexedPaths paths_;
  const TechniqueChoice* choice_;
  Move last_ = large;
  // Scratch space of keep_path:
  Path path_;
  PathTerms terms_;
  PrimarySamples inverted_;
};

}  // namespace mlt
