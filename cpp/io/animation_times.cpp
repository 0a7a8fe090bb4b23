#include "io/animation_times.h"

#include <algorithm>

namespace mlt {
namespace {

std::vector<double> times_of_keys(const Node& animation) {
  std::vector<double> times;
  for (const Node& key : animation.children)
    for (const Node::Property& property : key.properties)
      if (property.name == "time") {
        if (const auto* time = std::get_if<double>(&property.value)) times.push_back(*time);
        if (const auto* time = std::get_if<int64_t>(&property.value))
          times.push_back(static_cast<double>(*time));
      }
  return times;
}

void add_times(const Node& node, std::vector<std::pair<double, double>>& all) {
  const auto add = [&](const std::vector<double>& times) {
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    if (!times.empty()) all.emplace_back(*first, *last);
  };
  if (node.family == "texture" && node.type == "animation") add(times_of_keys(node));
  for (const Node::Property& property : node.properties)
    if (const auto* keys = std::get_if<Animation>(&property.value)) {
      std::vector<double> times;
      for (const Keyframe& key : *keys) times.push_back(key.time);
      add(times);
    }
  for (const Node& child : node.children) add_times(child, all);
}

}  // namespace

std::vector<std::pair<double, double>> animation_times(const Node& tree) {
  std::vector<std::pair<double, double>> all;
  add_times(tree, all);
  return all;
}

}  // namespace mlt
