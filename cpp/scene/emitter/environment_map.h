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
  Color power() const final { return integral() * disk_area(); }
  /// The integral of the radiance over the sphere.
  Color integral() const { return scale_ * integral_; }

 private:
  int cell_rows() const { return height_ - 1; }
  size_t pixel_count() const { return texels_.size() / size_t(channels_); }
  const float* texel_data(int i, int j) const;
  Color color_of(const float* texel) const;
  double column_at(const Vec3& d) const;
  void tabulate();
  void integrate();
  template <class F>
  F solid_angle(const F& top, const F& bottom) const;
  int row_at(double y) const;
  Color radiance_at(double column, double polar_share) const;
  /// The texels around a cell, or around many.
  template <class F>
  struct Corners {
    Vec3Of<F> c00, c10, c01, c11;

    /// Their bilinear interpolation.
    Vec3Of<F> at(const Vec2Of<F>& p) const {
      return (1 - p.y) * ((1 - p.x) * c00 + p.x * c10) + p.y * ((1 - p.x) * c01 + p.x * c11);
    }
    BilinearPatch<F> luminances() const;
  };
  Corners<double> corners(int i, int j) const;
  template <class F>
  struct Cell {
    Vec2Of<F> at;      ///< Column and row.
    Vec2Of<F> within;  ///< A place in it, in [0, 1]^2.
    F top, bottom;     ///< cos theta at its edges.
    Corners<F> corners;
  };
  Cell<double> cell(const Vec2& place) const;
  Cell<double> cell(int i, int j, const Vec2& within) const;
  template <class F>
  Vec3Of<F> direction_to(const Cell<F>& cell) const;
  template <class F>
  F pdf(const Cell<F>& cell, const F& probability) const;
  void take_four(const PositionRequest* requests, int count, const Piecewise2D::Cells& cells,
                 int first) const;
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
