#include "scene/instance.h"

#include "base/params.h"
#include "scene/mesh.h"
#include "scene/texture.h"

namespace mlt {
namespace {

Vec3 largest(const Vec3& low, const Vec3& high) { return glm::max(glm::abs(low), glm::abs(high)); }

/// Whether it turns, mirrors and scales, and no more.
bool is_similarity(const Mat3& m) {
  const Mat3 gram = glm::transpose(m) * m;
  const double scale = gram[0][0];
  double deviation = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      deviation = std::max(deviation, std::abs(gram[i][j] - (i == j ? scale : 0)));
  return deviation < 1e-9 * scale;
}

Mat3 absolute(const Mat3& m) { return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])}; }

ShapeGroupPtr only_group(Params& params) {
  const auto groups = params.objects<ShapeGroup>();
  if (groups.size() != 1)
    params.fail(fmt::format("refers to {} shape groups, but should refer to one", groups.size()));
  for (const char* family : {"bsdf", "emitter"})
    if (params.has(family))
      params.fail(
          fmt::format("cannot have a {} of its own; put it on the shapes of the group", family));
  return groups.front();
}

}  // namespace

ShapeGroup::ShapeGroup(Params& params) : shapes_(params.objects<Shape>()) {
  if (!params.objects<ShapeGroup>().empty())
    params.fail("contains another group, but groups cannot be nested");
  if (shapes_.empty()) params.fail("contains no shapes");
  for (const ShapePtr& shape : shapes_) {
    if (shape->as_instance())
      throw SceneError(at(shape->where, "an instance cannot be in a group: they cannot be nested"));
    if (shape->emitter())
      throw SceneError(
          at(shape->where, "a shape that emits cannot be in a group; put it beside it"));
    Vec3 low, high;
    shape->bounds(low, high);
    low_ = glm::min(low_, low);
    high_ = glm::max(high_, high);
  }
}

Instance::Instance(Params& params)
    : group_(only_group(params)),
      to_world_(matrix_param(params, "to_world")),
      linear_(to_world_),
      inverse_(glm::inverse(linear_)),
      offset_(to_world_[3]) {
  if (!is_affine(to_world_) || is_singular(to_world_))
    params.fail("to_world", "is singular or has a perspective");
  keeps_angles_ = is_similarity(linear_);
  extent_ = rounding_scale();
}

void Instance::surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const {
  const Shape& shape = *group_->shapes()[hit.member];
  const Vec3 d = inverse_ * ray.d;
  const double stretch = length(d);
  shape.surface_point({inverse_ * (ray.o - offset_), d / stretch, ray.time},
                      {hit.t * stretch, shape.index(), hit.primitive, hit.u, hit.v}, at);
  at.shape = shape.index();
  at.instance = index();
  move_to_world(shape, at);
}

void Instance::move_to_world(const Shape& shape, SurfacePoint& at) const {
  // dp/du, of which the frame has the part across n, lies in the surface, across ng.
  const Frame& f = at.shading;
  const Vec3 dp_du = f.s - f.n * (dot(at.ng, f.s) / dot(at.ng, f.n));
  const Vec3 ng = normalize(at.ng * inverse_);
  Vec3 n = normalize(f.n * inverse_);
  if (const Mesh* mesh = shape.as_mesh(); mesh && !keeps_angles_)
    n = mesh->moved_normal(at, inverse_).value_or(ng);
  at.shading = shape.has_tangent() ? Frame::around(n, linear_ * dp_du) : Frame::around(n);
  at.ng = ng * std::copysign(1.0, dot(ng, n));
  at.p = linear_ * at.p + offset_;
  at.extent = extent_;
}

SurfacePoint Instance::in_group(SurfacePoint at) const {
  at.p = inverse_ * (at.p - offset_);
  at.ng = normalize(at.ng * linear_);
  at.shading = Frame::around(normalize(at.shading.n * linear_), inverse_ * at.shading.s);
  return at;
}

/// To which coordinates the accelerator's rounding is relative: it computes inverse (o - offset) in
/// the group's space, where an error e becomes linear e.
double Instance::rounding_scale() const {
  Vec3 low, high;
  bounds(low, high);
  const Vec3 moved = absolute(inverse_) * glm::max(largest(low, high), glm::abs(offset_));
  return max_component(absolute(linear_) * glm::max(largest(group_->low(), group_->high()), moved));
}

void Instance::bounds(Vec3& low, Vec3& high) const {
  const Vec3 center = linear_ * (0.5 * (group_->low() + group_->high())) + offset_;
  const Vec3 half = absolute(linear_) * (0.5 * (group_->high() - group_->low()));
  low = center - half;
  high = center + half;
}

}  // namespace mlt
