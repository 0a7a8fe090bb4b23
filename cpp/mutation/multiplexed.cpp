// A small step in primary sample space, for chains of light paths (Otsu, Kaplanyan, Hanika,
// Dachsbacher & Hachisuka 2017, "Fusing state spaces for Markov chain Monte Carlo rendering").
//
// One of the techniques that can make x is drawn with the probability p_s(x) / P(x), where P is
// the sum of all p_s: the balance heuristic. Its inverse turns x into numbers u; these move a
// little, with a symmetric density S; and the technique makes y from the new numbers v:
//
//   q_s(x -> y) = p_s(x) / P(x) S(u -> v) p_s(y).
//
// The step is reversible for each s on its own. Since p_s(x) S(u -> v) p_s(y) is the same on the
// way back, P(y) stands for q(x -> y), and the acceptance is min(1, L*(y) P(x) / (L*(x) P(y))).
//
// It moves every vertex, at the cost of tracing all rays of the path. That pays where specular
// vertices defeat the cheaper perturbations, so it acts on paths with one.
#include "mutation/measured_mutation.h"
#include "mutation/mutation_registry.h"
#include "primary/invert_path.h"

namespace mlt {
namespace {

class MultiplexedMutation final : public MeasuredMutation<MultiplexedMutation> {
 public:
  MultiplexedMutation(const PathTarget& target, Params& params)
      : MeasuredMutation("multiplexed", target) {
    small_step_.size = params.real_in("step_size", 1e-9, 0.5);
  }

  double suitability(const PathState& x) const override {
    for (int i = 1; i < x.edges(); ++i)
      if (x.specular(i)) return 1;
    return 0;
  }

  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    const int k = x.edges(), s = sample_technique(x.terms, Heuristic::balance, context.rng.next());
    if (s < 0) return std::nullopt;
    const Technique technique{s, k + 1 - s};
    PrimaryWalks& walks = context.primary_walks(scene(), target().rules());
    if (!invert_path(scene(), x.path, technique, context.rng, walks.numbers)) return std::nullopt;
    PrimarySampler sampler(&walks.numbers, walks.moved, small_step_, context.rng);
    bool found = false;
    walks.paths.sample_technique(technique, sampler, context.rays, [&](const Connection& c) {
      walks.paths.assemble(c, y.path);
      found = true;
    });
    if (!found) return std::nullopt;
    // a step that cannot be reversed, because of rounding, must not be proposed
    if (!invert_path(scene(), y.path, technique, context.rng, walks.numbers)) return std::nullopt;
    target().evaluate(y);
    return Edit{0, k, k + 1};
  }

  template <class Measure>
  double density_in(const Measure& in, const PathState&, const PathState&, const Edit&) const {
    return total_density(in);
  }

 private:
  SmallStep small_step_;
};

}  // namespace

MutationPlugin mutation_multiplexed() {
  return {{"mutation",
           "multiplexed",
           "small step in primary sample space, by a technique that can make the path (Otsu et al. "
           "2017).",
           {{"step_size", ParamType::real, 1. / 64, "Largest move of a number in [0, 1)."}}},
          "multiplexed_perturbation",
          0.1,
          make_shared_mutation<MultiplexedMutation>,
          false};
}

}  // namespace mlt
