#include "io/element.h"

#include "base/text.h"

#include <algorithm>

namespace mlt {

const std::string* Element::find(const std::string& attribute) const {
  for (const auto& [name, value] : attributes)
    if (name == attribute) return &value;
  return nullptr;
}

std::string Element::get(const std::string& attribute) const {
  const std::string* value = find(attribute);
  return value ? *value : "";
}

const std::string& Element::require(const std::string& attribute) const {
  const std::string* value = find(attribute);
  if (!value) fail("needs the attribute '" + attribute + "'");
  if (trim(*value).empty()) fail("has an empty attribute '" + attribute + "'");
  return *value;
}

void Element::expect_only(std::initializer_list<const char*> known) const {
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto& [name, value] : attributes)
    if (std::find(names.begin(), names.end(), name) == names.end())
      fail("has no attribute " + quote(name) + suggestion(name.substr(0, 80), names));
}

std::string Element::title() const {
  const std::string name = get("name");
  return name.empty() ? "<" + tag + ">" : tag + " " + quote(name);
}

void Element::fail(const std::string& message) const {
  throw SceneError(at(where, title() + " " + message));
}

}  // namespace mlt
