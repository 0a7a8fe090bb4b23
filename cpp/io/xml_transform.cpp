#include "io/xml_transform.h"

#include "base/text.h"
#include "io/transform.h"
#include "io/values.h"

namespace mlt {
namespace {

double time_of(const Element& key) {
  const std::string& text = key.require("time");
  const auto time = parse_real(text);
  if (!time) key.fail("has the time " + quote(text) + ", but it should be a number");
  return *time;
}

/// The elements that a key of an animated texture may be.
bool is_color_tag(const std::string& tag) {
  return is_value_tag(tag) || tag == "texture" || tag == "ref";
}

}  // namespace

Matrix read_xml_transform(const pugi::xml_node& xml, const Element& element,
                          const ReadElement& read) {
  std::vector<Element> steps;
  for_each_inside(xml, element, read, "steps such as <translate>",
                  [&](const pugi::xml_node&, Element step) { steps.push_back(std::move(step)); });
  return read_transform(steps);
}

Animation read_xml_animation(const pugi::xml_node& xml, const Element& element,
                             const ReadElement& read) {
  Animation animation;
  const auto add = [&](const pugi::xml_node& key_xml, const Element& key) {
    if (key.tag != "transform") key.fail("does not belong in an <animation>; give <transform>s");
    key.expect_only({"time"});
    animation.push_back({time_of(key), read_xml_transform(key_xml, key, read)});
  };
  for_each_inside(xml, element, read, "<transform>s with a time", add);
  return animation;
}

bool has_colors(const pugi::xml_node& animation) {
  const auto is_element = [](const auto& child) { return child.type() == pugi::node_element; };
  const std::string first = animation.find_child(is_element).name();
  return is_color_tag(first);
}

Node take_key(Element& key) {
  if (!is_color_tag(key.tag)) key.fail("does not belong in an <animation> of colours");
  const double time = time_of(key);
  if (key.find("name")) key.fail("should have no name, since it is a key of an <animation>");
  for (auto& [name, text] : key.attributes)
    if (name == "time") std::tie(name, text) = std::pair("name", "value");
  return {"texture", "key", "", "", key.where, {{"time", time, key.where}}, {}};
}

}  // namespace mlt
