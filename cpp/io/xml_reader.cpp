// Reads Mitsuba XML, of either dialect, into a tree of nodes.
#include "base/atomic_file.h"
#include "base/text.h"
#include "io/aliases.h"
#include "io/element.h"
#include "io/families.h"
#include "io/load.h"
#include "io/mistakes.h"
#include "io/search_path.h"
#include "io/transform.h"
#include "io/values.h"
#include "io/variables.h"
#include "io/version0.h"
#include "io/xml_document.h"
#include "io/xml_transform.h"

#include <algorithm>
#include <filesystem>

namespace mlt {
namespace fs = std::filesystem;
namespace {

constexpr size_t max_include_depth = 15;
constexpr int max_includes = 10'000;
constexpr size_t max_text = size_t{1} << 28;  ///< Bytes of all files together.
constexpr size_t longest_name = 1000;
constexpr size_t max_attributes = 100;

std::string canonical(const std::string& path) {
  std::error_code error;
  const fs::path result = fs::weakly_canonical(path, error);
  return error ? path : result.string();
}

/// Whether the format is that of Mitsuba 2 or later.
bool is_modern(const std::string& version) {
  return parse_real(version.substr(0, version.find('.'))).value_or(0) >= 2;
}

class XmlReader {
 public:
  XmlReader(const LoadOptions& options, std::vector<std::string>& warnings)
      : variables_(options.defines), warnings_(warnings) {}

  Node read_file(const std::string& path) {
    open_files_ = {canonical(path)};
    const XmlDocument document(text_of(path), path);
    return read_document(document, fs::path(path).parent_path().string());
  }

  Node read_string(const std::string& xml, const std::string& directory) {
    const XmlDocument document(xml, "<string>");
    return read_document(document, directory);
  }

 private:
  /// The text that is being read, and the directories of the files that it names.
  struct Source {
    const XmlDocument& document;
    SearchPath search;
    bool modern;  ///< See is_modern().
  };

  std::string text_of(const std::string& path) {
    std::string text = mlt::read_file(path, max_text);
    text_size_ += text.size();
    if (text_size_ > max_text)
      throw SceneError(fmt::format("{}: with it the files of the scene have more than {} bytes",
                                   path, max_text));
    return text;
  }

  Node read_document(const XmlDocument& document, const std::string& directory) {
    Source source{document, {}, false};
    source.search.prepend(directory);
    const Element root = element(document.root(), source);
    source.modern = is_modern(root.get("version"));
    if (root.tag != "scene" && !is_plugin_family(root.tag)) {
      refuse_element(root.tag, root.get("type"), root.where);
      root.fail("is not a scene; the root element should be <scene>");
    }
    Node node = read_plugin(document.root(), root, source, 1);
    missing_files_.report();
    upgrade_version_0(node, warnings_);
    resolve_aliases(node, aliases_);
    variables_.expect_all_used();
    return node;
  }

  Element element(const pugi::xml_node& node, const Source& source) {
    Element e{node.name(), {source.document.file(), source.document.line(node)}, {}};
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const std::string name = attribute.name();
      if (name == "intent" && !source.modern) continue;  // which selects a conversion from RGB
      if (e.attributes.size() == max_attributes) e.fail("has more than 100 attributes");
      if (e.find(name)) e.fail("has the attribute " + quote(name) + " twice");
      std::string value = variables_.substitute(attribute.value(), e.where);
      const bool is_name = name == "name" || name == "type" || name == "id" || name == "as";
      if (is_name && value.size() > longest_name) e.fail("has a '" + name + "' that is too long");
      if (std::any_of(value.begin(), value.end(), [](unsigned char c) { return c < ' '; }))
        e.fail("has a control character in its attribute " + quote(name));
      e.attributes.emplace_back(name, std::move(value));
    }
    return e;
  }

  Node read_plugin(const pugi::xml_node& xml, const Element& element, Source& source, int depth) {
    Node node;
    node.modern = source.modern;
    node.family = element.tag;
    node.where = element.where;
    node.id = element.get("id");
    node.name = element.get("name");
    element.expect_only({"type", "id", "name", "version"});
    node.type = element.tag == "scene" ? "scene" : element.require("type");
    read_children(xml, node, source, depth);
    return node;
  }

  void read_children(const pugi::xml_node& xml, Node& parent, Source& source, int depth) {
    for (const pugi::xml_node& child : xml.children()) {
      if (child.type() == pugi::node_element) {
        read_child(child, parent, source, depth + 1);
      } else if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
        const Location where{source.document.file(), source.document.line(xml)};
        throw SceneError(at(where, "<{}> contains the text {}; only elements are expected here",
                            xml.name(), quote(trim(child.value()))));
      }
    }
  }

  void read_child(const pugi::xml_node& xml, Node& parent, Source& source, int depth) {
    const Location where{source.document.file(), source.document.line(xml)};
    const std::string tag = xml.name();
    if (depth > max_nesting)
      throw SceneError(at(where, "elements are nested more than {} deep", max_nesting));
    const bool known = is_plugin_family(tag) || is_value_tag(tag) || is_transform_tag(tag) ||
                       std::count(scene_tags().begin(), scene_tags().end(), tag) || tag == "scene";
    const auto refuse_later = [&] {
      parent.children.push_back({tag, xml.attribute("type").value(), "", "", where, {}, {}});
    };
    if (!known && !(tag == "blackbody" && !source.modern))
      return is_refused_element(tag) ? refuse_later() : skip_foreign({tag, where, {}}, parent);

    read_element(xml, element(xml, source), parent, source, depth);
  }

  void read_element(const pugi::xml_node& xml, const Element& e, Node& parent, Source& source,
                    int depth) {
    const std::string& tag = e.tag;
    if (tag == "blackbody") {
      parent.children.push_back(read_blackbody(e));
      return;
    }
    if (tag == "spectrum" && e.find("type")) {
      parent.children.push_back(read_plugin(xml, e, source, depth));
      parent.children.back().family = "texture";
      return;
    }
    if (is_plugin_family(tag)) {
      parent.children.push_back(read_plugin(xml, e, source, depth));
      return;
    }
    if (parent.family == "scene" && (tag == "transform" || tag == "animation"))
      e.fail("has no effect at the top of a scene; put it inside a shape");
    if (tag == "transform") return read_placement(xml, e, parent, source, read_xml_transform);
    if (tag == "animation" && has_colors(xml)) return read_keys(xml, e, parent, source, depth);
    if (tag == "animation") return read_placement(xml, e, parent, source, read_xml_animation);
    for (const pugi::xml_node& child : xml.children())
      if (child.type() != pugi::node_comment) e.fail("should be empty, but has something inside");

    if (tag == "ref") {
      e.expect_only({"id", "name"});
      parent.children.push_back({"ref", e.require("id"), "", e.get("name"), e.where, {}, {}});
    } else if (tag == "default") {
      e.expect_only({"name", "value"});
      if (!e.find("value")) e.require("value");
      variables_.set_default(e.require("name"), e.get("value"));
    } else if (tag == "include") {
      read_include(e, parent, source, depth);
    } else if (tag == "path") {
      e.expect_only({"value"});
      if (parent.family != "scene") e.fail("must stand at the top of the scene");
      source.search.prepend(source.search.find_directory(e.require("value"), e.where));
    } else if (tag == "alias") {
      e.expect_only({"id", "as"});
      if (!aliases_.emplace(e.require("as"), Alias{e.require("id"), e.where}).second)
        e.fail("gives the name " + quote(e.get("as")) + " a second time");
    } else if (is_value_tag(tag)) {
      read_property(e, parent, source);
    } else {
      e.fail(tag == "scene" ? "cannot stand inside another element"
                            : "can only stand inside a <transform>");
    }
  }

  void read_property(const Element& element, Node& parent, const Source& source) {
    const std::string& name = element.require("name");
    if (parent.family == "scene") {
      warnings_.push_back(
          at(element.where, element.title() + " has no effect at the top of a scene"));
      return;
    }
    Value value = read_value(element, source.search);
    if (name == "filename" && element.tag == "string" && reads_a_file(parent.family))
      missing_files_.note(
          [&] { value = source.search.find_file(std::get<std::string>(value), element.where); },
          element.where);
    const double* number = std::get_if<double>(&value);
    // Since Mitsuba 2 it is the same power at all wavelengths; before, it is grey, also of lights.
    if (number && element.tag == "spectrum" && source.modern) value = constant_spectrum(*number);
    parent.properties.push_back({name, std::move(value), element.where});
  }

  /// Reads a <transform> or an <animation>.
  template <class Read>
  void read_placement(const pugi::xml_node& xml, const Element& e, Node& parent,
                      const Source& source, Read&& read) {
    e.expect_only({"name"});
    Value value = read(xml, e, [&](const pugi::xml_node& inner) { return element(inner, source); });
    parent.properties.push_back({e.require("name"), std::move(value), e.where});
  }

  /// Reads an <animation> of colours, numbers or textures.
  void read_keys(const pugi::xml_node& xml, const Element& e, Node& parent, Source& source,
                 int depth) {
    e.expect_only({"name"});
    Node animation{"texture", "animation", "", e.require("name"), e.where, {}, {}};
    const auto read = [&](const pugi::xml_node& inner) { return element(inner, source); };
    const auto add = [&](const pugi::xml_node& key_xml, Element key) {
      animation.children.push_back(take_key(key));
      read_element(key_xml, key, animation.children.back(), source, depth + 2);
    };
    for_each_inside(xml, e, read, "colours with a time", add);
    parent.children.push_back(std::move(animation));
  }

  void read_include(const Element& element, Node& parent, const Source& source, int depth) {
    element.expect_only({"filename", "name"});
    const std::string path = source.search.find_file(element.require("filename"), element.where);
    const std::string identity = canonical(path);
    if (std::count(open_files_.begin(), open_files_.end(), identity))
      element.fail("includes " + path +
                   ", which is being read already: the files include each other");
    if (open_files_.size() > max_include_depth)
      element.fail("is nested more than " + std::to_string(max_include_depth) + " files deep");
    if (++include_count_ > max_includes)
      element.fail("is one of more than " + std::to_string(max_includes) + " includes");

    open_files_.push_back(identity);
    const XmlDocument document(text_of(path), path);
    Source inner{document, source.search, source.modern};
    inner.search.prepend(fs::path(path).parent_path());
    const Element root = this->element(document.root(), inner);
    if (root.find("version")) inner.modern = is_modern(root.get("version"));
    if (root.tag == "scene") {
      read_children(document.root(), parent, inner, depth);
    } else if (is_plugin_family(root.tag)) {
      Node node = read_plugin(document.root(), root, inner, depth);
      if (element.find("name")) node.name = element.get("name");
      parent.children.push_back(std::move(node));
    } else {
      refuse_element(root.tag, root.get("type"), root.where);
      root.fail("cannot be included; the root element should be <scene> or a plug-in");
    }
    open_files_.pop_back();
  }

  void skip_foreign(const Element& element, const Node& parent) {
    const std::string tag = element.tag.substr(0, 80), near = closest(tag, scene_tags());
    if (parent.family != "scene" || !near.empty())
      throw SceneError(at(element.where, "unknown element <{}> in {}{}", tag, parent.family,
                          near.empty() ? "" : "; did you mean <" + near + ">?"));
    warnings_.push_back(
        at(element.where, "the element <{}> is not known here and was skipped", tag));
  }

  Variables variables_;
  std::vector<std::string>& warnings_;
  std::vector<std::string> open_files_;  ///< Each file includes the next.
  int include_count_ = 0;
  size_t text_size_ = 0;
  Aliases aliases_;
  Mistakes missing_files_;
};

}  // namespace

Node read_xml_file(const std::string& path, const LoadOptions& options,
                   std::vector<std::string>& warnings) {
  return XmlReader(options, warnings).read_file(path);
}

Node read_xml_string(const std::string& xml, const std::string& directory,
                     const LoadOptions& options, std::vector<std::string>& warnings) {
  return XmlReader(options, warnings).read_string(xml, directory);
}

}  // namespace mlt
