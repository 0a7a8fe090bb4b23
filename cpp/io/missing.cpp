#include "io/missing.h"

#include "io/families.h"
#include "io/leniency.h"
#include "io/mistakes.h"

#include <algorithm>

namespace mlt {
namespace {

class Search {
 public:
  explicit Search(const Registry& registry) : registry_(registry) {}

  void visit(const Node& node) {
    if (node.family == "integrator") return;  // it may still be replaced
    const bool is_plugin =
        node.family != "scene" && node.family != "ref" && node.family != "sampler";
    if (is_plugin &&
        mistakes_.note([&] { refuse_element(node.family, node.type, node.where); }, node.where) &&
        mistakes_.note([&] { registry_.find(node.family, node.type, node.where); }, node.where))
      visit_properties(node);
    const auto is_sensor = [](const Node& child) { return child.family == "sensor"; };
    const auto sensors = std::count_if(node.children.begin(), node.children.end(), is_sensor);
    for (const Node& child : node.children)
      if (sensors < 2 || !is_sensor(child)) visit(child);  // only one of several is made
  }

  void report() const { mistakes_.report(); }

 private:
  void visit_properties(const Node& node) {
    const Schema& schema = registry_.find(node.family, node.type, node.where).schema;
    Params params(schema, node.where);
    for (const Node::Property& property : node.properties)
      mistakes_.note(
          [&] {
            params.set(current_name(node, property.name, schema), property.value, property.where);
          },
          property.where);
  }

  const Registry& registry_;
  Mistakes mistakes_;
};

}  // namespace

void refuse_missing(const Node& tree, const Registry& registry) {
  Search search(registry);
  search.visit(tree);
  search.report();
}

}  // namespace mlt
