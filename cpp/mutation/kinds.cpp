#include "mutation/kinds.h"

#include "mutation/bidirectional.h"
#include "mutation/caustic.h"
#include "mutation/lens.h"
#include "mutation/lens_subpath.h"

namespace mlt {

const std::vector<MutationKind>& mutation_kinds() {
  static const std::vector<MutationKind> kinds = {
      {"bidirectional", "bidirectional_mutation", "bidirectional_weight", 0.3,
       "bidirectional mutation, which replaces any piece of the path (Veach 1997, sec. 11.3.1)."},
      {"lens", "lens_perturbation", "lens_weight", 0.3,
       "lens perturbation of paths (L|D)DS*E (Veach 1997, sec. 11.3.3.1)."},
      {"caustic", "caustic_perturbation", "caustic_weight", 0.2,
       "caustic perturbation of paths (L|D)S*DE (Veach 1997, sec. 11.3.3.2)."},
      {"multi_chain", "multi_chain_perturbation", "multi_chain_weight", 0.2,
       "multi-chain perturbation of paths (L|D)(DS+)*DS*E (Veach 1997, sec. 11.3.3.3)."},
      {"lens_subpath", "lens_subpath_mutation", "lens_subpath_weight", 0.1,
       "lens subpath mutation, which draws a fresh camera end (Veach 1997, sec. 11.3.4)."},
  };
  return kinds;
}

std::shared_ptr<const Mutation> make_mutation(const std::string& name, const Scene& scene,
                                              const MutationSettings& settings) {
  if (name == "bidirectional") return std::make_shared<BidirectionalMutation>(scene, settings);
  if (name == "lens") return std::make_shared<LensPerturbation>(scene, settings);
  if (name == "caustic") return std::make_shared<CausticPerturbation>(scene, settings);
  if (name == "multi_chain") return std::make_shared<MultiChainPerturbation>(scene, settings);
  if (name == "lens_subpath") return std::make_shared<LensSubpathMutation>(scene, settings);
  std::vector<std::string> names;
  for (const MutationKind& kind : mutation_kinds()) names.push_back(kind.name);
  throw UsageError("unknown mutation '" + name + "'" + suggestion(name, names));
}

}  // namespace mlt
