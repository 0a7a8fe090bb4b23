// <transform>, and <animation>: several of them, or of colours, each with its time.
#pragma once

#include "base/schema.h"
#include "io/element.h"
#include "io/node.h"

#include <functional>
#include <pugixml.hpp>

namespace mlt {

/// Reads the attributes of an element inside.
using ReadElement = std::function<Element(const pugi::xml_node&)>;

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

// Both throw SceneError.
Matrix read_xml_transform(const pugi::xml_node& xml, const Element& element,
                          const ReadElement& read);
Animation read_xml_animation(const pugi::xml_node& xml, const Element& element,
                             const ReadElement& read);

/// Whether an <animation> has colours, numbers or textures, and no transforms.
bool has_colors(const pugi::xml_node& animation);
/// A key of such an animation, of which `key` is to become the value. Throws SceneError.
Node take_key(Element& key);

}  // namespace mlt
