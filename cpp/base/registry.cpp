#include "base/registry.h"

#include <set>

namespace mlt {

void Registry::add(Plugin plugin) {
  auto& family = plugins_[plugin.schema.family];
  const std::string name = plugin.schema.name;
  family[name] = std::make_unique<Plugin>(std::move(plugin));
}

const Plugin& Registry::find(const std::string& family, const std::string& name,
                             const Location& where) const {
  const auto members = plugins_.find(family);
  if (members != plugins_.end()) {
    const auto plugin = members->second.find(name);
    if (plugin != members->second.end()) return *plugin->second;
  }
  const auto refused = refused_.find(family);
  if (refused != refused_.end()) {
    const auto reason = refused->second.find(name);
    if (reason != refused->second.end())
      throw SceneError(at(where, family + " '" + name + "' is not supported: " + reason->second));
  }
  if (members == plugins_.end())
    throw SceneError(
        at(where, "unknown element '" + family + "'" + suggestion(family, families())));
  throw SceneError(
      at(where, "unknown " + family + " '" + name + "'" + suggestion(name, names(family))));
}

std::vector<std::string> Registry::families() const {
  std::vector<std::string> names;
  for (const auto& [family, members] : plugins_) names.push_back(family);
  return names;
}

std::vector<std::string> Registry::names(const std::string& family) const {
  std::vector<std::string> names;
  const auto members = plugins_.find(family);
  if (members != plugins_.end())
    for (const auto& [name, plugin] : members->second) names.push_back(name);
  return names;
}

std::vector<std::string> Registry::families_of(const std::string& name) const {
  std::set<std::string> found;
  for (const auto& [family, members] : plugins_)
    if (members.count(name)) found.insert(family);
  for (const auto& [family, members] : refused_)
    if (members.count(name)) found.insert(family);
  return {found.begin(), found.end()};
}

void Registry::refuse(const std::string& family, const std::string& name,
                      const std::string& reason) {
  refused_[family][name] = reason;
}

}  // namespace mlt
