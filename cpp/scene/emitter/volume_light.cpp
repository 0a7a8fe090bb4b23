#include "scene/emitter/volume_light.h"

#include "math/warp.h"
#include "scene/accel/instance.h"
#include "scene/medium/medium.h"
#include "scene/solid/closed.h"

#include <algorithm>

namespace mlt {
namespace {

std::vector<double> volumes(const std::vector<VolumeLight::Box>& boxes) {
  std::vector<double> all;
  for (const VolumeLight::Box& box : boxes) all.push_back(box.volume());
  return all;
}

}  // namespace

double VolumeLight::Box::volume() const {
  const Vec3 side = high - low;
  return side.x * side.y * side.z;
}

bool VolumeLight::Box::contains(const Vec3& p) const {
  return glm::all(glm::lessThanEqual(low, p)) && glm::all(glm::lessThanEqual(p, high));
}

VolumeLight::VolumeLight(MediumPtr medium, std::vector<Box> boxes)
    : medium_(std::move(medium)), boxes_(std::move(boxes)), choice_(volumes(boxes_)) {
  id = medium_->id;
  type = medium_->type;
  where = medium_->where;
}

Spectrum VolumeLight::eval(const SurfacePoint& x0, const Vec3&) const {
  return medium_->emission(x0.p, x0.wavelength);
}

PositionSample VolumeLight::sample_volume(const Vec2& u, double third, double time) const {
  const auto [index, z] = choice_.sample_reuse(third);
  const Box& box = boxes_[index];
  const Vec3 p = box.low + Vec3(u, z) * (box.high - box.low);
  const SurfacePoint at = point_in_medium(p, no_medium, time);
  return {at, box_around(p) == index ? pdf_position(at) : 0};
}

size_t VolumeLight::box_around(const Vec3& p) const {
  size_t i = 0;
  while (i + 1 < boxes_.size() && !boxes_[i].contains(p)) ++i;
  return i;
}

Vec3 VolumeLight::place_in(const Box& box, const Vec3& p) {
  return glm::clamp((p - box.low) / (box.high - box.low), 0.0, 1 - 0x1p-53);
}

Vec2 VolumeLight::invert_position(const SurfacePoint& x0) const {
  return place_in(boxes_[box_around(x0.p)], x0.p);
}

double VolumeLight::invert_third(const SurfacePoint& x0) const {
  const size_t index = box_around(x0.p);
  return choice_.invert(index, place_in(boxes_[index], x0.p).z);
}

RaySample VolumeLight::sample_ray(const SurfacePoint& x0, const Vec2& u) const {
  return {x0.p, sample_uniform_sphere(u), uniform_sphere_pdf()};
}
double VolumeLight::pdf_ray(const SurfacePoint&, const Vec3&) const { return uniform_sphere_pdf(); }
Vec2 VolumeLight::invert_ray(const SurfacePoint& x0, const Vec3& x1) const {
  return invert_uniform_sphere(normalize(x1 - x0.p));
}

/// 4 pi times the integral of the emission over the shapes, as if none lay in another one.
Color VolumeLight::power() const {
  constexpr int n = 8;  // places along each axis of a box at which the medium is asked
  Color sum(0);
  for (const Box& box : boxes_)
    for (int i = 0; i < n * n * n; ++i) {
      const Vec3 place = (Vec3(i % n, i / n % n, i / (n * n)) + 0.5) / double{n};
      const Vec3 p = box.low + place * (box.high - box.low);
      sum += medium_->emission(p, rgb_lanes).rgb() * (4 * pi * box.filled / (n * n * n));
    }
  return sum;
}

void VolumeLight::find_box(Vec3& low, Vec3& high) const {
  low = boxes_[0].low;
  high = boxes_[0].high;
  for (const Box& box : boxes_) {
    low = glm::min(low, box.low);
    high = glm::max(high, box.high);
  }
}

namespace {

/// The media inside of a shape that glow, each once.
std::vector<MediumPtr> glowing_media(const Shape& shape) {
  std::vector<MediumPtr> found;
  const auto add = [&](const MediumPtr& medium) {
    if (medium && medium->emits() && std::find(found.begin(), found.end(), medium) == found.end())
      found.push_back(medium);
  };
  add(shape.media().interior);
  if (const Instance* instance = shape.as_instance())
    for (const ShapePtr& member : instance->group().shapes()) add(member->media().interior);
  return found;
}

}  // namespace

std::vector<EmitterPtr> volume_lights(const std::vector<ShapePtr>& shapes) {
  std::vector<std::pair<MediumPtr, std::vector<VolumeLight::Box>>> found;
  for (const ShapePtr& shape : shapes)
    for (const MediumPtr& medium : glowing_media(*shape)) {
      VolumeLight::Box box;
      shape->bounds(box.low, box.high);
      const auto volume = enclosed_volume(*shape);
      box.filled = volume.value_or(box.volume());
      if (!(box.volume() > 0)) continue;
      auto of = std::find_if(found.begin(), found.end(),
                             [&](const auto& light) { return light.first == medium; });
      if (of == found.end()) of = found.insert(of, {medium, {}});
      of->second.push_back(box);
    }
  std::vector<EmitterPtr> lights;
  for (auto& [medium, boxes] : found)
    lights.push_back(std::make_shared<VolumeLight>(medium, std::move(boxes)));
  return lights;
}

}  // namespace mlt
