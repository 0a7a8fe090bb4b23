#include "scene/shape/ply_attributes.h"

#include <cmath>

namespace mlt {
namespace {

double largest(PlyType type) {
  const int bits = 8 * static_cast<int>(size_of(type));
  const bool is_signed = type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
  return std::ldexp(1, is_signed ? bits - 1 : bits) - 1;
}

}  // namespace

PlyAttributes::PlyAttributes(const PlyElement& element, const std::string& prefix)
    : prefix_(prefix), channels_(element.properties.size()) {
  const int colour[] = {element.find({"red", "r"}), element.find({"green", "g"}),
                        element.find({"blue", "b"})};
  const auto usable = [&](int i) {
    return i >= 0 && !element.properties[static_cast<size_t>(i)].list;
  };
  if (usable(colour[0]) && usable(colour[1]) && usable(colour[2]))
    for (const int i : colour) {
      const PlyType type = element.properties[static_cast<size_t>(i)].type;
      add(static_cast<size_t>(i), "color", is_integer(type) ? 1 / largest(type) : 1);
    }
  for (size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    const size_t end = property.name.rfind('_');
    const bool reserved = property.name == "texture_u" || property.name == "texture_v";
    if (property.list || reserved || end == std::string::npos || end == 0) continue;
    add(i, property.name.substr(0, end), 1);
  }
}

void PlyAttributes::add(size_t property, const std::string& name, double scale) {
  if (row_.size() == max_channels) return;
  const std::string full = prefix_ + name;
  const bool on_faces = prefix_ == "face_";
  if (attributes_.empty() || attributes_.back().name != full)
    attributes_.push_back({full, on_faces, 0, {}});
  ++attributes_.back().channels;
  channels_[property] = {attributes_.size() - 1, row_.size(), scale};
  row_.push_back(0);
}

void PlyAttributes::end_row(size_t count) {
  auto from = row_.begin();
  for (MeshAttribute& attribute : attributes_) {
    const auto to = from + attribute.channels;
    for (size_t i = 0; i < count; ++i) attribute.values.insert(attribute.values.end(), from, to);
    from = to;
  }
}

}  // namespace mlt
