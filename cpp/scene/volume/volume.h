// A quantity that varies in space: the extinction, the albedo or the emission of a medium.
#pragma once

#include "base/params.h"
#include "scene/medium/flight.h"

namespace mlt {

class Volume : public Object {
 public:
  /// `wavelength`: that of the path (wavelengths.h).
  virtual Spectrum at(const Vec3& p, double wavelength) const = 0;
  /// The value as a radiance: what is given as RGB is light of that colour (RgbMeaning::light).
  virtual Spectrum light_at(const Vec3& p, double wavelength) const = 0;
  virtual Color maximum() const = 0;
  /// Whether it is the same in all channels.
  virtual bool grey() const = 0;
  /// How far light flies along a ray through a medium whose extinction is `scale` times this.
  virtual Flight fly(const Ray& ray, const FlightLimit& limit, double scale) const = 0;
};

using VolumePtr = std::shared_ptr<const Volume>;

/// The volume parameter `name`: a nested Volume, or the same number, rgb or spectrum everywhere.
/// Throws SceneError if it is negative.
VolumePtr volume_param(Params& params, const std::string& name);

}  // namespace mlt
