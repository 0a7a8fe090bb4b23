#include "io/parts.h"

#include "scene/medium/medium.h"
#include "scene/shape/shape_reader.h"
#include "scene/texture/animation.h"

namespace mlt {

const Part* PartSource::take(const std::string& key) {
  if (!parts_) return nullptr;
  const auto [first, last] = parts_->equal_range(key);
  for (auto known = first; known != last; ++known)
    if (taken_.insert(&known->second).second) return &known->second;
  return nullptr;
}

ObjectPtr for_scene(const ObjectPtr& object) {
  if (std::dynamic_pointer_cast<ShapeReader>(object)) return nullptr;
  if (std::dynamic_pointer_cast<Bsdf>(object) || std::dynamic_pointer_cast<Texture>(object) ||
      std::dynamic_pointer_cast<Medium>(object) || std::dynamic_pointer_cast<ColorKey>(object))
    return object;
  ObjectPtr copy = object->copy();
  if (const auto shape = std::dynamic_pointer_cast<Shape>(copy))
    shape->set_form(std::dynamic_pointer_cast<Shape>(object));
  return copy;
}

}  // namespace mlt
