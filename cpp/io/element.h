// One XML element, with its attributes after $names have been replaced.
#pragma once

#include "base/error.h"

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace mlt {

struct Element {
  std::string tag;
  Location where;
  std::vector<std::pair<std::string, std::string>> attributes;

  /// The attribute's value, or nullptr.
  const std::string* find(const std::string& attribute) const;
  /// The attribute's value, or "".
  std::string get(const std::string& attribute) const;
  /// The attribute's value. Throws SceneError if it is missing or empty.
  const std::string& require(const std::string& attribute) const;
  /// Throws SceneError if there is any other attribute.
  void expect_only(std::initializer_list<const char*> known) const;

  /// The element in messages: "float 'fov'", or "<scale>" for an element without a name.
  std::string title() const;
  /// Throws SceneError: "file:line: float 'fov' <message>".
  [[noreturn]] void fail(const std::string& message) const;
};

}  // namespace mlt
