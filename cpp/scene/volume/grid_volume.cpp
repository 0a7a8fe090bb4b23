#include "scene/volume/grid_volume.h"

#include "scene/texture/spectral_color.h"
#include "scene/volume/grid_walk.h"

#include <glm/gtc/matrix_transform.hpp>

namespace mlt {
namespace {

/// The spectrum of a number or of a colour.
struct GreyLanes {
  Spectrum operator()(double value) const { return Spectrum(value); }
};

/// The end of a flight by its optical depth tau: whether it is before, and by how much, with the
/// fall of that for this extinction.
class GreyEnd {
 public:
  GreyEnd(const FlightLimit& limit, const GreyLanes&) : most_(limit.grey_depth()) {}
  bool ends(double tau) const { return tau >= most_; }
  std::pair<double, double> excess(double tau, double extinction) const {
    return {most_ - tau, extinction};
  }

 private:
  double most_;
};
template <class ToLanes>
class ColouredEnd {
 public:
  ColouredEnd(const FlightLimit& limit, const ToLanes& lanes) : limit_(limit), lanes_(lanes) {}
  bool ends(const Color& tau) const { return limit_.ends(lanes_(tau)); }
  std::pair<double, double> excess(const Color& tau, const Color& extinction) const {
    const Spectrum now = limit_.before * exp(-lanes_(tau));
    return {mean(now) - limit_.left, mean(now * lanes_(extinction))};
  }

 private:
  const FlightLimit& limit_;
  const ToLanes& lanes_;
};
struct RgbLanes {
  Spectrum operator()(const Color& value) const { return Spectrum(value); }
};

/// The integral of a value along a line, and where it reaches the end of a flight; ToLanes makes a
/// spectrum of it.
template <class T, class ToLanes>
class Flying {
  using End = std::conditional_t<std::is_same_v<ToLanes, GreyLanes>, GreyEnd, ColouredEnd<ToLanes>>;

 public:
  Flying(const Grid& grid, const Vec3& o, const Vec3& d, double scale, const ToLanes& lanes)
      : grid_(&grid), o_(o), d_(d), scale_(scale), lanes_(lanes) {}

  Flight fly(const FlightLimit& limit) const {
    const End end(limit, lanes_);
    Flight flight{limit.distance};
    T depth(0);
    GridWalk(*grid_, o_, d_, limit.distance)
        .run([&](const Grid::Index& index, double from, double to) {
          const Cell cell(*this, index);
          const T here = cell.integral(from, to);
          if (end.ends(depth + here)) {
            flight = stop(end, depth, cell, from, to);
            return false;
          }
          depth += here;
          return true;
        });
    if (!flight.stops) flight.depth = lanes_(depth);
    return flight;
  }

 private:
  struct Cell {
    Cell(const Flying& flying, const Grid::Index& i)
        : values(flying.grid_->template cell<T>(i)),
          o(flying.o_ - Vec3(i[0], i[1], i[2])),
          d(flying.d_),
          scale(flying.scale_) {}
    T at(double t) const { return values.at(o + t * d) * scale; }
    /// Along a line the value is a cubic polynomial, whose integral two points of Gauss give
    /// exactly.
    T integral(double from, double to) const {
      const double middle = 0.5 * (from + to), half = 0.5 * (to - from),
                   aside = half * 0.57735026918962576;  // 1 / sqrt(3)
      return (at(middle - aside) + at(middle + aside)) * half;
    }

    Grid::Cell<T> values;
    Vec3 o, d;  ///< The line, in this cell's coordinates.
    double scale;
  };

  Flight stop(const End& end, const T& before, const Cell& cell, double from, double to) const {
    const auto depth = [&](double t) { return before + cell.integral(from, t); };
    const double t =
        flight_end(from, to, [&](double t) { return end.excess(depth(t), cell.at(t)); });
    return {t, lanes_(depth(t)), true};
  }

  const Grid* grid_;
  Vec3 o_, d_;
  double scale_;
  ToLanes lanes_;
};

}  // namespace

GridVolume::GridVolume(Grid grid, const Mat4& to_world) : grid_(std::move(grid)) {
  const auto& n = grid_.size();
  to_grid_ = glm::scale(glm::translate(Mat4(1), Vec3(grid_.low())), Vec3(n[0], n[1], n[2])) *
             glm::inverse(to_world);
  constexpr double most = 1e30;  // cells per length, of which products are finite
  for (int i = 0; i < 16; ++i)
    if (!(std::fabs(to_grid_[i / 4][i % 4]) < most))
      throw UsageError("'to_world' should have a volume, but is flat");
}

Spectrum GridVolume::at(const Vec3& p, double wavelength) const {
  const Vec3 x = transform_point(to_grid_, p);
  Grid::Index index;
  Vec3 in_cell;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(grid_.low() <= x[axis] && x[axis] <= grid_.high(axis))) return Spectrum(0);
    index[axis] = std::min(static_cast<int>(x[axis]), grid_.cells(axis) - 1);
    in_cell[axis] = x[axis] - index[axis];
  }
  if (!grid_.is_coloured()) return Spectrum(grid_.cell<double>(index).at(in_cell));
  const Color rgb = grid_.cell<Color>(index).at(in_cell);
  return wavelength < 0 ? Spectrum(rgb) : LinearUpsampling(wavelength)(rgb);
}

Spectrum GridVolume::light_at(const Vec3& p, double wavelength) const {
  return wavelength < 0 ? at(p, wavelength) : at(p, wavelength) * daylight(wavelength);
}

Flight GridVolume::fly(const Ray& ray, const FlightLimit& limit, double scale) const {
  const Vec3 o = transform_point(to_grid_, ray.o - ray.before * ray.d),
             d = transform_vector(to_grid_, ray.d);
  if (!grid_.is_coloured()) return Flying<double, GreyLanes>(grid_, o, d, scale, {}).fly(limit);
  if (ray.wavelength < 0) return Flying<Color, RgbLanes>(grid_, o, d, scale, {}).fly(limit);
  return Flying<Color, LinearUpsampling>(grid_, o, d, scale, LinearUpsampling(ray.wavelength))
      .fly(limit);
}

}  // namespace mlt
