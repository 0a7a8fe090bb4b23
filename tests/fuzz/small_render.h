// Renders that are cheap enough to be made for every input.
#pragma once

#include "render/make_integrator.h"
#include "render/plugins.h"

#include <algorithm>

namespace mlt::fuzz {

constexpr int size = 4;

inline LoadOptions small_film() {
  LoadOptions options;
  options.size = Vec2i(size);
  return options;
}

/// With the scene's own settings, but no more than a few of anything.
inline IntegratorPtr small_integrator(const LoadedScene& loaded, const std::string& name) {
  constexpr int64_t few = 16;
  Assignments counts;
  const Schema& schema = plugins().find("integrator", name, {}).schema;
  for (const char* count : {"chains", "luminance_samples"})
    if (schema.find(count)) counts.emplace_back(count, std::to_string(few));
  Node node = choose_integrator(loaded, name, counts, plugins());
  for (Node::Property& property : node.properties)
    if (auto* count = std::get_if<int64_t>(&property.value)) *count = std::min(*count, few);
  return make_integrator(node, plugins()).integrator;
}

}  // namespace mlt::fuzz
