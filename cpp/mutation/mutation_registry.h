// The mutations by name. Each file of a mutation ends with the function that describes it, and has
// a line in list.inc.
#pragma once

#include "base/params.h"
#include "mutation/path_chain.h"

#include <string>
#include <utility>
#include <vector>

namespace mlt {

struct MutationPlugin {
  /// Name, doc, and its own parameters. `mlt` has them with the mutation's name in front:
  /// largest_share of lens is lens_largest_share.
  Schema schema;
  std::string switch_name;  ///< The parameter of mlt that turns it on: Mitsuba's, where it has one.
  double weight;            ///< Its weight by default.
  MutationPtr (*make)(const PathTarget& target, Params& own);
  bool on = true;  ///< Whether it is on by default.
  /// Whether it can move anything in a scene; nullptr: in all.
  bool (*supports)(const Scene& scene) = nullptr;

  const std::string& name() const { return schema.name; }
  std::string weight_name() const { return name() + "_weight"; }
  /// The name in mlt of one of its own parameters.
  std::string full_name(const std::string& own) const { return name() + "_" + own; }
  /// Whether it moves by steps of a size that can be chosen.
  bool has_step_size() const { return schema.find("largest_share") != nullptr; }
};

/// Makes a mutation of type M; used by most plug-ins.
template <class M>
MutationPtr make_shared_mutation(const PathTarget& target, Params& own) {
  return std::make_shared<M>(target, own);
}

const std::vector<MutationPlugin>& mutation_plugins();
/// The mutation of this name. Throws UsageError for an unknown one.
const MutationPlugin& mutation_plugin(const std::string& name);

/// Values of a mutation's own parameters; the others have their defaults.
using MutationValues = std::vector<std::pair<std::string, Value>>;

/// A mutation's own parameters with these values. Throws SceneError for a value that does not fit.
Params own_parameters(const MutationPlugin& plugin, const MutationValues& values);
/// Makes a mutation. Throws UsageError for an unknown name, SceneError for a value that is wrong.
MutationPtr make_mutation(const std::string& name, const PathTarget& target,
                          const MutationValues& values = {});

}  // namespace mlt
