// Renders that are cheap enough to be made for every input.
#pragma once

#include "job/make_integrator.h"
#include "job/plugins.h"

#include <algorithm>

namespace mlt::fuzz {

constexpr int size = 4;

inline LoadOptions small_film() {
  LoadOptions options;
  options.size = Vec2i(size);
  return options;
}

/// With the scene's own settings and `more` where they exist, but no more than a few of anything.
inline IntegratorPtr small_integrator(const LoadedScene& loaded, const std::string& name,
                                      Assignments more = {}) {
  constexpr int64_t few = 16;
  const Schema& schema = plugins().find("integrator", name, {}).schema;
  for (const char* count : {"chains", "luminance_samples"})
    more.emplace_back(count, std::to_string(few));
  const auto unknown = [&](const auto& assignment) { return !schema.find(assignment.first); };
  more.erase(std::remove_if(more.begin(), more.end(), unknown), more.end());
  Node node = choose_integrator(loaded, name, more, plugins());
  for (Node::Property& property : node.properties)
    if (auto* count = std::get_if<int64_t>(&property.value)) *count = std::min(*count, few);
  return make_integrator(node, plugins()).integrator;
}

}  // namespace mlt::fuzz
