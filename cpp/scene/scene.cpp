#include "scene/scene.h"

#include "base/magnitude.h"
#include "scene/accel/instance.h"
#include "scene/emitter/infinite.h"
#include "scene/mesh/mesh.h"

#include <algorithm>
#include <set>

namespace mlt {

Bounds enclosing_sphere(const std::vector<ShapePtr>& shapes, const Camera& camera) {
  Vec3 low(infinity), high(-infinity);
  constexpr int moments = 128;  // The steps of a motion are among them.
  for (int i = 0; i <= moments; ++i) {
    const SurfacePoint middle =
        camera.sample_position({0.5, 0.5}, camera.time(1.0 * i / moments)).at;
    const Vec3 lens = camera.place(middle);
    if (std::isnan(lens.x)) break;  // A distant meter stands where the shapes say.
    low = glm::min(low, lens);
    high = glm::max(high, lens);
  }
  for (const ShapePtr& shape : shapes) {
    Vec3 l, h;
    shape->bounds(l, h);
    low = glm::min(low, l);
    high = glm::max(high, h);
  }
  if (!(low.x <= high.x)) return {Vec3(0), 1.0};
  const auto [center, radius] = bounds_of_box(low, high);
  return {center, radius > 0 ? radius * (1 + 1e-6) : 1.0};
}

namespace {

/// Throws SceneError for a shape that is too far away or too large for rays.
void check_extent(const Shape& shape) {
  Vec3 low, high;
  shape.bounds(low, high);
  for (int axis = 0; axis < 3; ++axis)
    for (const double x : {low[axis], high[axis]})
      if (too_large(x))
        throw SceneError(at(shape.where,
                            "shape '{}' reaches the coordinate {:g}, but should have none beyond "
                            "{:g}",
                            shape.type, x, largest_magnitude));
}

/// Throws SceneError for an instance in whose group's space rays are too large, in a scene with
/// coordinates up to `reach`.
void check_scale(const Instance& instance, double reach) {
  constexpr double most = 1e12;  // whose volume is no infinite float
  for (const Mat4& step : instance.motion().steps()) {
    const AffineMap map(step);
    const double least = std::max(1 / most, (reach + length(map.offset)) / largest_magnitude),
                 scale = map.least_scale() < least ? map.least_scale() : map.greatest_scale();
    if (!(scale >= least && scale <= most))
      throw SceneError(at(instance.where,
                          "shape '{}' scales lengths by {:g}, but here {:g} to {:g} is right",
                          instance.type, scale, least, most));
  }
}

LaneMesh lane_mesh(const Shape& shape) {
  const Mesh* mesh = shape.as_mesh();
  if (!mesh) return {};
  const Bsdf& bsdf = mesh->bsdf();
  const bool emits = shape.emitter() != nullptr;
  if (bsdf.lambertian().known()) return {mesh, &bsdf.lambertian(), nullptr, emits};
  if (bsdf.supports_lanes() && !bsdf.bends_normal()) return {mesh, nullptr, &bsdf, emits};
  return {};
}

/// Whether light may go straight through a shape, or one of those that it has instances of.
bool has_passage(const Shape& shape) {
  const Instance* instance = shape.as_instance();
  if (!instance) return shape.bsdf().has_passage();
  const auto& members = instance->group().shapes();
  return std::any_of(members.begin(), members.end(),
                     [](const ShapePtr& member) { return has_passage(*member); });
}

MeshLight mesh_light(const Emitter& emitter) {
  const Texture* radiance = emitter.uniform_radiance();
  if (!radiance || emitter.shape()->bsdf().has_passage()) return {};
  const Mesh* mesh = emitter.shape()->as_mesh();
  const Spectrum rgb(glm::max(radiance->mean(), Color(0)));
  return {mesh, radiance, rgb};
}

/// The shapes of all groups of which there are instances.
std::vector<ShapePtr> grouped_shapes(const std::vector<ShapePtr>& shapes) {
  std::vector<ShapePtr> grouped;
  std::set<const ShapeGroup*> seen;
  for (const ShapePtr& shape : shapes)
    if (const Instance* instance = shape->as_instance())
      if (const ShapeGroup& group = instance->group(); seen.insert(&group).second)
        grouped.insert(grouped.end(), group.shapes().begin(), group.shapes().end());
  return grouped;
}

}  // namespace

Scene::Scene(std::vector<ShapePtr> shapes, std::vector<EmitterPtr> emitters, CameraPtr camera,
             std::shared_ptr<FilmSettings> film, int64_t sample_count,
             const std::shared_ptr<const Accel>& known, const Vec3& origin)
    : shapes_(std::move(shapes)),
      emitters_(std::move(emitters)),
      camera_(std::move(camera)),
      film_(std::move(film)),
      sample_count_(sample_count),
      origin_(origin) {
  if (!camera_) throw SceneError("the scene has no sensor; add <sensor type=\"perspective\">");
  if (emitters_.empty())
    throw SceneError("the scene has no emitter; add a light, or everything is black");
  const std::vector<ShapePtr> grouped = grouped_shapes(shapes_);
  for (const auto& some : {shapes_, grouped})
    for (const ShapePtr& shape : some) check_extent(*shape);
  if (too_large(camera_->lens_radius()))
    throw SceneError(at(camera_->where, "the lens has the radius {:g}, but at most {:g} is right",
                        camera_->lens_radius(), largest_magnitude));
  bounds_ = enclosing_sphere(shapes_, *camera_);
  for (const ShapePtr& shape : shapes_)
    if (const Instance* instance = shape->as_instance())
      check_scale(*instance, length(bounds_.center) + bounds_.radius);
  camera_->set_bounds(bounds_);
  camera_->set_spectral(film_ && film_->spectral);
  camera_->set_band(film_ ? film_->band : std::nullopt);
  for (size_t i = 0; i < emitters_.size(); ++i) {
    emitters_[i]->set_bounds(bounds_);
    emitters_[i]->set_index(static_cast<uint32_t>(i));
    if (!emitters_[i]->infinite()) continue;
    infinite_.push_back(static_cast<uint32_t>(i));
    if (!emitters_[i]->delta()) backgrounds_.push_back(static_cast<uint32_t>(i));
  }
  const Shutter& shutter = camera_->shutter();
  light_choice_ = LightChoice(emitters_, shutter.open, shutter.close);
  for (const EmitterPtr& emitter : emitters_) mesh_lights_.push_back(mlt::mesh_light(*emitter));
  solids_ = Solids(shapes_, grouped, shutter);
  accel_ = known && known->fits(shapes_, camera_->shutter())
               ? known
               : std::make_shared<const Accel>(shapes_, camera_->shutter());
  shapes_.insert(shapes_.end(), grouped.begin(), grouped.end());
  for (size_t i = 0; i < shapes_.size(); ++i) shapes_[i]->set_index(static_cast<uint32_t>(i));
  find_media(grouped.size());
  has_passages_ = has_media_;
  for (const ShapePtr& shape : shapes_) {
    lane_meshes_.push_back(mlt::lane_mesh(*shape));
    passed_shapes_.push_back(mlt::has_passage(*shape));
    has_passages_ = has_passages_ || passed_shapes_.back();
  }
}

bool Scene::intersect(const Ray& ray, SurfacePoint& at) const {
  Hit hit;
  if (!accel_->intersect(ray, hit)) return false;
  find_surface_point(ray, hit, at);
  return true;
}

void Scene::find_surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const {
  at.kind = PointKind::surface;
  at.shape = hit.shape;
  at.primitive = hit.primitive;
  at.instance = SurfacePoint::no_shape;
  shapes_[hit.shape]->surface_point(ray, hit, at);
  at.time = ray.time;
  at.wavelength = ray.wavelength;
  at.medium = ray.medium;
  const SolidIndex solid = solids_.index(at.shape);
  at.around = solid == no_solid ? no_solid : solids_.around(at, solid);
  at.lambertian = bsdf(at).lambertian(at);
  if (at.lambertian.known()) at.shading = Frame::around(at.shading.n);
}

Spectrum MeshLight::radiance_at(double wavelength) const {
  if (wavelength < 0) return rgb;
  SurfacePoint at;
  at.wavelength = wavelength;
  return max(radiance->eval(at), Spectrum(0));
}

/// Whether it is a point on the lens.
inline bool is_on_lens(const SurfacePoint& at) {
  return at.shape == SurfacePoint::no_shape && at.kind == PointKind::surface;
}

inline Vec3 Scene::departure(const SurfacePoint& at, const Vec3& w) const {
  if (at.shape != SurfacePoint::no_shape) return ray_origin(at.p, at.ng, w, at.extent);
  return is_on_lens(at) ? camera_->entrance(at, w) : at.p;
}

Vec3 Scene::edge_end(const SurfacePoint& at, const Vec3& w) const {
  return at.shape == SurfacePoint::no_shape ? departure(at, w) : at.p;
}

void Scene::enter_medium(const SurfacePoint& at, Ray& ray) const {
  ray.medium = medium_towards(at, ray.d);
  ray.before = dot(ray.o - edge_end(at, ray.d), ray.d);
}

Ray Scene::spawn(const SurfacePoint& from, const Vec3& w, double time) const {
  Ray ray{departure(from, w), w, time};
  ray.wavelength = from.wavelength;
  if (is_on_lens(from)) ray.t_max = camera_->reach(from, w);
  if (has_media_) enter_medium(from, ray);
  return ray;
}

inline bool Scene::find_segment(const SurfacePoint& a, const SurfacePoint& b, double time,
                                Ray& ray) const {
  if (a.infinite() || b.infinite()) {
    ray = a.infinite() ? spawn(b, a.p, time) : spawn(a, b.p, time);
    return true;
  }
  const Vec3 ab = b.p - a.p;
  const Vec3 start = departure(a, ab), between = departure(b, -ab) - start;
  const bool has_end = a.shape == SurfacePoint::no_shape || b.shape == SurfacePoint::no_shape;
  if (has_end && !(dot(between, ab) > 0)) return false;  // behind the camera
  const double distance = length(between);
  ray = {start, between * (1 / distance), time, distance * (1 - ray_offset)};
  ray.wavelength = a.wavelength;
  if (!has_end) return true;
  if (is_on_lens(a)) return distance <= camera_->reach(a, ray.d);
  return !is_on_lens(b) || distance <= camera_->reach(b, -ray.d);
}

std::optional<Ray> Scene::segment(const SurfacePoint& a, const SurfacePoint& b, double time) const {
  Ray ray;
  return find_segment(a, b, time, ray) ? std::optional(ray) : std::nullopt;
}

bool Scene::visible(const SurfacePoint& a, const SurfacePoint& b, double time) const {
  Ray ray;
  if (!find_segment(a, b, time, ray)) return false;
  const Occlusion found = accel_->occluded(ray);
  return !(found.blocked | found.passed);
}

Ray Scene::beyond(const Ray& ray, const SurfacePoint& at) const {
  constexpr double grazing = 1e-3;  // there the ray moves aside
  const double cosine = abs_cos(at, ray.d);
  const Vec3 start =
      cosine > grazing ? at.p + ray.d * (ray_offset * at.extent / cosine) : departure(at, ray.d);
  Ray rest{start, ray.d, ray.time, ray.t_max - dot(start - ray.o, ray.d)};
  rest.wavelength = ray.wavelength;
  if (has_media_) enter_medium(at, rest);
  return rest;
}

SurfacePoint Scene::point_at_infinity(const Ray& ray) {
  SurfacePoint at = InfiniteEmitter::point_towards(ray.d);
  at.time = ray.time;
  at.wavelength = ray.wavelength;
  return at;
}

size_t Scene::triangle_count() const {
  size_t count = 0;
  for (const ShapePtr& shape : shapes_)
    if (shape->as_mesh()) count += shape->as_mesh()->data().triangles.size();
  return count;
}

size_t Scene::bytes() const {
  size_t sum = 0;
  for (const ShapePtr& shape : shapes_)
    if (shape->as_mesh()) sum += shape->as_mesh()->bytes();
  return sum;
}

}  // namespace mlt
