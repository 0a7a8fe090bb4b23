// The intensity of a light of no size, tabulated over the sphere and bilinear in both angles: theta
// from the axis of the table, the z axis of its own space, and the azimuth phi from its x axis.
// Beyond the first and the last theta it is dark.
//
// Directions are drawn as from an environment map: a cell between four entries in proportion to
// their mean times the cell's solid angle, and a place in it by their bilinear interpolation in phi
// and cos theta. So the density is that of the intensity but for the bend of cos theta in a cell.
#pragma once

#include "math/bilinear_patch.h"
#include "math/distribution.h"

#include <optional>
#include <vector>

namespace mlt {

class IntensityTable {
 public:
  /// Angles in radians, ascending: `theta` within [0, pi], `phi` from exactly 0 to 2 pi. The values
  /// of each phi follow each other. Throws UsageError if none is above 0.
  IntensityTable(std::vector<double> theta, std::vector<double> phi, std::vector<double> values);

  double at(const Vec3& w) const;
  Vec3 sample(const Vec2& u) const;
  /// Density in solid angle.
  double pdf(const Vec3& w) const;
  Vec2 invert(const Vec3& w) const;
  /// The integral of the intensity over the sphere.
  double integral() const;

 private:
  /// A place in a cell.
  struct Place {
    size_t row, column;
    Vec2 within;         ///< In [0, 1]^2: along phi, and along cos theta.
    double along_theta;  ///< In [0, 1].
  };
  size_t rows() const { return theta_.size() - 1; }
  size_t columns() const { return phi_.size() - 1; }
  size_t index(const Place& place) const { return place.row * columns() + place.column; }
  /// nullopt where it is dark.
  std::optional<Place> place(const Vec3& w) const;
  BilinearPatch<double> patch(size_t row, size_t column) const;
  double solid_angle(size_t row, size_t column) const;

  std::vector<double> theta_, phi_, cosines_, values_;
  Discrete cells_;
};

}  // namespace mlt
