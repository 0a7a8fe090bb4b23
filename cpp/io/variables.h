// The $names of a scene: <default> sets a value that the user's own defines override.
#pragma once

#include "base/error.h"

#include <map>
#include <set>
#include <string>

namespace mlt {

class Variables {
 public:
  explicit Variables(const std::map<std::string, std::string>& defines);

  /// Sets a <default>, unless the name has a value already.
  void set_default(const std::string& name, const std::string& value);

  /// Replaces every $name by its value: of the names that are known, the longest that fits. `\$`
  /// is a dollar sign, and so is one that no letter, digit or underscore follows. Throws SceneError
  /// for an unknown name.
  std::string substitute(const std::string& text, const Location& where);

  /// Throws UsageError for a define that the scene does not use.
  void expect_all_used() const;

 private:
  std::map<std::string, std::string> values_;
  std::set<std::string> unused_;    ///< Defines that are not used yet.
  std::set<std::string> of_scene_;  ///< Names with a <default> in the scene.
};

}  // namespace mlt
