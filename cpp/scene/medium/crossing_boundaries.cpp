#include "scene/medium/crossing_boundaries.h"

#include "base/rng.h"

namespace mlt {
namespace {

constexpr size_t ray_count = 2000;
constexpr int most_surfaces = 100;  ///< Along a ray.

/// What rays have met.
struct Crossings {
  int all = 0, wrong = 0;
  const Shape *behind = nullptr, *before = nullptr;  ///< The first two that do not fit.
};

void follow(const Scene& scene, Ray ray, Crossings& found) {
  const Media& media = scene.media();
  const Shape* last = nullptr;
  MediumIndex medium = no_medium;
  SurfacePoint at;
  for (int i = 0; i < most_surfaces && scene.intersect(ray, at); ++i) {
    if (media.is_boundary(at)) {
      const Shape* shape = scene.shapes()[at.shape].get();
      if (last) ++found.all;
      if (last && medium != media.beside(at, -ray.d) && ++found.wrong == 1) {
        found.behind = last;
        found.before = shape;
      }
      last = shape;
      medium = media.beside(at, ray.d);
    }
    ray = scene.beyond(ray, at);
  }
}

/// A ray through the box of a shape, from a point around it to another one.
Ray ray_through(const Scene& scene, const Shape& shape, Rng& rng) {
  Vec3 low, high;
  shape.bounds(low, high);
  const auto point = [&] {
    const Vec3 u(rng.next(), rng.next(), rng.next());
    return low + (1.2 * u - 0.1) * (high - low);
  };
  const Vec3 from = point(), to = point();
  Ray ray{from, normalize(to - from)};
  ray.time = scene.camera().shutter().open;
  return ray;
}

}  // namespace

std::vector<std::string> warnings_of_crossing_boundaries(const Scene& scene) {
  if (!scene.has_media()) return {};
  std::vector<const Shape*> boundaries;
  for (uint32_t i = 0; i < scene.shapes().size(); ++i)
    if (scene.media().is_boundary(i)) boundaries.push_back(scene.shapes()[i].get());
  Crossings found;
  Rng rng(0, Purpose::inspect, 0);
  for (size_t i = 0; i < ray_count && !boundaries.empty(); ++i)
    follow(scene, ray_through(scene, *boundaries[i % boundaries.size()], rng), found);
  if (found.wrong == 0) return {};
  const std::string other = describe(found.behind->where);
  return {at(found.before->where,
             "{} of {} times a ray comes to this or another boundary of media from another medium "
             "than the boundary says; the first time it comes from {}: boundaries should not cross "
             "or touch, and each should name the media on both of its sides",
             found.wrong, found.all, other.empty() ? "another shape" : other)};
}

}  // namespace mlt
