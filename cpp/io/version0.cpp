#include "io/version0.h"

#include "base/text.h"
#include "io/node_properties.h"
#include "io/obj_materials.h"

#include <map>

namespace mlt {
namespace {

/// Coefficients of measured materials are per millimetre; as presets, 0.6 takes them times this.
constexpr double preset_scale = 100;
/// The coefficients of skin1 (Jensen et al. 2001), the preset that fills in what is not given.
constexpr Triple skin_scattering{74, 88, 101}, skin_absorption{3.2, 17, 48};

/// 0.6 scales reflectances above 1 to this.
constexpr double greatest_reflectance = 0.99;

Triple per_channel(const Triple& a, const Triple& b, double (*f)(double, double)) {
  return {f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2])};
}
double sum(double a, double b) { return a + b; }
double first_share(double a, double b) { return a / (a + b); }

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// The greatest component of a colour, or 0 for a value that is none.
double greatest_of(const Value& value) {
  double most = 0;
  if (const auto* number = std::get_if<double>(&value)) most = *number;
  if (const auto* integer = std::get_if<int64_t>(&value)) most = static_cast<double>(*integer);
  if (const auto* rgb = std::get_if<Triple>(&value))
    most = *std::max_element(rgb->begin(), rgb->end());
  if (const auto* table = std::get_if<WavelengthTable>(&value))
    for (const auto& [nm, at_nm] : *table) most = std::max(most, at_nm);
  return most;
}

void scale(Value& value, double factor) {
  if (auto* number = std::get_if<double>(&value)) *number *= factor;
  if (const auto* integer = std::get_if<int64_t>(&value))
    value = factor * static_cast<double>(*integer);
  if (auto* rgb = std::get_if<Triple>(&value))
    for (double& channel : *rgb) channel *= factor;
  if (auto* table = std::get_if<WavelengthTable>(&value))
    for (auto& [nm, at_nm] : *table) at_nm *= factor;
}

void upgrade_conductor(Node& node) {
  for (const char* name : {"material", "eta", "k"})
    if (find_property(node, name)) return;
  set_property(node, "material", std::string("Cu"));
}

void upgrade_homogeneous(Node& node) {
  const auto given = [&](const char* name) { return find_property(node, name) != nullptr; };
  const bool by_parts = given("sigma_s") || given("sigma_a");
  const bool by_albedo = given("sigma_t") || given("albedo");
  if (by_parts) {
    if (!given("sigma_a")) set_property(node, "sigma_a", skin_absorption);
    if (!given("sigma_s")) set_property(node, "sigma_s", skin_scattering);
  } else if (by_albedo) {
    if (!given("sigma_t"))
      set_property(node, "sigma_t", per_channel(skin_scattering, skin_absorption, sum));
    if (!given("albedo"))
      set_property(node, "albedo", per_channel(skin_scattering, skin_absorption, first_share));
  } else {
    const std::string material = text_of(node, "material");
    set_property(node, "material", material.empty() ? "skin1" : lower_case(material));
    set_property(node, "scale", preset_scale * number_of(node, "scale").value_or(1));
  }
}

class Upgrade {
 public:
  Upgrade(const Node& root, std::vector<std::string>& warnings) : warnings_(warnings) {
    note_families(root);
  }

  void visit(Node& node) {
    std::vector<Node> children;
    for (Node& child : node.children)
      if (!child.modern && child.family == "shape" && child.type == "obj")
        split_by_material(child, children, warnings_, [&](const Node& n) { return family_of(n); });
      else
        children.push_back(std::move(child));
    node.children = std::move(children);
    for (Node& child : node.children) visit(child);
    if (!node.modern) upgrade(node);
  }

 private:
  void note_families(const Node& node) {
    if (!node.id.empty()) families_.emplace(node.id, node.family);
    for (const Node& child : node.children) note_families(child);
  }
  /// The family of a node, or of the one that it refers to.
  std::string family_of(const Node& node) const {
    if (node.family != "ref") return node.family;
    const auto found = families_.find(node.type);
    return found == families_.end() ? "" : found->second;
  }
  bool has(const Node& node, const std::string& family) const {
    return std::any_of(node.children.begin(), node.children.end(),
                       [&](const Node& child) { return family_of(child) == family; });
  }

  void upgrade(Node& node) {
    if (node.family == "bsdf") upgrade_bsdf(node);
    if (node.family == "shape") upgrade_shape(node);
    if (node.family == "medium" && node.type == "homogeneous") upgrade_homogeneous(node);
    if (node.family == "medium" && node.type == "heterogeneous") upgrade_heterogeneous(node);
    if (node.family == "volume") upgrade_volume(node);
    if (node.family == "texture" && node.type == "vertexcolors") {
      node.type = "mesh_attribute";
      set_property(node, "name", std::string("vertex_color"));
    }
  }

  void upgrade_bsdf(Node& node) {
    if (node.type == "conductor" || node.type == "roughconductor") upgrade_conductor(node);
    const std::string distribution = text_of(node, "distribution");
    if (distribution == "phong" || distribution == "as") {
      warn(node, "the distribution '{}' is taken as 'beckmann'", distribution);
      set_property(node, "distribution", std::string("beckmann"));
    }
    for (const char* name : {"reflectance", "specular_reflectance", "specular_transmittance",
                             "diffuse_reflectance", "transmittance", "diffuse_transmittance"})
      conserve_energy(node, {name});
    if (node.type == "phong" || node.type == "ward")
      conserve_energy(node, {"specular_reflectance", "diffuse_reflectance"});
  }

  /// Scales reflectances that are more than 1 together.
  void conserve_energy(Node& node, std::initializer_list<const char*> names) {
    double most = 0;
    for (const char* name : names)
      if (const Node::Property* found = find_property(node, name))
        most += greatest_of(found->value);
    if (!(most > 1)) return;
    warn(node, "'{}' reaches {:g}, and is scaled to {:g}, as Mitsuba 0.6 does", *names.begin(),
         most, greatest_reflectance);
    for (const char* name : names)
      if (Node::Property* found = find_property(node, name))
        scale(found->value, greatest_reflectance / most);
  }

  /// A boundary of a medium without a BSDF is invisible.
  void upgrade_shape(Node& node) {
    if (has(node, "medium") && !has(node, "bsdf") && !has(node, "emitter"))
      node.children.push_back({"bsdf", "null", "", "", node.where, {}, {}});
  }

  void upgrade_heterogeneous(Node& node) {
    remove_property(node, "method");
    if (Node::Property* density = find_property(node, "density")) density->name = "sigma_t";
    auto& children = node.children;
    for (Node& child : children)
      if (child.name == "density") child.name = "sigma_t";
    const auto turned = [&](const Node& child) { return child.name == "orientation"; };
    if (std::any_of(children.begin(), children.end(), turned))
      warn(node, "the orientation of a medium is left out");
    children.erase(std::remove_if(children.begin(), children.end(), turned), children.end());
  }

  void upgrade_volume(Node& node) {
    if (node.type == "gridvolume" && !find_property(node, "use_grid_bbox"))
      set_property(node, "use_grid_bbox", true);
    if (node.type != "volcache" || node.children.size() != 1) return;
    Node cached = std::move(node.children[0]);
    cached.name = node.name;
    if (!node.id.empty()) cached.id = node.id;
    node = std::move(cached);
  }

  template <class... Args>
  void warn(const Node& node, const char* text, const Args&... args) {
    warnings_.push_back(at(node.where, "{} '{}': {}", node.family, node.type,
                           fmt::format(fmt::runtime(text), args...)));
  }

  std::map<std::string, std::string> families_;  ///< Families of nodes by their ids.
  std::vector<std::string>& warnings_;
};

}  // namespace

Node read_blackbody(const Element& e) {
  e.expect_only({"name", "temperature", "scale"});
  Node node{"texture", "blackbody", "", e.require("name"), e.where, {}, {}};
  for (const char* name : {"temperature", "scale"}) {
    if (!e.find(name) && name == std::string("scale")) continue;
    std::string text = e.require(name);
    if (text.back() == 'K' || text.back() == 'k') text.pop_back();
    const auto number = parse_real(text);
    if (!number) e.fail(fmt::format("has {} = {}, but it should be a number", name, quote(text)));
    node.properties.push_back({name, *number, e.where});
  }
  return node;
}

void upgrade_version_0(Node& tree, std::vector<std::string>& warnings) {
  Upgrade(tree, warnings).visit(tree);
}

}  // namespace mlt
