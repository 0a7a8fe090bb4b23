// In the frame of the cylinder a line passes the axis at the distance |o x d| / |d|, taken in the
// xy plane. Written with it, the discriminant is a product of a sum and a difference of lengths,
// and the product of the roots is another: nothing cancels for lines that start on the surface.
#include "scene/shape/cylinder.h"

#include "math/warp.h"
#include "scene/mesh/mesh_data.h"
#include "scene/shape/common.h"
#include "scene/texture/texture.h"
#include "scene/transform/orientation.h"
#include "scene/transform/transform_params.h"

namespace mlt {

Cylinder::Cylinder(const Vec3& base, const Frame& frame, double radius, double length,
                   bool flip_normals)
    : base_(base), frame_(frame), radius_(radius), length_(length), side_(flip_normals ? -1 : 1) {
  set_extent();
}

std::optional<Cylinder::Roots> Cylinder::roots(const Vec3& world_o, const Vec3& world_d) const {
  const Vec3 o = frame_.to_local(world_o - base_), d = frame_.to_local(world_d);
  const double a = d.x * d.x + d.y * d.y;
  if (!(a > 0)) return std::nullopt;
  const double reach = radius_ * std::sqrt(a), pass = std::abs(o.x * d.y - o.y * d.x);
  if (pass > reach) return std::nullopt;
  const double b = -(o.x * d.x + o.y * d.y);
  const double q = b + std::copysign(std::sqrt((reach - pass) * (reach + pass)), b);
  const double distance = std::sqrt(o.x * o.x + o.y * o.y);
  const double one = q / a;
  const double other = q == 0 ? 0 : (distance - radius_) * (distance + radius_) / q;
  const double near = std::min(one, other), far = std::max(one, other);
  const auto counts = [&](double t) {
    const double z = o.z + t * d.z;
    return z >= 0 && z <= length_;
  };
  return Roots{near, far, counts(near), counts(far)};
}

std::optional<double> Cylinder::intersect(const Vec3& o, const Vec3& d, double t_min,
                                          double t_max) const {
  const std::optional<Roots> t = roots(o, d);
  return t ? t->nearest(t_min, t_max) : std::nullopt;
}

void Cylinder::surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const {
  const std::optional<Roots> exact = roots(ray.o, ray.d);
  const double t = exact ? exact->meant_by(hit.t) : hit.t;
  const Vec3 q = frame_.to_local(ray.o + ray.d * t - base_);
  at = point(normalize(Vec2(q)), std::min(std::max(q.z, 0.0), length_));
}

SurfacePoint Cylinder::point(const Vec2& outward, double z) const {
  const Vec3 n = frame_.s * outward.x + frame_.t * outward.y, ng = n * side_;
  const Vec3 s = frame_.t * outward.x - frame_.s * outward.y;
  return point_at(base_ + n * radius_ + frame_.n * z, ng, {s, cross(ng, s), ng},
                  {turns(outward.x, outward.y), z / length_});
}

Shape::UvTangents Cylinder::uv_tangents(const SurfacePoint& at) const {
  return {at.shading.s * (2 * pi * radius_), frame_.n * length_};
}

PositionSample Cylinder::sample_position(const Vec2& u) const {
  const SinCos phi = sincos_turns(u.y);
  return {point({phi.cos, phi.sin}, u.x * length_), 1 / area()};
}

Vec2 Cylinder::invert_position(const SurfacePoint& at) const {
  const Vec3 q = frame_.to_local(at.p - base_);
  return {std::min(std::max(q.z / length_, 0.0), 1 - 0x1p-53), turns(q.x, q.y)};
}

void Cylinder::bounds(Vec3& low, Vec3& high) const {
  const Vec3 reach = glm::sqrt(frame_.s * frame_.s + frame_.t * frame_.t) * radius_;
  const Vec3 end = base_ + frame_.n * length_;
  low = glm::min(base_, end) - reach;
  high = glm::max(base_, end) + reach;
}

namespace {

/// A circle whose two radii differ by more than this is an ellipse, not a rounded circle.
constexpr double max_eccentricity = 1e-3;

ObjectPtr create_cylinder(Params& params) {
  const Mat4 to_world = matrix_param(params, "to_world");
  const Vec3 p0 = vector_param(params, "p0"), p1 = vector_param(params, "p1");
  const double radius = params.real("radius");
  if (!(radius > 0)) params.fail("radius", "must be positive");
  const double height = length(p1 - p0);
  if (!(height > 0)) params.fail("p1", "is the same point as 'p0', so the cylinder has no length");
  if (!is_affine(to_world)) params.fail("to_world", "is no affine map");

  const Frame object = Frame::around((p1 - p0) / height);
  const Vec3 x = transform_vector(to_world, object.s) * radius;
  const Vec3 y = transform_vector(to_world, object.t) * radius;
  const Vec3 z = transform_vector(to_world, object.n) * height;
  const Vec3 base = transform_point(to_world, p0);
  const Frame frame =
      orientation(params, "to_world", {Vec4(x, 0), Vec4(y, 0), Vec4(z, 0), Vec4(base, 1)});
  const double rx = length(x), ry = length(y);
  if (std::abs(rx - ry) > max_eccentricity * rx)
    params.fail("to_world",
                "makes the circle of this cylinder an ellipse; both axes across it must have the "
                "same scale (use a mesh instead)");
  auto cylinder = std::make_shared<Cylinder>(base, frame, 0.5 * (rx + ry), length(z),
                                             params.boolean("flip_normals"));
  cylinder->where = params.where();
  return cylinder;
}

}  // namespace

Plugin shape_cylinder() {
  return {shape_schema(
              "cylinder", "The side of a cylinder, open at both ends.",
              {{"p0", ParamType::point, Triple{0, 0, 0}, "Where its axis begins, in object space."},
               {"p1", ParamType::point, Triple{0, 0, 1}, "Where its axis ends."},
               {"radius", ParamType::real, 1.0, "In object space."}}),
          create_cylinder};
}

}  // namespace mlt
