// The properties of a PLY element that are attributes of the mesh: red, green and blue (or r, g, b)
// make "color"; properties whose names differ after the last underscore alone, such as heat_0 or
// flow_x, flow_y, flow_z, make one of the name before it. Other names are passed over, as by
// Mitsuba 3.
#pragma once

#include "scene/mesh/mesh_data.h"
#include "scene/shape/ply_header.h"

namespace mlt {

class PlyAttributes {
 public:
  /// `prefix`: "vertex_" or "face_".
  PlyAttributes(const PlyElement& element, const std::string& prefix);

  bool takes(size_t property) const { return channels_[property].attribute != none; }
  /// Sets the value of a property. Integer colours become fractions of their largest value.
  void put(size_t property, double value) {
    const Channel& channel = channels_[property];
    row_[channel.position] = static_cast<float>(value * channel.scale);
  }
  /// Adds the values that were put to the next `count` vertices or triangles.
  void end_row(size_t count);

  const std::vector<MeshAttribute>& attributes() const { return attributes_; }

 private:
  static constexpr size_t none = ~size_t{0};
  /// The most channels; more are ignored: faces with many corners repeat them in each triangle.
  static constexpr size_t max_channels = 16;
  struct Channel {
    size_t attribute = none, position = 0;
    double scale = 1;
  };
  void add(size_t property, const std::string& name, double scale);

  std::string prefix_;
  std::vector<Channel> channels_;  ///< For each property.
  std::vector<float> row_;         ///< The channels of all attributes, one after the other.
  std::vector<MeshAttribute> attributes_;
};

}  // namespace mlt
