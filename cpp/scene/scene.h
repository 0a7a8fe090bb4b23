// An immutable scene: shapes, lights and a camera, safe to share between threads.
#pragma once

#include "scene/accel/accel.h"
#include "scene/camera/camera.h"
#include "scene/emitter/emitter.h"
#include "scene/film/film_settings.h"
#include "scene/light/light_choice.h"
#include "scene/medium/media.h"
#include "scene/shape/shape.h"
#include "scene/solid/solids.h"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace mlt {

/// A light chosen at random, and its probability.
struct EmitterChoice {
  const Emitter* emitter;
  uint32_t index;
  double probability;
  double remainder = 0;  ///< Uniform in [0, 1): what is left of the number that chose it.
};

/// A mesh that shines the same everywhere on its front side and that light does not pass, as next-
/// event estimation needs it.
struct MeshLight {
  const Mesh* mesh = nullptr;  ///< nullptr if this light is of another kind.
  const Texture* radiance = nullptr;
  Spectrum rgb{0};  ///< The radiance where there are no wavelengths.

  Spectrum radiance_at(double wavelength) const;
};

/// A mesh whose vertices are computed together in waves.
struct LaneMesh {
  const Mesh* mesh = nullptr;                     ///< nullptr if this shape is of another kind.
  const LambertianSurface* lambertian = nullptr;  ///< If it is Lambertian everywhere.
  /// Else its material: it supports lanes, and its normal is that of the mesh.
  const Bsdf* glossy = nullptr;
  bool emits = false;
};

/// The least sphere around the bounding box of shapes and camera.
Bounds enclosing_sphere(const std::vector<ShapePtr>& shapes, const Camera& camera);

class Scene {
 public:
  /// Throws SceneError if there is no sensor or nothing that emits. `known` is the accelerator of
  /// another scene, which this one uses too if the same shapes are in the same places. `origin` is
  /// where the scene's description has its origin of coordinates.
  Scene(std::vector<ShapePtr> shapes, std::vector<EmitterPtr> emitters, CameraPtr camera,
        std::shared_ptr<FilmSettings> film, int64_t sample_count,
        const std::shared_ptr<const Accel>& known = nullptr, const Vec3& origin = Vec3(0));

  /// The shapes of the scene, then those in groups of which there are instances.
  const std::vector<ShapePtr>& shapes() const { return shapes_; }
  const std::vector<EmitterPtr>& emitters() const { return emitters_; }
  const Camera& camera() const { return *camera_; }
  const FilmSettings& film() const { return *film_; }
  const Bounds& bounds() const { return bounds_; }
  /// The point of the scene's description that is the origin here: 0, unless the description is
  /// far from its own.
  const Vec3& origin() const { return origin_; }
  int64_t sample_count() const { return sample_count_; }  ///< That of the scene file, or 0.

  /// What scatters light at a point: the material of its surface, or the phase function.
  const Bsdf& bsdf(const SurfacePoint& at) const {
    return at.in_medium() ? media_[at.medium].phase() : shapes_[at.shape]->bsdf();
  }
  /// The light that the point belongs to, or nullptr.
  const Emitter* emitter(const SurfacePoint& at) const {
    return at.in_medium() ? media_lights_[at.medium] : shapes_[at.shape]->emitter();
  }
  const Solids& solids() const { return solids_; }
  const Media& media() const { return media_; }
  bool has_media() const { return has_media_; }
  /// Finds the medium around a point that was sampled on a light, in a scene with media. In a
  /// volume sampling fails where there is another medium than that which glows.
  void find_medium_at_light(const Emitter& light, PositionSample& x0) const {
    x0.at.medium = lights_in_many_media_[light.index()] ? medium_around(x0.at, x0.at.ng, outside_)
                                                        : light.surroundings();
    if (light.glowing() && (x0.at.medium == no_medium || emitter(x0.at) != &light)) x0.pdf = 0;
  }
  /// Whether all rays from a light start in its surroundings.
  bool starts_in_surroundings(uint32_t light) const {
    if (!has_media_) return true;
    const Shape* shape = emitters_[light]->shape();
    return !lights_in_many_media_[light] && !(shape && media_.is_boundary(shape->index()));
  }
  /// The medium of a point in one.
  const Medium& medium(const SurfacePoint& at) const { return media_[at.medium]; }
  /// The medium in which a ray from the point along w starts.
  MediumIndex medium_towards(const SurfacePoint& at, const Vec3& w) const {
    if (at.shape != SurfacePoint::no_shape) return media_.beside(at, w);
    return at.kind == PointKind::surface ? camera_->surroundings() : at.medium;
  }
  /// The point at a distance along an edge, in the medium that its ray is in.
  static SurfacePoint medium_point(const Ray& ray, double distance);

  const Accel& accel() const { return *accel_; }
  const std::shared_ptr<const Accel>& accel_ptr() const { return accel_; }
  /// Finds the point in which the ray hit a surface.
  void find_surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const;
  /// The nearest surface along the ray; false if there is none.
  bool intersect(const Ray& ray, SurfacePoint& at) const;
  /// Whether two points (at most one of them infinite) are mutually visible. All surfaces block.
  bool visible(const SurfacePoint& a, const SurfacePoint& b, double time) const;

  /// Whether light goes straight through any surface, or there is any medium.
  bool has_passages() const { return has_passages_; }
  /// Whether light may go straight through a shape.
  bool has_passage(uint32_t shape) const { return passed_shapes_[shape]; }
  /// Whether walks may stop in a medium whose extinction differs between channels, so that their
  /// likelihood changes on the way.
  bool has_coloured_media() const { return has_coloured_media_; }
  /// Whether light may be scattered through the boundary of a medium in which it is scattered on.
  bool has_rough_boundaries() const { return has_rough_boundaries_; }
  /// The light along w that goes straight through the surface. Walks stop at every second surface
  /// that emits, to find its light, even if nothing is scattered there.
  Passage passage(const SurfacePoint& at, const Vec3& w) const;
  /// The rest of a ray, along the same line, beyond a surface that it passes; its distances count
  /// from there.
  Ray beyond(const Ray& ray, const SurfacePoint& at) const;
  /// The light that goes through all surfaces on a ray of finite length, and the media before them;
  /// the ray becomes the rest of it, behind the last one.
  Passage passage(Ray& ray) const;
  /// As above, for a ray that no surface blocks but some may dim.
  Passage pass_surfaces(Ray& ray) const;
  /// The light that goes through all media of such a ray, and through surfaces if it has any.
  Passage pass(Ray& ray, bool surfaces) const;
  /// The light that goes straight from a to b, through all surfaces and media between them.
  Passage passage(const SurfacePoint& a, const SurfacePoint& b, double time) const;
  /// The probability that a walk along w, which has come to this point, stops there and does not go
  /// through its surface.
  double stop_probability(const SurfacePoint& at, const Vec3& w) const {
    return at.shape == SurfacePoint::no_shape ? 1 : 1 - passage(at, w).probability;
  }
  /// The arrival of a walk that goes along an edge to its end, where w points.
  Arrival arrival(const Passage& edge, const SurfacePoint& end, const Vec3& w) const {
    const double stops = edge.probability * stop_probability(end, w);
    const Spectrum flies = end.in_medium()
                               ? edge.flight * medium(end).at(end.p, end.wavelength).extinction
                               : edge.flight;
    return {stops, flies, edge.likelihood};
  }
  /// As above, for an end that no walk passes, outside of media.
  static Arrival arrival(const Passage& edge) {
    return {edge.probability, edge.flight, edge.likelihood};
  }
  /// Where an edge at this point starts or ends, for distances in media: where rays enter the
  /// scene, if the lens is far away.
  Vec3 edge_end(const SurfacePoint& at, const Vec3& w) const;

  /// The shadow ray between two points; nullopt if they cannot be mutually visible.
  std::optional<Ray> segment(const SurfacePoint& a, const SurfacePoint& b, double time) const;
  /// A ray from `from` along w, moved off the surface it starts on.
  Ray spawn(const SurfacePoint& from, const Vec3& w, double time) const;

  /// Indices of the lights at infinity: all of them emit along every ray that leaves the scene.
  const std::vector<uint32_t>& infinite_emitters() const { return infinite_; }
  /// Lights at infinity that a ray can hit: all but directional lights.
  const std::vector<uint32_t>& backgrounds() const { return backgrounds_; }
  /// The vertex at infinity that a ray ends in.
  static SurfacePoint point_at_infinity(const Ray& ray);

  /// Chooses a light.
  EmitterChoice choose_emitter(double u) const {
    const LightIndex chosen = light_choice_.choose(u);
    return choice(chosen, u);
  }
  double emitter_probability(uint32_t index) const { return light_choice_.probability(index); }
  /// As above, for next-event estimation at the point `from`; probability 0: failed.
  EmitterChoice choose_emitter_for(const Vec3& from, double u) const {
    const LightIndex chosen = light_choice_.choose_for(from, u);
    return choice(chosen, u);
  }
  /// Whether the number that chooses a light decides anything.
  bool needs_light_choice() const { return emitters_.size() > 1 || emitters_[0]->glowing(); }
  double emitter_probability_for(uint32_t index, const Vec3& from) const {
    return light_choice_.probability_for(index, from);
  }
  const LightChoice& light_choice() const { return light_choice_; }
  /// The shape at this place in shapes(), if it is such a mesh.
  const LaneMesh& lane_mesh(uint32_t shape) const { return lane_meshes_[shape]; }
  /// The light at this place in emitters(), if it is an emissive mesh.
  const MeshLight& mesh_light(uint32_t index) const { return mesh_lights_[index]; }

  size_t triangle_count() const;
  size_t bytes() const;  ///< Bytes of the shapes' buffers.

 private:
  EmitterChoice choice(const LightIndex& chosen, double remainder) const {
    return {emitters_[chosen.index].get(), chosen.index, chosen.probability, remainder};
  }
  bool find_segment(const SurfacePoint& a, const SurfacePoint& b, double time, Ray& ray) const;
  /// Puts a ray that starts an edge at this point into its medium. Not inlined: most scenes have
  /// none.
  [[gnu::noinline]] void enter_medium(const SurfacePoint& at, Ray& ray) const;
  /// Finds all media, and those around lights and the lens; the last shapes are `grouped`.
  void find_media(size_t grouped);
  /// Finds the lights of media. Throws SceneError if one of these has no end.
  void find_media_lights();
  /// The medium around a point: that on the near side of the first boundary along w.
  MediumIndex medium_around(const SurfacePoint& at, const Vec3& w, MediumIndex outside) const;
  /// Whether one part of the light may be in another medium than the rest.
  bool may_cross_boundaries(const Emitter& light, size_t grouped) const;
  /// The origin of a ray from the point along w (of any length), moved off its surface.
  Vec3 departure(const SurfacePoint& at, const Vec3& w) const;

  std::vector<ShapePtr> shapes_;
  std::vector<EmitterPtr> emitters_;
  CameraPtr camera_;
  std::shared_ptr<FilmSettings> film_;
  int64_t sample_count_;
  Vec3 origin_;
  Bounds bounds_;
  Solids solids_;
  std::shared_ptr<const Accel> accel_;
  std::vector<uint32_t> infinite_, backgrounds_;
  bool has_passages_ = false, has_media_ = false, has_coloured_media_ = false;
  bool has_rough_boundaries_ = false;
  Media media_;
  MediumIndex outside_ = no_medium;           ///< Where no boundary is met.
  std::vector<const Emitter*> media_lights_;  ///< One for each medium: its light, or nullptr.
  std::vector<bool> lights_in_many_media_;    ///< One for each emitter.
  LightChoice light_choice_;
  std::vector<MeshLight> mesh_lights_;  ///< One for each emitter.
  std::vector<LaneMesh> lane_meshes_;   ///< One for each shape.
  std::vector<bool> passed_shapes_;     ///< One for each shape.
};

using ScenePtr = std::shared_ptr<const Scene>;

}  // namespace mlt
