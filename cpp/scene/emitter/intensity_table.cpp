#include "scene/emitter/intensity_table.h"

#include "math/warp.h"

#include <algorithm>

namespace mlt {
namespace {

/// The interval of ascending numbers that x is in, or the nearest one.
size_t interval_of(const std::vector<double>& bounds, double x) {
  const auto next = std::upper_bound(bounds.begin() + 1, bounds.end() - 1, x);
  return static_cast<size_t>(next - bounds.begin()) - 1;
}

double share(double x, double from, double to) {
  return std::clamp((x - from) / (to - from), 0.0, 1.0);
}

}  // namespace

IntensityTable::IntensityTable(std::vector<double> theta, std::vector<double> phi,
                               std::vector<double> values)
    : theta_(std::move(theta)), phi_(std::move(phi)), values_(std::move(values)) {
  for (const double angle : theta_) cosines_.push_back(std::cos(angle));
  std::vector<double> weights;
  for (size_t row = 0; row < rows(); ++row)
    for (size_t column = 0; column < columns(); ++column) {
      const auto [v00, v10, v01, v11] = patch(row, column);
      weights.push_back((v00 + v10 + v01 + v11) / 4 * solid_angle(row, column));
    }
  cells_ = Discrete(weights);
}

BilinearPatch<double> IntensityTable::patch(size_t row, size_t column) const {
  const double *left = &values_[column * theta_.size() + row], *right = left + theta_.size();
  return {left[0], right[0], left[1], right[1]};
}

double IntensityTable::solid_angle(size_t row, size_t column) const {
  return (phi_[column + 1] - phi_[column]) * (cosines_[row] - cosines_[row + 1]);
}

std::optional<IntensityTable::Place> IntensityTable::place(const Vec3& w) const {
  constexpr double rounding = 1e-12;
  if (w.z > cosines_.front() + rounding || w.z < cosines_.back() - rounding) return std::nullopt;
  const double phi = 2 * pi * turns(w.x, w.y);
  const double theta = std::atan2(std::hypot(w.x, w.y), w.z);
  const size_t row = interval_of(theta_, theta), column = interval_of(phi_, phi);
  return Place{
      row,
      column,
      {share(phi, phi_[column], phi_[column + 1]), share(w.z, cosines_[row], cosines_[row + 1])},
      share(theta, theta_[row], theta_[row + 1])};
}

double IntensityTable::at(const Vec3& w) const {
  const auto place = this->place(w);
  if (!place) return 0;
  const double x = place->within.x, y = place->along_theta;
  const auto [v00, v10, v01, v11] = patch(place->row, place->column);
  return (1 - y) * ((1 - x) * v00 + x * v10) + y * ((1 - x) * v01 + x * v11);
}

Vec3 IntensityTable::sample(const Vec2& u) const {
  const Discrete::Sample cell = cells_.sample_reuse(u.x);
  const size_t row = cell.index / columns(), column = cell.index % columns();
  const Vec2 within = patch(row, column).sample({cell.remainder, u.y});
  const double z = cosines_[row] + within.y * (cosines_[row + 1] - cosines_[row]);
  const double phi = phi_[column] + within.x * (phi_[column + 1] - phi_[column]);
  const SinCos azimuth = sincos_turns(phi / (2 * pi));
  const double r = std::sqrt((1 - z) * (1 + z));
  return {r * azimuth.cos, r * azimuth.sin, z};
}

double IntensityTable::pdf(const Vec3& w) const {
  const auto place = this->place(w);
  if (!place) return 0;
  const double probability = cells_.pdf(index(*place));
  if (!(probability > 0)) return 0;
  return probability * patch(place->row, place->column).density(place->within) /
         solid_angle(place->row, place->column);
}

Vec2 IntensityTable::invert(const Vec3& w) const {
  const auto place = this->place(w);
  if (!place || !(cells_.pdf(index(*place)) > 0)) return Vec2(0.5);
  const Vec2 u = patch(place->row, place->column).invert(place->within);
  return {cells_.invert(index(*place), u.x), u.y};
}

/// Over a row from a to b, 1 - t and t of the entries above and below with sin theta, where t grows
/// evenly: the integral of sin theta is cos a - cos b, that of t sin theta is
/// (sin b - sin a) / (b - a) - cos b.
double IntensityTable::integral() const {
  double sum = 0;
  for (size_t row = 0; row < rows(); ++row) {
    const double a = theta_[row], b = theta_[row + 1];
    const double both = cosines_[row] - cosines_[row + 1];
    const double below = (std::sin(b) - std::sin(a)) / (b - a) - cosines_[row + 1];
    for (size_t column = 0; column < columns(); ++column) {
      const auto [v00, v10, v01, v11] = patch(row, column);
      const double width = phi_[column + 1] - phi_[column];
      sum += width / 2 * ((v00 + v10) * (both - below) + (v01 + v11) * below);
    }
  }
  return sum;
}

}  // namespace mlt
