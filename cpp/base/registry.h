// The table of plug-ins: how a (family, name) becomes an object.
#pragma once

#include "base/params.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace mlt {

/// A schema and the function that makes the object. Each plug-in file defines one function that
/// returns its Plugin, named after family and name: `Plugin bsdf_diffuse()`.
struct Plugin {
  Schema schema;
  std::function<ObjectPtr(Params&)> create;
};

/// Calls plugin.create. The message of a FileError, or of a UsageError about a value, is prefixed
/// by the plug-in's location in the scene; a UsageError becomes a SceneError.
ObjectPtr make_object(const Plugin& plugin, Params& params);

/// The plug-in whose objects are made by `T(Params&)`.
template <class T>
Plugin make_plugin(Schema schema) {
  return {std::move(schema), [](Params& params) { return std::make_shared<T>(params); }};
}
template <class T>
Plugin make_plugin(const char* family, const char* name, const char* doc,
                   std::vector<Parameter> parameters = {}, std::vector<std::string> ignored = {}) {
  return make_plugin<T>({family, name, doc, std::move(parameters), std::move(ignored)});
}

class Registry {
 public:
  /// Adds a plug-in. Each name is added or refused once: a second time throws Error.
  void add(Plugin plugin);
  /// Makes `name` another name of the plug-in `meant`.
  void alias(const std::string& family, const std::string& name, const std::string& meant);
  /// Refuses Mitsuba's plug-in `name` by name, in one line that ends with `reason`.
  void refuse(const std::string& family, const std::string& name, const std::string& reason);

  /// Finds a plug-in. Throws SceneError at `where` with a suggestion, or with the reason if the
  /// name is one that Mitsuba has and this renderer refuses.
  const Plugin& find(const std::string& family, const std::string& name,
                     const Location& where) const;

  /// Whether there is such a plug-in; false if its name is refused.
  bool has(const std::string& family, const std::string& name) const;
  std::vector<std::string> families() const;
  std::vector<std::string> names(const std::string& family) const;
  /// The families in which `name` is known or refused; normally one.
  std::vector<std::string> families_of(const std::string& name) const;

 private:
  /// A plug-in, or the name of the one that is meant, or the reason why there is none.
  struct Entry {
    Plugin plugin;
    std::string refusal, meant = {};
  };
  void insert(const std::string& family, const std::string& name, Entry entry);

  std::map<std::string, std::map<std::string, Entry>> entries_;
};

}  // namespace mlt
