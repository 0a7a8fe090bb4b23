// A grid of values in a box, which the unit cube becomes by a transform; nothing is outside of it.
#pragma once

#include "scene/volume/grid.h"
#include "scene/volume/volume.h"

namespace mlt {

class GridVolume final : public Volume {
 public:
  /// Throws UsageError if the transform is flat.
  GridVolume(Grid grid, const Mat4& to_world);

  Spectrum at(const Vec3& p, double wavelength) const override;
  Spectrum light_at(const Vec3& p, double wavelength) const override;
  Color maximum() const override { return grid_.maximum(); }
  bool grey() const override { return !grid_.is_coloured(); }
  Flight fly(const Ray& ray, const FlightLimit& limit, double scale) const override;

 private:
  Grid grid_;
  Mat4 to_grid_;  ///< To cells, from the beginning of the first.
};

}  // namespace mlt
