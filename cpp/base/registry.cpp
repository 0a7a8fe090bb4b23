#include "base/registry.h"

namespace mlt {

ObjectPtr make_object(const Plugin& plugin, Params& params) {
  try {
    return plugin.create(params);
  } catch (const FileError& error) {
    throw FileError(at(params.where(), error.what()));
  } catch (const UsageError& error) {
    throw SceneError(at(params.where(), error.what()));
  }
}

void Registry::insert(const std::string& family, const std::string& name, Entry entry) {
  if (!entries_[family].emplace(name, std::move(entry)).second)
    throw Error(at({}, "{} '{}' is registered twice", family, name));
}

void Registry::add(Plugin plugin) {
  const std::string family = plugin.schema.family, name = plugin.schema.name;
  insert(family, name, {std::move(plugin), ""});
}

void Registry::alias(const std::string& family, const std::string& name, const std::string& meant) {
  insert(family, name, {{}, "", meant});
}

void Registry::refuse(const std::string& family, const std::string& name,
                      const std::string& reason) {
  insert(family, name, {{}, reason});
}

const Plugin& Registry::find(const std::string& family, const std::string& name,
                             const Location& where) const {
  if (const auto members = entries_.find(family); members != entries_.end())
    if (const auto found = members->second.find(name); found != members->second.end()) {
      const auto& [plugin, refusal, meant] = found->second;
      if (plugin.create) return plugin;
      if (!meant.empty()) return find(family, meant, where);
      throw SceneError(at(where, "{} '{}' is not supported: {}", family, name, refusal));
    }
  const std::vector<std::string> known = names(family);
  if (known.empty())
    throw SceneError(at(where, "unknown element '{}'{}", family, suggestion(family, families())));
  throw SceneError(at(where, "unknown {} '{}'{}", family, name, suggestion(name, known)));
}

bool Registry::has(const std::string& family, const std::string& name) const {
  const auto members = entries_.find(family);
  if (members == entries_.end()) return false;
  const auto found = members->second.find(name);
  if (found == members->second.end()) return false;
  return found->second.plugin.create || !found->second.meant.empty();
}

std::vector<std::string> Registry::families() const {
  std::vector<std::string> found;
  for (const auto& [family, members] : entries_)
    if (!names(family).empty()) found.push_back(family);
  return found;
}

std::vector<std::string> Registry::names(const std::string& family) const {
  std::vector<std::string> found;
  if (const auto members = entries_.find(family); members != entries_.end())
    for (const auto& [name, entry] : members->second)
      if (entry.plugin.create) found.push_back(name);
  return found;
}

std::vector<std::string> Registry::families_of(const std::string& name) const {
  std::vector<std::string> found;
  for (const auto& [family, members] : entries_)
    if (members.count(name)) found.push_back(family);
  return found;
}

}  // namespace mlt
