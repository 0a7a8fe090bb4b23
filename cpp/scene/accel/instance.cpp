#include "scene/accel/instance.h"

#include "base/params.h"
#include "scene/mesh/mesh.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

Vec3 largest(const Vec3& low, const Vec3& high) { return glm::max(glm::abs(low), glm::abs(high)); }

/// Whether it only rotates, mirrors and scales uniformly.
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

Motion checked_motion(Params& params) {
  const Motion motion = motion_param(params, "to_world");
  for (const Mat4& m : motion.steps())
    if (!is_affine(m) || is_singular(m))
      params.fail("to_world", "is singular or has a perspective");
  return motion;
}

}  // namespace

ShapeGroup::ShapeGroup(Params& params) {
  const auto shapes = params.objects<Shape>();
  if (!params.objects<ShapeGroup>().empty())
    params.fail("contains another group, but groups cannot be nested");
  if (shapes.empty()) params.fail("contains no shapes");
  for (const ShapePtr& shape : shapes) {
    if (shape->as_instance())
      throw SceneError(at(shape->where, shape->type == "instance"
                                            ? "an instance cannot be in a group: they cannot be "
                                              "nested"
                                            : "a shape that moves cannot be in a group; move the "
                                              "instances of the group"));
    if (shape->emitter())
      throw SceneError(
          at(shape->where, "a shape that emits cannot be in a group; put it beside it"));
    add(shape);
  }
}

void ShapeGroup::add(const ShapePtr& shape) {
  Vec3 low, high;
  shape->bounds(low, high);
  low_ = glm::min(low_, low);
  high_ = glm::max(high_, high);
  shapes_.push_back(shape);
}

Instance::Instance(Params& params) : Instance(only_group(params), checked_motion(params)) {}

Instance::Instance(const ShapePtr& shape, const Motion& motion)
    : Instance(std::make_shared<ShapeGroup>(shape), motion) {
  type = shape->type;
  id = shape->id;
  where = shape->where;
  bsdf_ = shape->bsdf_ptr();
}

Instance::Instance(ShapeGroupPtr group, const Motion& motion)
    : group_(std::move(group)), motion_(motion), at_rest_(motion.steps()[0]) {
  keeps_angles_ = is_similarity(at_rest_.linear);
  for (const Mat4& step : motion_.steps())
    keeps_angles_ = keeps_angles_ && Mat3(step) == at_rest_.linear;
  extent_ = rounding_scale();
}

void Instance::surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const {
  if (motion_.moves())
    surface_point(AffineMap(motion_.at(ray.time)), ray, hit, at);
  else
    surface_point(at_rest_, ray, hit, at);
}

inline void Instance::surface_point(const AffineMap& map, const Ray& ray, const Hit& hit,
                                    SurfacePoint& at) const {
  const Shape& shape = *group_->shapes()[hit.member];
  const Vec3 d = map.inverse * ray.d;
  const double stretch = length(d);
  shape.surface_point({map.point_back(ray.o), d / stretch, ray.time},
                      {hit.t * stretch, shape.index(), hit.primitive, hit.u, hit.v}, at);
  place(map, shape, ray.time, at);
}

void Instance::place(const AffineMap& map, const Shape& shape, double time,
                     SurfacePoint& at) const {
  // dp/du, of which the frame has the part across n, lies in the surface, across ng.
  const Frame& f = at.shading;
  const Vec3 dp_du = f.s - f.n * (dot(at.ng, f.s) / dot(at.ng, f.n));
  const Vec3 ng = normalize(at.ng * map.inverse);
  Vec3 n = normalize(f.n * map.inverse);
  if (const Mesh* mesh = shape.as_mesh(); mesh && !keeps_angles_)
    n = mesh->moved_normal(at, map.inverse).value_or(ng);
  at.shading = shape.has_tangent() ? Frame::around(n, map.linear * dp_du) : Frame::around(n);
  at.ng = ng * std::copysign(1.0, dot(ng, n));
  at.p = map.point(at.p);
  at.extent = extent_;
  at.shape = shape.index();
  at.instance = index();
  at.time = time;
}

SurfacePoint Instance::in_group(SurfacePoint at) const {
  const AffineMap map = map_at(at.time);
  at.p = map.point_back(at.p);
  at.ng = normalize(at.ng * map.linear);
  at.shading = Frame::around(normalize(at.shading.n * map.linear), map.inverse * at.shading.s);
  return at;
}

/// The size of coordinates that the accelerator's rounding is relative to: it computes inverse
/// (o - offset) in the group's space, where an error e becomes linear e.
double Instance::rounding_scale() const {
  Vec3 low, high;
  bounds(low, high);
  double scale = 0;
  for (const Mat4& step : motion_.steps()) {
    const AffineMap map(step);
    const Vec3 moved = absolute(map.inverse) * glm::max(largest(low, high), glm::abs(map.offset));
    scale = std::max(scale, max_component(absolute(map.linear) *
                                          glm::max(largest(group_->low(), group_->high()), moved)));
  }
  return scale;
}

/// The bounds of all steps: between two steps of a motion every point moves in a straight line.
void Instance::bounds(Vec3& low, Vec3& high) const {
  low = Vec3(infinity);
  high = Vec3(-infinity);
  for (const Mat4& step : motion_.steps()) {
    const AffineMap map(step);
    const Vec3 center = map.point(0.5 * (group_->low() + group_->high()));
    const Vec3 half = absolute(map.linear) * (0.5 * (group_->high() - group_->low()));
    low = glm::min(low, center - half);
    high = glm::max(high, center + half);
  }
}

}  // namespace mlt
