// Light from infinitely far away that an image describes, in the latitude-longitude layout of
// Mitsuba 3 (release 3.9): in the map's own space y is up, and the direction with polar angle theta
// and azimuth phi,
//
//   w = (sin theta sin phi, cos theta, -sin theta cos phi),
//
// is at u = phi / 2 pi, v = theta / pi. Column i lies at u = (i + 1/2) / width and row j at
// v = j / (height - 1), so that the first and the last row are the poles; between them values are
// interpolated bilinearly.
//
// Directions are drawn by choosing a cell between four texels, proportional to their mean luminance
// times the cell's solid angle, and a place in it by their bilinear interpolation in phi and
// cos theta. The density in solid angle is that of the interpolated luminance but for the bend of
// cos theta within a row: it is positive wherever the radiance is, and finite at the poles. (Pharr
// et al., PBRT 3rd ed., sec. 14.2.4, draw from cells of constant density, with sin theta at texel
// centres: next to a lamp of a few texels, radiance over density is then noise that no
// stratification removes.)
#pragma once

#include "base/shared_array.h"
#include "image/image.h"
#include "math/bilinear_patch.h"
#include "math/distribution.h"
#include "scene/emitter/infinite.h"

#include <vector>

namespace mlt {

class EnvironmentMap : public InfiniteEmitter {
 public:
  /// The image has at least 2 x 3 pixels; `axes` are those of the map's own space.
  EnvironmentMap(Image image, const Frame& axes, double scale);

  Spectrum eval(const SurfacePoint& x0, const Vec3& w) const final;
  PositionSample sample_position(const Vec2& u, double time) const final;
  void sample_positions(const PositionRequest* requests, int count) const final;
  double pdf_position(const SurfacePoint& x0) const final;
  Vec2 invert_position(const SurfacePoint& x0) const final;
  Color power() const final { return integral_ * (scale_ * disk_area()); }

 private:
  int cell_rows() const { return height_ - 1; }
  size_t pixel_count() const { return texels_.size() / size_t(channels_); }
  const float* texel_data(int i, int j) const;
  Color color_of(const float* texel) const;
  double column_at(const Vec3& d) const;
  void tabulate();
  void integrate();
  double cell_solid_angle(int row) const;
  int row_at(double y) const;
  Color radiance_at(double column, double polar_share) const;
  /// The texels around a cell.
  struct Corners {
    Color c00, c10, c01, c11;

    /// Their bilinear interpolation.
    Color at(const Vec2& p) const {
      return (1 - p.y) * ((1 - p.x) * c00 + p.x * c10) + p.y * ((1 - p.x) * c01 + p.x * c11);
    }
    BilinearPatch luminances() const;
  };
  Corners corners(int i, int j) const;
  struct Cell {
    Vec2i at{};     ///< Column and row.
    Vec2 within{};  ///< A place in it, in [0, 1]^2.
    Corners corners{};
  };
  Cell cell(const Vec2& place) const;
  Vec2 place_in(const Cell& cell) const;
  Piecewise2D::Sample in_cell(Cell& cell, const Piecewise2D::Sample& sample) const;
  /// Density in solid angle of a direction, by that of its place in the table.
  double pdf_of(const Piecewise2D::Sample& sample) const;
  double cosine_at(double y) const;
  Vec2 place_of(const Vec3& d) const;

  Frame axes_;
  double scale_;
  int width_, height_, channels_;
  SharedArray<float> texels_;
  SharedArray<double> cos_rows_;  ///< cos theta of each row of texels.
  Piecewise2D table_;
  Color integral_{0};
};

}  // namespace mlt
