// <transform>, and <animation>: several of them, each with its time.
#pragma once

#include "base/schema.h"
#include "io/element.h"

#include <functional>
#include <pugixml.hpp>

namespace mlt {

/// Reads the attributes of an element inside.
using ReadElement = std::function<Element(const pugi::xml_node&)>;

// Both throw SceneError.
Matrix read_xml_transform(const pugi::xml_node& xml, const Element& element,
                          const ReadElement& read);
Animation read_xml_animation(const pugi::xml_node& xml, const Element& element,
                             const ReadElement& read);

}  // namespace mlt
