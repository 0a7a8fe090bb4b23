// The start of paths: a light. Positions are SurfacePoints (area measure; volume in glowing media;
// solid angle for lights at infinity; a discrete probability of 1 for delta positions), directions
// are unit and in world space.
#pragma once

#include "base/object.h"
#include "math/spectrum.h"
#include "scene/ray.h"
#include "scene/surface_point.h"

#include <optional>

namespace mlt {

class Medium;
class Shape;
class Texture;
using MediumPtr = std::shared_ptr<const Medium>;

struct PositionSample {
  SurfacePoint at;
  double pdf;  ///< In the measure of `at`; 0 means that sampling failed.
};

/// A request for a position on a light at infinity, for a path of this time and wavelength: the
/// result of sample_position(u) is stored in `sample`, and what comes from there in `radiance`.
struct PositionRequest {
  Vec2 u;
  double time, wavelength;
  PositionSample* sample;
  std::optional<Spectrum>* radiance;
};

/// A sampled direction from a given position, with the origin of its ray (for a light at infinity a
/// point on a disk outside the scene).
struct RaySample {
  Vec3 origin;
  Vec3 direction;
  double
      pdf;  ///< Coefficient in projected solid angle: times G it is the density of the next vertex.
};

/// The sphere that encloses the scene.
struct Bounds {
  Vec3 center{0};
  double radius = 1;
};
inline Bounds bounds_of_box(const Vec3& low, const Vec3& high) {
  return {0.5 * (low + high), 0.5 * length(high - low)};
}

class Emitter : public Object {
 public:
  /// The radiance (area lights, lights at infinity), intensity (point lights) or radiance per unit
  /// of length (glowing media) emitted from x0 along w. For a delta position: the coefficient of
  /// the delta.
  virtual Spectrum eval(const SurfacePoint& x0, const Vec3& w) const = 0;

  /// Samples a position. The densities and inverses below are those at the time of x0.
  virtual PositionSample sample_position(const Vec2& u, double time) const = 0;
  /// Samples many positions on a light at infinity; their densities are independent of time.
  virtual void sample_positions(const PositionRequest* requests, int count) const {
    for (int i = 0; i < count; ++i) {
      SurfacePoint& at = (*requests[i].sample = sample_position(requests[i].u, 0)).at;
      at.time = requests[i].time;
      at.wavelength = requests[i].wavelength;
      *requests[i].radiance = eval(at, -at.p);
    }
  }
  virtual double pdf_position(const SurfacePoint& x0) const = 0;
  virtual Vec2 invert_position(const SurfacePoint& x0) const = 0;

  /// Draws the first ray of a light walk that starts at x0.
  virtual RaySample sample_ray(const SurfacePoint& x0, const Vec2& u) const = 0;
  /// Density of sample_ray() for w (coefficient in projected solid angle).
  virtual double pdf_ray(const SurfacePoint& x0, const Vec3& w) const = 0;
  /// The u for which the ray from x0 passes through x1.
  virtual Vec2 invert_ray(const SurfacePoint& x0, const Vec3& x1) const = 0;

  /// Samples a position for next-event estimation at the point `from`; the density may depend on
  /// `from`. By default it is that of sample_position.
  virtual PositionSample sample_direct(const Vec3& /*from*/, const Vec2& u, double time) const {
    return sample_position(u, time);
  }
  virtual double pdf_direct(const Vec3& /*from*/, const SurfacePoint& x0) const {
    return pdf_position(x0);
  }
  virtual Vec2 invert_direct(const Vec3& /*from*/, const SurfacePoint& x0) const {
    return invert_position(x0);
  }

  /// The medium that glows, of a light in a volume (volume_light.h); nullptr for any other light.
  virtual const Medium* glowing() const { return nullptr; }
  /// Samples a position in a volume, which takes a third number, and tells it for a position.
  virtual PositionSample sample_volume(const Vec2& u, double /*third*/, double time) const {
    return sample_position(u, time);
  }
  virtual double invert_third(const SurfacePoint& /*x0*/) const { return 0.5; }
  /// The box of a volume.
  virtual void find_box(Vec3& /*low*/, Vec3& /*high*/) const {}
  /// A point amid the light, which is not at infinity.
  Vec3 middle(double time) const;

  /// The radiance of a mesh that emits the same everywhere on its front side; nullptr for any other
  /// light.
  virtual const Texture* uniform_radiance() const { return nullptr; }

  virtual bool infinite() const { return false; }
  /// Whether it is a point or directional light, which no walk can hit.
  virtual bool delta() const { return false; }
  /// Whether each position shines in one direction alone: then eval() and pdf_ray() are the
  /// coefficients of one delta in projected solid angle, and neither next-event estimation nor a
  /// walk that hits the light can find it.
  virtual bool delta_direction() const { return false; }

  /// Emitted power (W per RGB), for sampling emitters.
  virtual Color power() const = 0;

  /// Sets the size of the scene; called once before rendering.
  virtual void set_bounds(const Bounds&) {}
  /// Sets the shape of an area light.
  virtual void set_shape(const Shape*) {}
  virtual const Shape* shape() const { return nullptr; }

  /// A factor of the probability with which the light is sampled.
  double sampling_weight() const { return sampling_weight_; }
  void set_sampling_weight(double weight) { sampling_weight_ = weight; }

  /// The medium that the scene file puts the light into, or nullptr.
  const MediumPtr& medium() const { return medium_; }
  void set_medium(MediumPtr medium) { medium_ = std::move(medium); }
  /// The place of the medium around the light, in Media.
  MediumIndex surroundings() const { return surroundings_; }
  void set_surroundings(MediumIndex medium) { surroundings_ = medium; }

  /// Index in Scene::emitters().
  uint32_t index() const { return index_; }
  void set_index(uint32_t index) { index_ = index; }

 private:
  uint32_t index_ = 0;
  double sampling_weight_ = 1;
  MediumPtr medium_;
  MediumIndex surroundings_ = no_medium;
};

using EmitterPtr = std::shared_ptr<Emitter>;

}  // namespace mlt
