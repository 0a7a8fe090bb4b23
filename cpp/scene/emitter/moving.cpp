#include "scene/emitter/moving.h"

namespace mlt {
namespace {

/// The factor by which the map scales an area whose unit normal at rest is n.
double area_factor(const AffineMap& map, const Vec3& n) {
  return std::abs(glm::determinant(map.linear)) * length(n * map.inverse);
}

}  // namespace

PositionSample MovingEmitter::moved(PositionSample sample, double time) const {
  sample.pdf /= area_factor(instance_->map_at(time), sample.at.ng);
  instance_->move_to_world(*light_->shape(), time, sample.at);
  return sample;
}

PositionSample MovingEmitter::sample_position(const Vec2& u, double time) const {
  return moved(light_->sample_position(u, time), time);
}

double MovingEmitter::pdf_position(const SurfacePoint& x0) const {
  const SurfacePoint at_rest = instance_->in_group(x0);
  return light_->pdf_position(at_rest) / area_factor(instance_->map_at(x0.time), at_rest.ng);
}

Vec2 MovingEmitter::invert_position(const SurfacePoint& x0) const {
  return light_->invert_position(instance_->in_group(x0));
}

PositionSample MovingEmitter::sample_direct(const Vec3& from, const Vec2& u, double time) const {
  return moved(light_->sample_direct(instance_->map_at(time).point_back(from), u, time), time);
}

double MovingEmitter::pdf_direct(const Vec3& from, const SurfacePoint& x0) const {
  const AffineMap map = instance_->map_at(x0.time);
  const SurfacePoint at_rest = instance_->in_group(x0);
  return light_->pdf_direct(map.point_back(from), at_rest) / area_factor(map, at_rest.ng);
}

Vec2 MovingEmitter::invert_direct(const Vec3& from, const SurfacePoint& x0) const {
  return light_->invert_direct(instance_->map_at(x0.time).point_back(from),
                               instance_->in_group(x0));
}

Color MovingEmitter::power() const {
  const std::vector<Mat4>& steps = instance_->motion().steps();
  double mean = 0;
  for (const Mat4& step : steps)
    mean += std::cbrt(sqr(glm::determinant(Mat3(step)))) / static_cast<double>(steps.size());
  return light_->power() * mean;
}

}  // namespace mlt
