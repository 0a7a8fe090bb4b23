#include "io/animation_times.h"

#include <algorithm>

namespace mlt {
namespace {

using Spans = std::vector<std::pair<double, double>>;

double time_of(const Node& key) {
  for (const Node::Property& property : key.properties)
    if (property.name == "time") {
      if (const auto* time = std::get_if<double>(&property.value)) return *time;
      if (const auto* time = std::get_if<int64_t>(&property.value))
        return static_cast<double>(*time);
    }
  return 0;
}

void add_spans(const Animation& keys, Spans& spans) {
  for (size_t i = 1; i < keys.size(); ++i)
    if (!(keys[i - 1].transform == keys[i].transform))
      spans.emplace_back(keys[i - 1].time, keys[i].time);
}

/// Between keys of colours, which are taken to differ.
void add_spans(const std::vector<Node>& keys, Spans& spans) {
  std::vector<double> times;
  for (const Node& key : keys) times.push_back(time_of(key));
  std::sort(times.begin(), times.end());
  for (size_t i = 1; i < times.size(); ++i) spans.emplace_back(times[i - 1], times[i]);
}

void add_all_spans(const Node& node, Spans& spans) {
  if (node.family == "texture" && node.type == "animation") add_spans(node.children, spans);
  for (const Node::Property& property : node.properties)
    if (const auto* keys = std::get_if<Animation>(&property.value)) add_spans(*keys, spans);
  for (const Node& child : node.children) add_all_spans(child, spans);
}

}  // namespace

std::vector<std::pair<double, double>> animation_times(const Node& tree) {
  Spans spans;
  add_all_spans(tree, spans);
  return spans;
}

}  // namespace mlt
