#include "mutation/mutation_registry.h"

#include "mutation/bidirectional_mutation.h"
#include "mutation/caustic.h"
#include "mutation/lens.h"
#include "mutation/lens_subpath.h"
#include "mutation/multi_chain.h"

namespace mlt {
namespace {

template <class M>
std::shared_ptr<const Mutation> make(const Scene& scene, const MutationSettings& settings) {
  return std::make_shared<M>(scene, settings);
}

}  // namespace

const std::vector<MutationKind>& mutation_kinds() {
  static const std::vector<MutationKind> kinds = {
      {"bidirectional", "bidirectional_mutation", "bidirectional_weight", 0.3,
       "bidirectional mutation, which replaces any piece of the path (Veach 1997, sec. 11.3.1).",
       false, make<BidirectionalMutation>},
      {"lens", "lens_perturbation", "lens_weight", 0.3,
       "lens perturbation of paths (L|D)DS*E and LS*E (Veach 1997, sec. 11.3.3.1).", true,
       make<LensPerturbation>},
      {"caustic", "caustic_perturbation", "caustic_weight", 0.2,
       "caustic perturbation of paths (L|D)S*DE (Veach 1997, sec. 11.3.3.2).", true,
       make<CausticPerturbation>},
      {"multi_chain", "multi_chain_perturbation", "multi_chain_weight", 0.2,
       "multi-chain perturbation of paths (L|D)(DS+)+DS*E and L(S+D)+S*E (Veach 1997, sec. "
       "11.3.3.3).",
       true, make<MultiChainPerturbation>},
      {"lens_subpath", "lens_subpath_mutation", "lens_subpath_weight", 0.1,
       "lens subpath mutation, which draws a fresh camera end (Veach 1997, sec. 11.3.4).", false,
       make<LensSubpathMutation>},
  };
  return kinds;
}

const MutationKind& mutation_kind(const std::string& name) {
  std::vector<std::string> names;
  for (const MutationKind& kind : mutation_kinds()) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  throw UsageError("unknown mutation '" + name + "'" + suggestion(name, names));
}

std::shared_ptr<const Mutation> make_mutation(const std::string& name, const Scene& scene,
                                              const MutationSettings& settings) {
  return mutation_kind(name).make(scene, settings);
}

}  // namespace mlt
