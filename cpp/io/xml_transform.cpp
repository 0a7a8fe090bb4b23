#include "io/xml_transform.h"

#include "base/text.h"
#include "io/transform.h"

namespace mlt {
namespace {

/// Calls use(xml, element) for all elements inside of one that should have no text.
template <class Use>
void for_each_inside(const pugi::xml_node& xml, const Element& element, const ReadElement& read,
                     const char* expected, Use&& use) {
  for (const pugi::xml_node& child : xml.children()) {
    if (child.type() == pugi::node_element) use(child, read(child));
    if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
      element.fail(fmt::format("contains a text; only {} are expected here", expected));
  }
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
    const std::string& text = key.require("time");
    const auto time = parse_real(text);
    if (!time) key.fail("has the time " + quote(text) + ", but it should be a number");
    animation.push_back({*time, read_xml_transform(key_xml, key, read)});
  };
  for_each_inside(xml, element, read, "<transform>s with a time", add);
  return animation;
}

}  // namespace mlt
