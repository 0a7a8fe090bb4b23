// Which media there are, and where: around the lens, and around each light.
#include "scene/scene.h"

namespace mlt {

SurfacePoint Scene::medium_point(const Ray& ray, double distance) {
  const Vec3 p = ray.o + (distance - ray.before) * ray.d;
  SurfacePoint at = point_in_medium(p, ray.medium, ray.time);
  at.wavelength = ray.wavelength;
  return at;
}

MediumIndex Scene::medium_around(const SurfacePoint& at, const Vec3& w, MediumIndex outside) const {
  Ray ray = spawn(at, w, at.time);
  ray.t_max = infinity;  // beyond the far plane of the camera, too
  SurfacePoint hit;
  while (intersect(ray, hit)) {
    if (media_.is_boundary(hit)) return media_.beside(hit, -w);
    ray = beyond(ray, hit);
  }
  return outside;
}

bool Scene::may_cross_boundaries(const Emitter& light, size_t grouped) const {
  if (light.glowing()) return true;
  if (light.infinite() || light.medium()) return false;
  for (size_t i = shapes_.size() - grouped; i < shapes_.size(); ++i)
    if (media_.is_boundary(static_cast<uint32_t>(i))) return true;  // wherever its instances are
  const Shape* shape = light.shape();
  if (!shape) {
    const Shutter& shutter = camera_->shutter();
    const auto position = [&](double time) { return light.sample_position(Vec2(0.5), time).at.p; };
    return position(shutter.open) != position(shutter.close);
  }
  Vec3 low, high, other_low, other_high;
  shape->bounds(low, high);
  for (size_t i = 0; i < shapes_.size(); ++i) {
    if (!media_.is_boundary(static_cast<uint32_t>(i)) || shapes_[i].get() == shape) continue;
    shapes_[i]->bounds(other_low, other_high);
    if (glm::all(glm::lessThan(low, other_high)) && glm::all(glm::lessThan(other_low, high)))
      return true;
  }
  return false;
}

namespace {

bool is_rough_boundary(const ShapePtr& shape) {
  const auto& [interior, exterior] = shape->media();
  const auto scatters = [](const MediumPtr& medium) { return medium && medium->scatters(); };
  return (scatters(interior) || scatters(exterior)) && shape->bsdf().scatters_through();
}

}  // namespace

void Scene::find_media(size_t grouped) {
  media_.add(shapes_, solids_.shapes());
  for (const EmitterPtr& light : emitters_) media_.add(light->medium());
  const MediumIndex declared = media_.add(camera_->medium());
  has_media_ = !media_.empty();
  has_coloured_media_ = media_.any_coloured();
  has_rough_boundaries_ = std::any_of(shapes_.begin(), shapes_.end(), is_rough_boundary);
  if (!has_media_) return;
  const double time = camera_->time(0.5);
  const Vec2 middle(0.5);
  const SurfacePoint lens = camera_->sample_position(middle, time).at;
  const MediumIndex at_lens = medium_around(lens, lens.ng, declared);
  camera_->set_surroundings(camera_->medium() ? declared : at_lens);
  // A medium without a boundary, in which the lens is, is everywhere.
  if (medium_around(lens, lens.ng, no_medium) != at_lens) outside_ = declared;
  for (const EmitterPtr& light : emitters_) {
    lights_in_many_media_.push_back(may_cross_boundaries(*light, grouped));
    MediumIndex around = light->medium() ? media_.add(light->medium()) : outside_;
    if (!light->medium() && !light->infinite() && !light->glowing()) {
      const SurfacePoint at = light->sample_position(middle, time).at;
      around = medium_around(at, at.ng, outside_);
    }
    light->set_surroundings(around);
  }
  find_media_lights();
}

void Scene::find_media_lights() {
  media_lights_.resize(media_.size());
  for (size_t i = 0; i < media_.size(); ++i) {
    const Medium& medium = media_[static_cast<MediumIndex>(i)];
    if (!medium.emits()) continue;
    for (const EmitterPtr& light : emitters_)
      if (light->glowing() == &medium) media_lights_[i] = light.get();
    // What a ray from far away comes to first is what lies around all shapes.
    Vec3 low(0), high(0);
    if (media_lights_[i]) media_lights_[i]->find_box(low, high);
    SurfacePoint far = point_in_medium(0.5 * (low + high), no_medium, camera_->time(0.5));
    far.p.x -= 2 * (bounds_.radius + length(bounds_.center - far.p));
    if (!media_lights_[i] || outside_ == i || medium_around(far, {1, 0, 0}, outside_) == i)
      throw SceneError(at(medium.where,
                          "medium '{}' emits light and has no end; it should be the 'interior' of "
                          "a shape, and not lie around all of them",
                          medium.type));
  }
}

}  // namespace mlt
