// The two perturbations that start at the lens. In both the image position moves by a small
// distance (and, with a lens of finite aperture, half of the time the point on the lens too) and
// the path follows, up to the diffuse vertex that is connected to the rest. They differ in the
// paths that they suit:
//
// The lens perturbation (Veach & Guibas 1997, sec. 5.3.2.1; Veach 1997, sec. 11.3.3.1) has the form
// (L|D)DS*E: it explores what is seen directly, in mirrors and through glass.
//
// The multi-chain perturbation (sec. 5.3.2.3; sec. 11.3.3.3) has the form (L|D)(DS+)+DS*E, such as
// a caustic seen through glass: where the path goes on from a diffuse vertex to another specular
// chain, the direction is perturbed by a small angle and carried through that chain, and so on, for
// any number of chains.
//
// Where specular vertices lead on to the light, LS*E and L(S+D)+S*E, nothing can be joined; Veach
// leaves these paths to the bidirectional mutation. Here the whole path follows, and its end has to
// hit a light again. So they explore a lamp in a mirror, and surfaces lit through glass that are
// seen through glass.
#include "mutation/chain_perturbation.h"
#include "mutation/image_move.h"
#include "mutation/measured_mutation.h"
#include "mutation/mutation_registry.h"

namespace mlt {
namespace {

CameraChains camera_chains(const PathState& x) {
  CameraChains chains;
  int i = ChainPerturbation::chain_end(x, x.edges(), -1);
  for (; i > 1 && x.specular(i - 1); i = ChainPerturbation::chain_end(x, i, -1)) ++chains.further;
  if (i > 0 ? x.terms[i - 1].connectable : x.terms.light_can_be_hit) chains.stop = i;
  return chains;
}

class CameraPerturbation final : public MeasuredMutation<CameraPerturbation> {
 public:
  enum class Chains { one, many };

  CameraPerturbation(std::string name, Chains chains, const PathTarget& target, Params& params)
      : MeasuredMutation(std::move(name), target),
        chains_(chains),
        chain_(target.scene(), step_sizes(params)),
        image_(target.scene(), chain_) {}

  double suitability(const PathState& x) const override {
    const CameraChains& found = chains(x);
    return found.stop >= 0 && (found.further > 0) == (chains_ == Chains::many) ? 1 : 0;
  }

  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    return image_.propose(target(), x, {x.edges(), chains(x).stop, -1}, y, context);
  }

  template <class Measure>
  double density_in(const Measure& in, const PathState& x, const PathState& y,
                    const Edit& edit) const {
    const int k = x.edges(), stop = chains(x).stop;
    if (!(chains(x) == chains(y)) || stop != edit.first) return 0;
    if (stop == 0 && !same_light_at_infinity(x, y)) return 0;
    for (int i = stop; i < k; ++i)
      if (x.specular(i) != y.specular(i)) return 0;
    return chain_.density(in, x, y, {k, stop, -1}, image_.density(x, y));
  }

 private:
  static const CameraChains& chains(const PathState& x) {
    return x.known.camera_chains.get([&] { return camera_chains(x); });
  }

  Chains chains_;
  ChainPerturbation chain_;
  ImageMove image_;
};

}  // namespace

MutationPlugin mutation_lens() {
  return {{"mutation", "lens",
           "lens perturbation of paths (L|D)DS*E and LS*E (Veach 1997, sec. 11.3.3.1).",
           step_size_parameters()},
          "lens_perturbation",
          0.3,
          [](const PathTarget& target, Params& params) -> MutationPtr {
            return std::make_shared<CameraPerturbation>("lens", CameraPerturbation::Chains::one,
                                                        target, params);
          }};
}

MutationPlugin mutation_multi_chain() {
  return {{"mutation", "multi_chain",
           "multi-chain perturbation of paths (L|D)(DS+)+DS*E and L(S+D)+S*E (Veach 1997, sec. "
           "11.3.3.3).",
           step_size_parameters()},
          "multi_chain_perturbation",
          0.2,
          [](const PathTarget& target, Params& params) -> MutationPtr {
            return std::make_shared<CameraPerturbation>(
                "multi_chain", CameraPerturbation::Chains::many, target, params);
          }};
}

}  // namespace mlt
