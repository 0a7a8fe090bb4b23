// Geometry with a material. A shape is a triangle mesh (most of them) or an analytic form.
#pragma once

#include "base/object.h"
#include "scene/bsdf/bsdf.h"
#include "scene/emitter/emitter.h"
#include "scene/ray.h"
#include "scene/surface_point.h"

#include <memory>

namespace mlt {

class AnalyticShape;
class Instance;
class Mesh;

class Shape : public Object {
 public:
  /// The full description of a hit: position (refined in double precision along the ray), normals,
  /// frame and uv. `at.shape` is set by the caller.
  virtual void surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const = 0;
  /// Whether the frame's s axis follows dp/du; else it is Frame::around the normal.
  virtual bool has_tangent() const { return true; }

  virtual double area() const = 0;
  /// Samples a position uniformly over the area; pdf = 1 / area().
  virtual PositionSample sample_position(const Vec2& u) const = 0;
  virtual Vec2 invert_position(const SurfacePoint& at) const = 0;

  /// Samples a position for next-event estimation at `from` (density in area measure).
  virtual PositionSample sample_direct(const Vec3& /*from*/, const Vec2& u) const {
    return sample_position(u);
  }
  virtual double pdf_direct(const Vec3& /*from*/, const SurfacePoint& /*at*/) const {
    return 1 / area();
  }
  virtual Vec2 invert_direct(const Vec3& /*from*/, const SurfacePoint& at) const {
    return invert_position(at);
  }

  /// Derivatives of the position by the texture coordinates, in world space.
  struct UvTangents {
    Vec3 du, dv;
  };
  virtual UvTangents uv_tangents(const SurfacePoint& at) const {
    return {at.shading.s, at.shading.t};
  }

  /// Axis-aligned bounding box.
  virtual void bounds(Vec3& low, Vec3& high) const = 0;

  // Casts to the kinds of shapes that the accelerator supports.
  virtual const Mesh* as_mesh() const { return nullptr; }
  virtual const AnalyticShape* as_analytic() const { return nullptr; }
  virtual const Instance* as_instance() const { return nullptr; }

  /// The media that the shape bounds; a shape with neither is in one.
  struct BoundedMedia {
    MediumPtr interior, exterior;
  };
  const BoundedMedia& media() const { return media_; }
  void set_media(BoundedMedia media) { media_ = std::move(media); }

  /// Which of several solids that overlap is there: the one with the highest (Solids).
  const std::optional<int64_t>& priority() const { return priority_; }
  void set_priority(std::optional<int64_t> priority) { priority_ = priority; }

  const Bsdf& bsdf() const { return *bsdf_; }
  const BsdfPtr& bsdf_ptr() const { return bsdf_; }
  const Emitter* emitter() const { return emitter_.get(); }
  const EmitterPtr& emitter_ptr() const { return emitter_; }
  void set_bsdf(BsdfPtr bsdf) { bsdf_ = std::move(bsdf); }
  void set_emitter(EmitterPtr emitter) { emitter_ = std::move(emitter); }
  /// The shape that this one is a copy of, or nullptr.
  const std::shared_ptr<const Shape>& form() const { return form_; }
  void set_form(std::shared_ptr<const Shape> form) { form_ = std::move(form); }
  uint32_t index() const { return index_; }
  void set_index(uint32_t index) { index_ = index; }

 protected:
  BsdfPtr bsdf_;
  EmitterPtr emitter_;
  BoundedMedia media_;
  std::optional<int64_t> priority_;
  uint32_t index_ = SurfacePoint::no_shape;

 private:
  std::shared_ptr<const Shape> form_;
};

using ShapePtr = std::shared_ptr<Shape>;

}  // namespace mlt
