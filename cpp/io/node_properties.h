// The properties of a node by their names in snake_case.
#pragma once

#include "io/node.h"

#include <algorithm>
#include <optional>

namespace mlt {

/// The property of this name, or nullptr; that of a constant node is constant.
template <class AnyNode>
auto find_property(AnyNode& node, const std::string& name) -> decltype(node.properties.data()) {
  const auto found =
      std::find_if(node.properties.begin(), node.properties.end(),
                   [&](const Node::Property& p) { return snake_case(p.name) == name; });
  return found == node.properties.end() ? nullptr : &*found;
}

/// Replaces the property, if there is one of this name.
inline void set_property(Node& node, const std::string& name, Value value) {
  if (Node::Property* found = find_property(node, name))
    found->value = std::move(value);
  else
    node.properties.push_back({name, std::move(value), node.where});
}

inline void remove_property(Node& node, const std::string& name) {
  auto& all = node.properties;
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const auto& p) { return snake_case(p.name) == name; }),
            all.end());
}

/// The property as a number, or nullopt.
inline std::optional<double> number_of(const Node& node, const std::string& name) {
  const Node::Property* found = find_property(node, name);
  if (!found) return std::nullopt;
  if (const auto* real = std::get_if<double>(&found->value)) return *real;
  if (const auto* integer = std::get_if<int64_t>(&found->value))
    return static_cast<double>(*integer);
  return std::nullopt;
}
inline std::string text_of(const Node& node, const std::string& name) {
  const Node::Property* found = find_property(node, name);
  const auto* text = found ? std::get_if<std::string>(&found->value) : nullptr;
  return text ? *text : "";
}

}  // namespace mlt
