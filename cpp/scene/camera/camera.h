// The end of paths: a camera, its lens and its raster. Raster positions are in pixels of the
// cropped image, x to the right and y down, (0, 0) at the upper left corner of the first pixel.
#pragma once

#include "base/object.h"
#include "math/color.h"
#include "math/wavelengths.h"
#include "scene/emitter/emitter.h"
#include "scene/surface_point.h"

#include <optional>

namespace mlt {

/// The image plane in pixels. Samples are drawn over the crop window widened by `border`, the
/// radius of the reconstruction filter; it is 0 where positions outside the image have no
/// directions of their own.
struct Raster {
  Vec2i full_size{0};    ///< The whole image, which fixes the field of view.
  Vec2i crop_offset{0};  ///< Where the crop window starts in the whole image.
  Vec2i size{0};         ///< Size of the crop window: the image that is rendered.
  double border = 0;

  double pixels() const { return static_cast<double>(size.x) * size.y; }
  /// Area of the sampled domain in pixels.
  double sampled_area() const { return (size.x + 2 * border) * (size.y + 2 * border); }
  /// Maps the unit square to the sampled domain.
  Vec2 sample(const Vec2& u) const {
    return {u.x * (size.x + 2 * border) - border, u.y * (size.y + 2 * border) - border};
  }
  Vec2 invert(const Vec2& position) const {
    return {(position.x + border) / (size.x + 2 * border),
            (position.y + border) / (size.y + 2 * border)};
  }
  bool contains(const Vec2& position) const {
    return position.x >= -border && position.x < size.x + border && position.y >= -border &&
           position.y < size.y + border;
  }
};

/// The image position and the importance of a direction at a point on the lens.
struct Projection {
  Vec2 raster;  ///< Its raster position: the inverse of Camera::direction.
  /// Importance We(xk -> w) of the camera at xk along w, normalised so that its integral
  /// over the lens and the projected solid angle of the *image* (size.x x size.y, without border)
  /// is 1. For a pinhole: the coefficient of the delta position.
  double importance;
  /// Density of w in projected solid angle at xk, when raster positions are uniform over the
  /// sampled domain.
  double pdf_direction;
};

/// The planes between which surfaces are seen, by their depths along the axis of the camera.
struct ClippingPlanes {
  double near = 0, far = infinity;
};

class Camera : public Object {
 public:
  /// Samples a point on the lens at this time.
  virtual PositionSample sample_position(const Vec2& u, double time) const = 0;
  virtual double pdf_position(const SurfacePoint& xk) const = 0;
  virtual Vec2 invert_position(const SurfacePoint& xk) const = 0;

  /// The direction from xk on the lens for a raster position.
  virtual Vec3 direction(const SurfacePoint& xk, const Vec2& raster) const = 0;
  /// Where a ray from xk along w, of any length, enters the scene: at xk, or at the near plane.
  Vec3 entrance(const SurfacePoint& xk, const Vec3& w) const {
    return at_depth(xk, w, setback_ + clipping_.near);
  }
  /// How far it goes from there to the far plane, or 0 outside the field of view; w is a unit
  /// vector.
  double reach(const SurfacePoint& xk, const Vec3& w) const {
    const double cosine = dot(w, xk.ng);
    if (cosine < least_cosine_) return 0;
    return clips_far() ? (clipping_.far - clipping_.near) / cosine : infinity;
  }
  bool clips_far() const { return clipping_.far < infinity; }
  void set_clipping(const ClippingPlanes& planes) { clipping_ = planes; }
  /// Where the lens is, or the image of a camera whose lens is far away.
  Vec3 place(const SurfacePoint& xk) const { return at_depth(xk, xk.ng, setback_); }
  /// The ray for a raster position, by sample_position, direction and entrance.
  virtual Ray ray(const Vec2& raster, const Vec2& u_lens, double time) const {
    const SurfacePoint xk = sample_position(u_lens, time).at;
    const Vec3 w = direction(xk, raster);
    return {entrance(xk, w), w, time, reach(xk, w), surroundings()};
  }
  /// Projects a direction to the image; nullopt behind the camera or outside the sampled domain.
  virtual std::optional<Projection> project(const SurfacePoint& xk, const Vec3& w) const = 0;
  /// The members of Projection; the importance and the density are 0 if there is none.
  std::optional<Vec2> raster_position(const SurfacePoint& xk, const Vec3& w) const {
    const auto projection = project(xk, w);
    return projection ? std::optional(projection->raster) : std::nullopt;
  }
  double eval(const SurfacePoint& xk, const Vec3& w) const {
    const auto projection = project(xk, w);
    return projection ? projection->importance : 0;
  }
  double pdf_direction(const SurfacePoint& xk, const Vec3& w) const {
    const auto projection = project(xk, w);
    return projection ? projection->pdf_direction : 0;
  }

  /// Whether it is a pinhole, which no walk can hit.
  virtual bool delta_position() const = 0;
  /// Whether walks from lights can end on the lens. With clipping planes none does: what is not
  /// seen would block some of them.
  virtual bool can_be_hit() const { return !delta_position() && !clips(); }
  /// The point of the lens at this offset (in its plane) from xk; nullopt beyond its rim.
  virtual std::optional<SurfacePoint> move_on_lens(const SurfacePoint& /*xk*/,
                                                   const Vec2& /*by*/) const {
    return std::nullopt;
  }
  virtual double lens_radius() const { return 0; }
  /// Where a ray intersects the lens, if it has an area. The lens does not block the ray.
  virtual std::optional<SurfacePoint> hit_lens(const Ray& /*ray*/) const { return std::nullopt; }

  const Raster& raster() const { return raster_; }
  /// Camera time: uniform while the shutter is open.
  double time(double u) const { return shutter_.time(u); }
  const Shutter& shutter() const { return shutter_; }
  /// Whether paths have wavelengths, and else R, G and B.
  bool spectral() const { return spectral_; }
  void set_spectral(bool spectral) { spectral_ = spectral; }
  /// The wavelengths that the film of a spectral scene records, if not all.
  const std::optional<Band>& band() const { return band_; }
  void set_band(const std::optional<Band>& band) { band_ = band; }
  /// Whether the film records X, Y and Z.
  bool records_xyz() const { return spectral_ && !band_; }
  /// The wavelength of a path by a random number, which is drawn in spectral scenes alone.
  template <class Draw>
  double wavelength(Draw&& draw) const {
    return spectral_ ? wavelength_at(draw()) : rgb_lanes;
  }
  /// The wavelength in a spectral scene for a number in [0, 1), and that number: see wavelengths.h.
  double wavelength_at(double number) const {
    return band_ ? std::min(band_->first + number * (band_->last - band_->first), band_->last)
                 : number;
  }
  double invert_wavelength(double u) const {
    return band_ ? (u - band_->first) / (band_->last - band_->first) : u;
  }

  /// By what the mean radiance over the lens and the directions of a pixel is multiplied.
  virtual double response() const { return 1; }

  /// Makes the surface of a shape its lens. Throws SceneError unless the sensor measures on shapes.
  virtual void set_shape(const Shape*) {
    throw SceneError(
        at(where, "sensor '{}' does not measure on a shape; put it directly into the scene", type));
  }
  /// Whether it measures on a shape, and has none.
  virtual bool lacks_shape() const { return false; }

  /// The medium that the scene file puts the lens into, or nullptr.
  const MediumPtr& medium() const { return medium_; }
  void set_medium(MediumPtr medium) { medium_ = std::move(medium); }
  /// The place of the medium around the lens, in Media.
  MediumIndex surroundings() const { return surroundings_; }
  void set_surroundings(MediumIndex medium) { surroundings_ = medium; }

  /// Sets the raster of the film; called once by the scene builder.
  virtual void set_raster(const Raster& raster) { raster_ = raster; }
  /// Sets the size of the scene; called once before rendering.
  virtual void set_bounds(const Bounds&) {}

 protected:
  bool clips() const { return clipping_.near > 0 || clips_far(); }

  Raster raster_;
  Shutter shutter_;
  double setback_ = 0;  ///< Distance of the lens behind the place of the camera.
  /// Cosine with the axis below which nothing is seen, where the image is round: the directions of
  /// raster positions outside the circle have less, and are not projected.
  double least_cosine_ = -infinity;

 private:
  static Vec3 at_depth(const SurfacePoint& xk, const Vec3& w, double depth) {
    return depth == 0 ? xk.p : xk.p + w * (depth / dot(w, xk.ng));
  }

  ClippingPlanes clipping_;
  MediumPtr medium_;
  MediumIndex surroundings_ = no_medium;
  bool spectral_ = false;
  std::optional<Band> band_;
};

using CameraPtr = std::shared_ptr<Camera>;

}  // namespace mlt
