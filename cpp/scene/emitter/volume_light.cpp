#include "scene/emitter/volume_light.h"

#include "math/warp.h"
#include "scene/accel/instance.h"
#include "scene/medium/medium.h"
#include "scene/solid/closed.h"

#include <algorithm>

namespace mlt {
namespace {

/// Cells along each axis of a box in a medium that varies, and places along each axis of a cell
/// at which such a medium is asked how bright it is. The choice of a cell magnifies the rounding of
/// the number that has chosen the light, in waves that of single precision, by the number of cells.
constexpr int most_cells = 20, asked = 3;
/// The share of the positions that is uniform over the boxes: it finds what lies between the places
/// that were asked.
constexpr double uniform_share = 0.1;

}  // namespace

double VolumeLight::Box::volume() const {
  const Vec3 side = high - low;
  return side.x * side.y * side.z;
}

bool VolumeLight::Box::contains(const Vec3& p) const {
  return glm::all(glm::lessThanEqual(low, p)) && glm::all(glm::lessThanEqual(p, high));
}

VolumeLight::VolumeLight(MediumPtr medium, std::vector<Box> boxes)
    : medium_(std::move(medium)),
      boxes_(std::move(boxes)),
      resolution_(medium_->varies() ? most_cells : 1) {
  id = medium_->id;
  type = medium_->type;
  where = medium_->where;
  std::vector<double> brightness(boxes_.size() * cells_of_box());
  double volume = 0, total = 0;
  for (size_t i = 0; i < brightness.size(); ++i) {
    const Color mean = mean_emission(i);
    power_ += 4 * pi * box_of(i).filled / cells_of_box() * mean;
    brightness[i] = target_luminance(mean);
    volume += cell_volume(i);
    total += brightness[i] * cell_volume(i);
  }
  std::vector<double> weights;
  for (size_t i = 0; i < brightness.size(); ++i) {
    const double bright = total > 0 ? brightness[i] / total : 0;
    weights.push_back(cell_volume(i) * ((1 - uniform_share) * bright + uniform_share / volume));
  }
  choice_ = Discrete(weights);
}

Color VolumeLight::mean_emission(size_t cell) const {
  const int n = medium_->varies() ? asked : 1;
  Color sum(0);
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3 in_cell = (Vec3(i % n, i / n % n, i / (n * n)) + 0.5) / double(n);
    sum += medium_->emission(point_at({cell, in_cell}), rgb_lanes).rgb();
  }
  return sum / double(n * n * n);
}

Spectrum VolumeLight::eval(const SurfacePoint& x0, const Vec3&) const {
  return medium_->emission(x0.p, x0.wavelength);
}

PositionSample VolumeLight::sample_volume(const Vec2& u, double third, double time) const {
  const auto [cell, z] = choice_.sample_reuse(third);
  const SurfacePoint at = point_in_medium(point_at({cell, Vec3(u, z)}), no_medium, time);
  return {at, place_of(at.p).cell == cell ? pdf_position(at) : 0};
}
double VolumeLight::pdf_position(const SurfacePoint& x0) const {
  const size_t cell = place_of(x0.p).cell;
  return choice_.pdf(cell) / cell_volume(cell);
}
Vec2 VolumeLight::invert_position(const SurfacePoint& x0) const { return place_of(x0.p).in_cell; }
double VolumeLight::invert_third(const SurfacePoint& x0) const {
  const Place place = place_of(x0.p);
  return choice_.invert(place.cell, place.in_cell.z);
}

/// The first box around a point, in which it is sampled.
size_t VolumeLight::box_around(const Vec3& p) const {
  size_t i = 0;
  while (i + 1 < boxes_.size() && !boxes_[i].contains(p)) ++i;
  return i;
}

VolumeLight::Place VolumeLight::place_of(const Vec3& p) const {
  const size_t index = box_around(p);
  const Box& box = boxes_[index];
  const Vec3 in_box = glm::clamp((p - box.low) / (box.high - box.low), 0.0, 1 - 0x1p-53);
  const Vec3 x = double(resolution_) * in_box, i = glm::floor(x);
  const double cell = (i.z * resolution_ + i.y) * resolution_ + i.x;
  return {index * cells_of_box() + static_cast<size_t>(cell), x - i};
}

Vec3 VolumeLight::point_at(const Place& place) const {
  const Box& box = box_of(place.cell);
  const auto cell = static_cast<int>(place.cell % cells_of_box());
  const Vec3 i(cell % resolution_, cell / resolution_ % resolution_,
               cell / (resolution_ * resolution_));
  return box.low + (i + place.in_cell) / double(resolution_) * (box.high - box.low);
}

RaySample VolumeLight::sample_ray(const SurfacePoint& x0, const Vec2& u) const {
  return {x0.p, sample_uniform_sphere(u), uniform_sphere_pdf()};
}
double VolumeLight::pdf_ray(const SurfacePoint&, const Vec3&) const { return uniform_sphere_pdf(); }
Vec2 VolumeLight::invert_ray(const SurfacePoint& x0, const Vec3& x1) const {
  return invert_uniform_sphere(normalize(x1 - x0.p));
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
