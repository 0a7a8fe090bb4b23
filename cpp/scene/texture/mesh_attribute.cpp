// Attributes of a mesh, such as the colours of its vertices.
#include "base/registry.h"
#include "scene/mesh/mesh.h"
#include "scene/shape/shape_reader.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

class MeshAttributeTexture final : public Texture, public ShapeReader {
 public:
  explicit MeshAttributeTexture(Params& params)
      : name_(params.text("name")), scale_(params.real_in("scale", 0, 1e9)) {
    if (name_.rfind("vertex_", 0) != 0 && name_.rfind("face_", 0) != 0)
      params.fail("name", "should begin with 'vertex_' or 'face_'");
  }

  void read_shapes(const std::vector<ShapePtr>& shapes) override {
    ShapeReader::read_shapes(shapes);
    bool any = false;
    for (const ShapePtr& shape : shapes) {
      const Mesh* mesh = shape->as_mesh();
      const MeshAttribute* found = mesh ? mesh->data().find_attribute(name_) : nullptr;
      if (found && found->channels != 1 && found->channels != 3)
        throw SceneError(at(where,
                            "texture 'mesh_attribute': '{}' has {} channels, but only 1 and "
                            "3 make a colour",
                            name_, found->channels));
      any = any || found;
      meshes_.push_back({mesh, found});
    }
    if (!any)
      throw SceneError(at(where, "texture 'mesh_attribute': no mesh of the scene has '{}'", name_));
  }

  /// The attribute; black on shapes without it.
  Spectrum eval(const SurfacePoint& at) const override {
    if (at.shape >= meshes_.size() || !meshes_[at.shape].attribute) return Spectrum(0);
    const auto& [mesh, attribute] = meshes_[at.shape];
    Color value(0);
    if (attribute->on_faces) {
      value = element(*attribute, at.primitive);
    } else {
      const auto& corners = mesh->data().triangles[at.primitive];
      const Vec2 b = barycentrics(*mesh, at);
      value = (1 - b.x - b.y) * element(*attribute, corners[0]) +
              b.x * element(*attribute, corners[1]) + b.y * element(*attribute, corners[2]);
    }
    return spectrum_of(scale_ * glm::max(value, Color(0)), RgbMeaning::reflectance, at.wavelength);
  }

  // The meshes are not known yet when materials are made: attributes are assumed to lie in [0, 1].
  Color mean() const override { return Color(0.5 * scale_); }
  Color maximum() const override { return Color(scale_); }

 private:
  static Color element(const MeshAttribute& attribute, uint32_t index) {
    const float* v = &attribute.values[size_t{index} * attribute.channels];
    return attribute.channels == 1 ? Color(v[0]) : Color(v[0], v[1], v[2]);
  }

  struct Found {
    const Mesh* mesh;
    const MeshAttribute* attribute;
  };

  std::string name_;
  double scale_;
  std::vector<Found> meshes_;  ///< For each shape of the scene.
};

}  // namespace

Plugin texture_mesh_attribute() {
  return make_plugin<MeshAttributeTexture>(
      "texture", "mesh_attribute", "An attribute of the mesh, from its PLY file or an array.",
      {{"name", ParamType::text, no_default,
        "Such as vertex_color (interpolated) or face_color (one for each face)."},
       {"scale", ParamType::real, 1.0, "Multiplies the values."}});
}

}  // namespace mlt
