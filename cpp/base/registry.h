// The table of plug-ins: how a (family, name) becomes an object.
#pragma once

#include "base/params.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace mlt {

/// A schema and the function that makes the object. Each plug-in file defines one function that
/// returns its Plugin, named after family and name: `Plugin bsdf_diffuse()`.
struct Plugin {
  Schema schema;
  ObjectPtr (*create)(Params&);
};

/// The plug-in whose objects are made by `T(Params&)`.
template <class T>
Plugin make_plugin(Schema schema) {
  return {std::move(schema),
          [](Params& params) -> ObjectPtr { return std::make_shared<T>(params); }};
}

class Registry {
 public:
  void add(Plugin plugin);

  /// Throws SceneError at `where` with a suggestion, or with the reason when the name is one that
  /// Mitsuba has and this renderer refuses.
  const Plugin& find(const std::string& family, const std::string& name,
                     const Location& where) const;

  std::vector<std::string> families() const;
  std::vector<std::string> names(const std::string& family) const;
  /// The families in which `name` is known or refused; normally one.
  std::vector<std::string> families_of(const std::string& name) const;

  /// Refuses Mitsuba's plug-in `name` by name, in one line that ends with `reason`.
  void refuse(const std::string& family, const std::string& name, const std::string& reason);

 private:
  std::map<std::string, std::map<std::string, std::unique_ptr<Plugin>>> plugins_;
  std::map<std::string, std::map<std::string, std::string>> refused_;
};

}  // namespace mlt
