#include "io/mtl_library.h"

#include "base/atomic_file.h"
#include "base/text.h"
#include "image/srgb.h"
#include "io/search_path.h"
#include "scene/shape/text_scanner.h"

#include <filesystem>

namespace mlt {
namespace {

constexpr uint64_t most_bytes = uint64_t{1} << 28;

/// Models of illumination, by their numbers in MTL files.
bool is_glossy(int64_t model) { return model == 2; }
bool is_glass(int64_t model) { return model == 4 || model == 6 || model == 7 || model == 9; }
bool is_metal(int64_t model) { return model == 5 || model == 8; }

bool is_black(const Triple& rgb) { return rgb == Triple{}; }

struct Material {
  Location where;
  Triple diffuse{}, specular{};
  double exponent = 0, opacity = 1;
  int64_t model = 0;
  std::string diffuse_map, specular_map, bump_map, opacity_map;

  Node bsdf() const {
    Node made = without_holes();
    if (!bump_map.empty()) made = node("bumpmap", {}, {map("", bump_map, true), std::move(made)});
    if (!opacity_map.empty())
      return node("mask", {}, {map("opacity", opacity_map), std::move(made)});
    if (opacity < 1) return node("mask", {{"opacity", opacity, where}}, {std::move(made)});
    return made;
  }

 private:
  Node without_holes() const {
    if (is_glass(model)) return node("dielectric", {}, {});
    if (is_metal(model)) return node("conductor", {{"material", std::string("Al"), where}}, {});
    const bool shines = !(is_black(specular) && specular_map.empty()) && exponent > 0;
    const bool glossy = is_glossy(model) && shines;
    Node made = node(glossy ? "phong" : "diffuse", {}, {});
    set(made, glossy ? "diffuse_reflectance" : "reflectance", diffuse, diffuse_map);
    if (!glossy) return made;
    set(made, "specular_reflectance", specular, specular_map);
    made.properties.push_back({"exponent", exponent, where});
    return made;
  }

  Node node(const char* type, std::vector<Node::Property> properties,
            std::vector<Node> children) const {
    return {"bsdf", type, "", "", where, std::move(properties), std::move(children), false};
  }
  Node map(const char* name, const std::string& file, bool raw = false) const {
    return {"texture", "bitmap", "", name, where, {{"filename", file, where}, {"raw", raw, where}},
            {},        false};
  }
  void set(Node& bsdf, const char* name, const Triple& color, const std::string& file) const {
    if (file.empty())
      bsdf.properties.push_back({name, color, where});
    else
      bsdf.children.push_back(map(name, file));
  }
};

class MtlReader {
 public:
  MtlReader(const std::string& path, std::vector<std::string>& warnings)
      : path_(path), text_(read_file(path, most_bytes)), scan_(text_, path_), warnings_(warnings) {
    search_.prepend(std::filesystem::path(path).parent_path());
  }

  std::map<std::string, Node> read() {
    std::map<std::string, Node> found;
    for (; !scan_.at_end(); scan_.next_line()) {
      scan_.skip_blanks();
      if (scan_.at_line_end()) continue;
      const std::string_view keyword = scan_.word();
      scan_.skip_blanks();
      if (keyword == "newmtl") {
        keep(found);
        name_ = scan_.rest_of_line();
        material_ = Material();
        material_.where = {path_, scan_.line()};
      } else {
        read_statement(keyword);
      }
    }
    keep(found);
    return found;
  }

 private:
  void keep(std::map<std::string, Node>& found) const {
    if (!name_.empty()) found[name_] = material_.bsdf();
  }

  void read_statement(std::string_view keyword) {
    if (keyword == "Kd") material_.diffuse = color();
    if (keyword == "Ks") material_.specular = color();
    if (keyword == "Ns") material_.exponent = number();
    if (keyword == "d") material_.opacity = number();
    if (keyword == "illum") material_.model = scan_.integer("a model of illumination");
    if (keyword == "map_Kd") material_.diffuse_map = texture();
    if (keyword == "map_Ks") material_.specular_map = texture();
    if (keyword == "map_d") material_.opacity_map = texture();
    if (keyword == "bump") material_.bump_map = texture();
  }

  double number() {
    scan_.skip_blanks();
    return scan_.real("a number");
  }
  /// 0.6 takes colours as sRGB-encoded.
  Triple color() {
    Triple rgb;
    for (double& channel : rgb) channel = srgb_to_linear(number());
    return rgb;
  }
  /// The file of a texture, or "", with a warning, where there is none.
  std::string texture() {
    const Location where{path_, scan_.line()};
    try {
      return search_.find_file(scan_.rest_of_line(), where);
    } catch (const Error& error) {
      warnings_.push_back(std::string(error.what()) + "; the material has no such texture");
      return "";
    }
  }

  std::string path_, text_;
  TextScanner scan_;
  SearchPath search_;
  std::string name_;
  Material material_;
  std::vector<std::string>& warnings_;
};

}  // namespace

std::map<std::string, Node> read_mtl_library(const std::string& path,
                                             std::vector<std::string>& warnings) {
  return MtlReader(path, warnings).read();
}

}  // namespace mlt
