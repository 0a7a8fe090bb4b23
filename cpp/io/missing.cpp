#include "io/missing.h"

#include "io/families.h"
#include "io/leniency.h"

#include <algorithm>

namespace mlt {
namespace {

constexpr size_t most_kinds = 20;

class Search {
 public:
  explicit Search(const Registry& registry) : registry_(registry) {}

  void visit(const Node& node) {
    if (node.family == "integrator") return;  // it may still be replaced
    const bool is_plugin =
        node.family != "scene" && node.family != "ref" && node.family != "sampler";
    if (is_plugin &&
        note([&] { refuse_element(node.family, node.type, node.where); }, node.where) &&
        note([&] { registry_.find(node.family, node.type, node.where); }, node.where))
      visit_properties(node);
    const auto is_sensor = [](const Node& child) { return child.family == "sensor"; };
    const auto sensors = std::count_if(node.children.begin(), node.children.end(), is_sensor);
    for (const Node& child : node.children)
      if (sensors < 2 || !is_sensor(child)) visit(child);  // only one of several is made
  }

  void report() const {
    if (found_.empty()) return;
    std::string message = at(found_[0].where, found_[0].what);
    for (size_t i = 1; i < std::min(found_.size(), most_kinds); ++i) {
      const auto& [where, what] = found_[i];
      const bool same_file = where.file == found_[0].where.file && where.line > 0;
      message +=
          "; " + (same_file ? fmt::format("line {}: {}", where.line, what) : at(where, what));
    }
    if (found_.size() > most_kinds)
      message += fmt::format("; and {} more", found_.size() - most_kinds);
    throw SceneError(message);
  }

 private:
  struct Found {
    Location where;
    std::string what;
  };

  void visit_properties(const Node& node) {
    const Schema& schema = registry_.find(node.family, node.type, node.where).schema;
    Params params(schema, node.where);
    for (const Node::Property& property : node.properties)
      note(
          [&] {
            params.set(current_name(node, property.name, schema), property.value, property.where);
          },
          property.where);
  }

  /// Whether `check` finds nothing wrong.
  template <class Check>
  bool note(const Check& check, const Location& where) {
    try {
      check();
      return true;
    } catch (const SceneError& error) {
      std::string what = error.what();
      if (const std::string place = on_one_line(at(where, ""));
          what.compare(0, place.size(), place) == 0)
        what.erase(0, place.size());
      const bool known = std::any_of(found_.begin(), found_.end(),
                                     [&](const Found& other) { return other.what == what; });
      if (!known) found_.push_back({where, what});
      return false;
    }
  }

  const Registry& registry_;
  std::vector<Found> found_;
};

}  // namespace

void refuse_missing(const Node& tree, const Registry& registry) {
  Search search(registry);
  search.visit(tree);
  search.report();
}

}  // namespace mlt
