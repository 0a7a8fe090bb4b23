#include "io/leniency.h"

#include <algorithm>
#include <map>

namespace mlt {
namespace {

bool is_unknown(const std::string& name, const std::vector<std::string>& known) {
  return std::find(known.begin(), known.end(), name) == known.end() && closest(name, known).empty();
}

class Pruner {
 public:
  Pruner(const Registry& registry, std::vector<std::string>& warnings)
      : registry_(registry), warnings_(warnings) {}

  void visit(Node& node) {
    if (registry_.has(node.family, node.type))
      prune_parameters(node, registry_.find(node.family, node.type, node.where).schema);
    remove(node.children, [&](const Node& child) {
      if (child.family != "integrator" || holds_integrator(child) ||
          registry_.has("integrator", child.type) ||
          !is_unknown(child.type, registry_.names("integrator")))
        return false;
      warnings_.push_back(
          at(child.where, "integrator '{}' is not known here; the default is used", child.type));
      return true;
    });
    for (Node& child : node.children) visit(child);
  }

  void warn() {
    for (const auto& [kind, found] : found_)
      warnings_.push_back(at(found.first, "{} has no effect here{}", kind,
                             found.count == 1 ? "" : fmt::format(" ({} times)", found.count)));
  }

 private:
  struct Found {
    Location first;
    int count = 0;
  };

  template <class T, class Unwanted>
  static void remove(std::vector<T>& all, Unwanted&& unwanted) {
    all.erase(std::remove_if(all.begin(), all.end(), unwanted), all.end());
  }

  /// Whether an integrator holds another one, as `moment` does.
  static bool holds_integrator(const Node& node) {
    return std::any_of(node.children.begin(), node.children.end(),
                       [](const Node& child) { return child.family == "integrator"; });
  }

  void prune_parameters(Node& node, const Schema& schema) {
    std::vector<std::string> known = schema.parameter_names();
    known.insert(known.end(), schema.ignored.begin(), schema.ignored.end());
    const auto unwanted = [&](const std::string& name, const Location& where) {
      if (!is_unknown(snake_case(current_name(node, name, schema)), known)) return false;
      Found& found = found_[fmt::format("{} '{}': '{}'", node.family, node.type, name)];
      if (found.count++ == 0) found.first = where;
      return true;
    };
    remove(node.properties,
           [&](const Node::Property& property) { return unwanted(property.name, property.where); });
    remove(node.children, [&](const Node& child) {
      return child.family == "texture" && !schema.unnamed_texture && !child.name.empty() &&
             unwanted(child.name, child.where);
    });
  }

  const Registry& registry_;
  std::vector<std::string>& warnings_;
  std::map<std::string, Found> found_;
};

}  // namespace

void leave_out_unknown(Node& tree, const Registry& registry, std::vector<std::string>& warnings) {
  Pruner pruner(registry, warnings);
  pruner.visit(tree);
  pruner.warn();
}

std::string current_name(const Node& node, const std::string& name, const Schema& schema) {
  if (node.family == "bsdf" && node.type == "diffuse" &&
      snake_case(name) == "diffuse_reflectance" && !schema.find("diffuse_reflectance"))
    return "reflectance";
  return name;
}

}  // namespace mlt
