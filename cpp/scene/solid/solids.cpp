#include "scene/solid/solids.h"

#include "base/error.h"
#include "scene/solid/closed.h"
#include "scene/solid/solid_surface.h"

#include <algorithm>
#include <map>

namespace mlt {
namespace {

/// Whether it is one without having a priority.
bool is_solid_of_glass(const Shape& shape) {
  return shape.bsdf_ptr() && shape.bsdf().index_inside() != nullptr && is_closed(shape);
}

void check_closed(const Shape& shape) {
  if (shape.priority() && !is_closed(shape))
    throw SceneError(at(shape.where,
                        "shape '{}' has a priority, but no inside: it should be a sphere, or a "
                        "mesh without holes whose triangles face one side",
                        shape.type));
}

struct Box {
  Vec3 low, high;

  explicit Box(const Shape& shape) { shape.bounds(low, high); }
  double volume() const {
    const Vec3 size = high - low;
    return size.x * size.y * size.z;
  }
  bool touches(const Box& other) const {
    const Vec3 slack = 1e-4 * (high - low);
    return glm::all(glm::lessThanEqual(low - slack, other.high)) &&
           glm::all(glm::lessThanEqual(other.low, high + slack));
  }
};

/// The shapes that are solids, from the highest priority to the lowest.
std::vector<uint32_t> solid_shapes(const std::vector<ShapePtr>& shapes) {
  std::vector<uint32_t> found;
  for (uint32_t i = 0; i < shapes.size(); ++i)
    if (!shapes[i]->as_instance() && (shapes[i]->priority() || is_solid_of_glass(*shapes[i])))
      found.push_back(i);
  std::map<uint32_t, Box> boxes;
  for (const uint32_t i : found) boxes.emplace(i, *shapes[i]);
  const auto is_apart = [&](uint32_t i) {
    return std::none_of(boxes.begin(), boxes.end(), [&](const auto& other) {
      return other.first != i && boxes.at(i).touches(other.second);
    });
  };
  found.erase(std::remove_if(found.begin(), found.end(), is_apart), found.end());
  const auto priority = [&](uint32_t i) { return shapes[i]->priority().value_or(0); };
  std::stable_sort(found.begin(), found.end(), [&](uint32_t a, uint32_t b) {
    if (priority(a) != priority(b)) return priority(a) > priority(b);
    return boxes.at(a).volume() < boxes.at(b).volume();
  });
  return found;
}

bool any_priority(const std::vector<ShapePtr>& shapes) {
  return std::any_of(shapes.begin(), shapes.end(),
                     [](const ShapePtr& shape) { return shape->priority().has_value(); });
}

/// The material of a solid in each of the others.
std::vector<BsdfPtr> immersed_in(const BsdfPtr& bsdf, const std::vector<ShapePtr>& shapes,
                                 const std::vector<uint32_t>& solids) {
  std::vector<BsdfPtr> made;
  for (const uint32_t other : solids) {
    const SideIndex* outside = shapes[other]->bsdf().index_inside();
    const BsdfPtr there = outside ? bsdf->immersed(*outside) : nullptr;
    made.push_back(there ? there : bsdf);
  }
  return made;
}

}  // namespace

Solids::Solids(const std::vector<ShapePtr>& shapes, const std::vector<ShapePtr>& grouped,
               const Shutter& shutter) {
  for (const ShapePtr& shape : grouped)
    if (shape->priority())
      throw SceneError(
          at(shape->where, "a shape that moves, or of a shapegroup, cannot have a priority"));
  if (!any_priority(shapes)) return;
  for (const ShapePtr& shape : shapes) check_closed(*shape);
  const std::vector<uint32_t> solids = solid_shapes(shapes);
  if (solids.size() >= hidden_surface)
    throw SceneError(
        fmt::format("there are {} solids; {} are the most", solids.size(), hidden_surface - 1));
  of_shape_.assign(shapes.size() + grouped.size(), no_solid);
  std::vector<BsdfPtr> surfaces;
  for (const uint32_t i : solids) {
    const BsdfPtr bsdf = SolidSurface::alone(shapes[i]->bsdf_ptr());
    surfaces.push_back(std::make_shared<SolidSurface>(bsdf, immersed_in(bsdf, shapes, solids)));
  }
  for (size_t k = 0; k < solids.size(); ++k) {
    const ShapePtr& shape = shapes[solids[k]];
    Solid solid{solids[k], {}, {}, nullptr};
    shape->bounds(solid.low, solid.high);
    solid.surface = std::make_unique<const Accel>(std::vector<ShapePtr>{shape}, shutter);
    of_shape_[solids[k]] = static_cast<SolidIndex>(k);
    shape->set_bsdf(surfaces[k]);
    all_.push_back(std::move(solid));
  }
}

std::vector<uint32_t> Solids::shapes() const {
  std::vector<uint32_t> found;
  for (const Solid& solid : all_) found.push_back(solid.shape);
  return found;
}

SolidIndex Solids::around(const SurfacePoint& at, SolidIndex own) const {
  const double step = 16 * ray_offset * at.extent;  // farther than surfaces that touch
  const Vec3 out = at.p + step * at.ng, in = at.p - step * at.ng;
  for (SolidIndex k = 0; k < own; ++k)
    if (contains(all_[k], out, at.time) || contains(all_[k], in, at.time)) return hidden_surface;
  for (size_t k = own + 1; k < all_.size(); ++k)
    if (contains(all_[k], out, at.time)) return static_cast<SolidIndex>(k);
  return no_solid;
}

/// By the parity of the crossings of a ray in a direction that no edges lie along.
bool Solids::contains(const Solid& solid, const Vec3& p, double time) const {
  if (!glm::all(glm::lessThan(solid.low, p)) || !glm::all(glm::lessThan(p, solid.high)))
    return false;
  static const Vec3 direction = normalize(Vec3(0.5377, 0.2915, 0.7911));
  const double reach = length(solid.high - solid.low);
  const double step = ray_offset * (max_component(glm::abs(p)) + reach);
  Ray ray{p, direction, time};
  Hit hit;
  bool inside = false;
  while (solid.surface->intersect(ray, hit)) {
    inside = !inside;
    ray.o += (hit.t + step) * direction;
  }
  return inside;
}

}  // namespace mlt
