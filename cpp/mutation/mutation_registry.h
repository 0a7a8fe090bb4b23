// The mutations by name.
#pragma once

#include "mutation/mutation.h"

#include <memory>
#include <vector>

namespace mlt {

struct MutationKind {
  std::string name;
  std::string
      switch_name;  ///< The parameter that turns it on, with Mitsuba's name where it has one.
  std::string weight_name;
  double weight;  ///< The default.
  std::string doc;
  bool perturbation;  ///< Has a step size.
  std::shared_ptr<const Mutation> (*make)(const Scene& scene, const MutationSettings& settings);
};

const std::vector<MutationKind>& mutation_kinds();

/// Throws UsageError for an unknown name.
const MutationKind& mutation_kind(const std::string& name);
std::shared_ptr<const Mutation> make_mutation(const std::string& name, const Scene& scene,
                                              const MutationSettings& settings);

}  // namespace mlt
