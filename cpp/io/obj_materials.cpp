#include "io/obj_materials.h"

#include "base/atomic_file.h"
#include "base/gzip.h"
#include "base/text.h"
#include "io/mtl_library.h"
#include "io/node_properties.h"
#include "io/search_path.h"
#include "scene/shape/text_scanner.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

namespace mlt {
namespace {

/// What an OBJ file says of materials.
struct NamedMaterials {
  std::vector<std::string> used;  ///< Names of materials with faces; "" before any `usemtl`.
  std::string library;
  Location library_where;
};

NamedMaterials named_materials(const std::string& path) {
  std::string bytes = read_file(path);
  if (is_gzip(bytes)) bytes = unpack_gzip(bytes, path);
  NamedMaterials found;
  std::string current;
  TextScanner scan(bytes, path);
  for (; !scan.at_end(); scan.next_line()) {
    scan.skip_blanks();
    if (scan.at_line_end()) continue;
    const std::string_view keyword = scan.word();
    scan.skip_blanks();
    if (keyword == "usemtl") {
      current = scan.rest_of_line();
    } else if (keyword == "mtllib") {
      found.library_where = {path, scan.line()};
      found.library = scan.rest_of_line();
    } else if (keyword == "f" &&
               std::find(found.used.rbegin(), found.used.rend(), current) == found.used.rend()) {
      found.used.push_back(current);
    }
  }
  return found;
}

std::map<std::string, Node> library_of(const NamedMaterials& materials,
                                       std::vector<std::string>& warnings) {
  if (materials.library.empty()) return {};
  SearchPath search;
  search.prepend(std::filesystem::path(materials.library_where.file).parent_path());
  try {
    return read_mtl_library(search.find_file(materials.library, materials.library_where), warnings);
  } catch (const Error& error) {
    warnings.push_back(std::string(error.what()) + "; its materials are left out");
    return {};
  }
}

/// The BSDFs inside of a shape, taken out of it.
struct Given {
  std::map<std::string, Node> named;
  std::vector<Node> unnamed;  ///< The last one counts.
};

Given take_bsdfs(Node& shape, const std::function<std::string(const Node&)>& family_of) {
  Given given;
  std::vector<Node> others;
  for (Node& child : shape.children) {
    if (family_of(child) != "bsdf")
      others.push_back(std::move(child));
    else if (child.name.empty())
      given.unnamed.push_back(std::move(child));
    else
      given.named[child.name] = std::move(child);
  }
  shape.children = std::move(others);
  return given;
}

Node without_ids(Node node) {
  node.id = "";
  for (Node& child : node.children) child = without_ids(std::move(child));
  return node;
}

}  // namespace

void split_by_material(Node& shape, std::vector<Node>& shapes, std::vector<std::string>& warnings,
                       const std::function<std::string(const Node&)>& family_of) {
  const Node::Property* loads = find_property(shape, "load_materials");
  const bool* loads_library = loads ? std::get_if<bool>(&loads->value) : nullptr;
  const bool reads_library = !loads_library || *loads_library;
  remove_property(shape, "load_materials");
  Given given = take_bsdfs(shape, family_of);
  const std::string file = text_of(shape, "filename");
  if (file.empty() || (given.named.empty() && !given.unnamed.empty())) {
    for (Node& bsdf : given.unnamed) shape.children.push_back(std::move(bsdf));
    shapes.push_back(std::move(shape));
    return;
  }
  const NamedMaterials materials = named_materials(file);
  std::map<std::string, Node> library;
  if (given.unnamed.empty() && reads_library) library = library_of(materials, warnings);
  for (const auto& [name, bsdf] : given.named)
    if (!std::count(materials.used.begin(), materials.used.end(), name))
      warnings.push_back(
          at(bsdf.where, "the file {} has no faces of the material {}", quote(file), quote(name)));
  for (const std::string& material : materials.used) {
    Node part = std::exchange(shape, without_ids(shape));  // an id stands once
    if (materials.used.size() > 1) set_property(part, "usemtl", material);
    const auto named = given.named.find(material);
    const auto in_library = library.find(material);
    if (named != given.named.end())
      part.children.push_back(named->second);
    else if (!given.unnamed.empty())
      part.children.push_back(
          std::exchange(given.unnamed.back(), without_ids(given.unnamed.back())));
    else if (in_library != library.end())
      part.children.push_back(in_library->second);
    shapes.push_back(std::move(part));
  }
  if (materials.used.empty()) shapes.push_back(std::move(shape));  // whose reader will complain
}

}  // namespace mlt
