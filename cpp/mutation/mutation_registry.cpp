#include "mutation/mutation_registry.h"

namespace mlt {

#define MLT_MUTATION(name) MutationPlugin mutation_##name();
#include "mutation/list.inc"
#undef MLT_MUTATION

const std::vector<MutationPlugin>& mutation_plugins() {
  static const std::vector<MutationPlugin> plugins = {
#define MLT_MUTATION(name) mutation_##name(),
#include "mutation/list.inc"
#undef MLT_MUTATION
  };
  return plugins;
}

const MutationPlugin& mutation_plugin(const std::string& name) {
  std::vector<std::string> names;
  for (const MutationPlugin& plugin : mutation_plugins()) {
    if (plugin.name() == name) return plugin;
    names.push_back(plugin.name());
  }
  throw UsageError("unknown mutation '" + name + "'" + suggestion(name, names));
}

Params own_parameters(const MutationPlugin& plugin, const MutationValues& values) {
  Params params(plugin.schema, {});
  for (const auto& [own, value] : values) params.set(own, value, {});
  return params;
}

MutationPtr make_mutation(const std::string& name, const PathTarget& target,
                          const MutationValues& values) {
  const MutationPlugin& plugin = mutation_plugin(name);
  Params params = own_parameters(plugin, values);
  return plugin.make(target, params);
}

}  // namespace mlt
