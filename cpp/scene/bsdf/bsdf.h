// Scattering at a surface. Directions are unit vectors in the local shading frame and point away
// from the surface: `wl` towards the light side of a path, `wc` towards its camera side.
#pragma once

#include "base/object.h"
#include "math/frame.h"
#include "scene/bsdf/scattering_lanes.h"
#include "scene/passage.h"
#include "scene/surface_point.h"
#include "scene/texture/texture.h"

#include <optional>

namespace mlt {

struct BsdfSample {
  Vec3 to;  ///< The sampled direction, local.
  Lobe lobe;
};

struct SideIndex;

/// What fills a solid, per unit of length, and the mean cosine of its scattering.
struct SolidInside {
  Color scattering{0}, absorption{0};
  double g = 0;
};

/// A surface that is Lambertian everywhere.
struct LambertianSurface {
  /// Unknown sides: the surface is not Lambertian. f is that of all points of an RGB scene, unless
  /// there is a texture.
  Lambertian lambertian;
  const Texture* reflectance = nullptr;  ///< pi f
  bool textured = false;

  bool known() const { return lambertian.known(); }
  bool uniform() const { return known() && !textured; }
  Lambertian at(const SurfacePoint& at) const {
    if (!textured && (at.wavelength < 0 || !known())) return lambertian;
    return {reflectance->eval(at) * inv_pi, lambertian.sides};
  }
};

/// Light goes straight through the surface (see Passage) or is scattered there: densities are those
/// of scattered light.
class Bsdf : public Object {
 public:
  /// The light along w that goes straight through; as much as along -w.
  virtual Passage passage(const SurfacePoint& /*at*/, const Vec3& /*w*/) const {
    return Passage::blocked();
  }
  virtual bool has_passage() const { return false; }

  /// Evaluates the scattering between wl and wc. For a delta lobe the directions are assumed to
  /// match it.
  virtual Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                                Lobe lobe) const = 0;
  Spectrum eval(const SurfacePoint& at, const Vec3& wl, const Vec3& wc, Lobe lobe) const {
    return scattering(at, wl, wc, lobe).f;
  }
  /// Density (smooth: solid angle; delta: probability) of sampling `to`, given `from`.
  double pdf(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe) const {
    return scattering(at, from, to, lobe).pdf_from_light;
  }

  /// Draws a direction. u.x chooses the lobe, (u.y, u.z) the direction; all in [0, 1).
  /// nullopt: nothing is scattered (absorbed, or sampled below the horizon). It makes no difference
  /// whether `from` is on the light or on the camera side.
  virtual std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                           const Vec3& u) const = 0;

  /// A u for which sample(at, from, u) gives (to, lobe); nullopt where pdf is 0. There may be many:
  /// v chooses one, and if v is uniform they are as likely as when u is uniform and has given (to,
  /// lobe).
  virtual std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to,
                                     Lobe lobe, const Vec3& v) const = 0;

  /// Whether scatter() computes scattering() and sample() for many points together; of materials
  /// that are opaque, and smooth alone.
  bool supports_lanes() const { return supports_lanes_; }
  virtual void scatter(ScatteringLanes&) const {}

  /// Whether the smooth lobes are present, and whether a delta lobe is.
  virtual bool has_smooth() const { return true; }
  virtual bool has_delta() const { return false; }

  /// Whether light can reach the other side of the surface.
  virtual bool has_transmission() const { return false; }
  /// Whether a lobe that is not a delta may.
  bool scatters_through() const { return has_smooth() && has_transmission(); }

  /// eta on the side that `w` is on, over eta on the other side; 1 for surfaces that do not
  /// refract.
  virtual double relative_eta(const SurfacePoint& /*at*/, const Vec3& /*w*/) const { return 1; }

  /// The index of refraction below the surface of a dielectric; nullptr of other materials.
  virtual const SideIndex* index_inside() const { return nullptr; }
  /// A dielectric with this index above its surface; nullptr of materials to which it does not
  /// matter.
  virtual std::shared_ptr<const Bsdf> immersed(const SideIndex& /*outside*/) const {
    return nullptr;
  }

  /// The roughness (Beckmann-equivalent alpha) of the narrowest smooth lobe that contributes to
  /// scattering between these directions; infinity for a diffuse surface, 0 for delta lobes.
  virtual double roughness(const SurfacePoint& /*at*/, const Vec3& /*wl*/,
                           const Vec3& /*wc*/) const {
    return infinity;
  }
  /// A lower bound of roughness().
  virtual double least_roughness() const { return 0; }

  /// The normal about which delta lobes reflect and refract light from the direction w.
  virtual Vec3 delta_normal(const SurfacePoint& /*at*/, const Vec3& /*w*/) const {
    return {0, 0, 1};
  }
  /// Whether delta_normal() may differ from the shading normal.
  virtual bool bends_normal() const { return false; }

  /// Average reflectance, for previews and sampling weights.
  virtual Spectrum albedo(const SurfacePoint& at) const = 0;

  /// The medium inside of a shape of this material that is given none.
  const std::optional<SolidInside>& inside() const { return inside_; }
  /// The radiance (a Texture) of a shape of this material that is given no light; or nullptr.
  const ObjectPtr& glow() const { return glow_; }

  /// The scattering as a Lambertian where the surface is Lambertian; unknown where it is not.
  Lambertian lambertian(const SurfacePoint& at) const { return lambertian_.at(at); }
  const LambertianSurface& lambertian() const { return lambertian_; }

 protected:
  // Set by constructors:
  LambertianSurface lambertian_;
  bool supports_lanes_ = false;
  std::optional<SolidInside> inside_;
  ObjectPtr glow_;
};

using BsdfPtr = std::shared_ptr<const Bsdf>;

}  // namespace mlt
