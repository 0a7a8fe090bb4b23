// A function of the cosine of a direction and of a roughness, such as the share of light that rough
// microfacets reflect, interpolated between values at nodes.
#pragma once

#include "math/number.h"

#include <algorithm>
#include <array>

namespace mlt {

class EnergyTable {
 public:
  static constexpr int cosines = 32, roughnesses = 24;
  /// The nodes: cosines are dense at grazing angles, where such functions change most.
  static double cosine(int i) {
    return std::max(1e-4, sqr(static_cast<double>(i) / (cosines - 1)));
  }
  static double roughness(int j) { return static_cast<double>(j) / (roughnesses - 1); }

  double& node(int j, int i) { return values_[j * cosines + i]; }
  double node(int j, int i) const { return values_[j * cosines + i]; }

  template <class F>
  F at(F cosine, F roughness) const {
    const Place<F> x(sqrt(max(F(0), cosine)), cosines), y(roughness, roughnesses);
    const auto between = [&](int dj) {
      const F a = nodes(y, dj, x, 0), b = nodes(y, dj, x, 1);
      return a + x.within * (b - a);
    };
    const F a = between(0), b = between(1);
    return a + y.within * (b - a);
  }

  /// The mean for diffuse light, 2 int_0^1 f(c) c dc.
  double mean(int j) const {
    constexpr int steps = 8;
    double sum = 0;
    for (int i = 0; i < steps * (cosines - 1); ++i) {
      const double t = (i + 0.5) / (steps * (cosines - 1));  // c = t^2, dc = 2 t dt
      sum += 4 * t * t * t * at(t * t, roughness(j));
    }
    return sum / (steps * (cosines - 1));
  }

 private:
  template <class F>
  struct Place {
    F first, within;
    Place(F x, int nodes) {
      const F scaled = max(F(0), min(x, F(1))) * number<F>(nodes - 1);
      first = min(floor(scaled), number<F>(nodes - 2));
      within = scaled - first;
    }
  };
  template <class F>
  F nodes(const Place<F>& y, int dj, const Place<F>& x, int di) const {
    return for_each_lane<F>([&](int lane) {
      return node(static_cast<int>(lane_of(y.first, lane)) + dj,
                  static_cast<int>(lane_of(x.first, lane)) + di);
    });
  }

  std::array<double, cosines * roughnesses> values_{};
};

/// The value at x in [0, 1] between evenly spaced nodes.
template <size_t n, class F>
F between_nodes(const std::array<double, n>& values, F x) {
  const F scaled = max(F(0), min(x, F(1))) * number<F>(n - 1);
  const F first = min(floor(scaled), number<F>(n - 2));
  const auto node = [&](int next) {
    return for_each_lane<F>(
        [&](int lane) { return values[static_cast<int>(lane_of(first, lane)) + next]; });
  };
  const F a = node(0), b = node(1);
  return a + (scaled - first) * (b - a);
}

/// Such a function where the roughness is the same everywhere.
class EnergyRow {
 public:
  EnergyRow(const EnergyTable& table, double roughness) {
    for (int i = 0; i < EnergyTable::cosines; ++i)
      values_[i] = table.at(EnergyTable::cosine(i), roughness);
  }
  template <class F>
  F at(F cosine) const {
    return between_nodes(values_, sqrt(max(F(0), cosine)));
  }

 private:
  std::array<double, EnergyTable::cosines> values_;
};

/// A function of the roughness alone, likewise.
class RoughnessTable {
 public:
  RoughnessTable() = default;
  /// The means of a table for diffuse light.
  explicit RoughnessTable(const EnergyTable& table) {
    for (int j = 0; j < EnergyTable::roughnesses; ++j) values_[j] = table.mean(j);
  }
  template <class F>
  F at(F roughness) const {
    return between_nodes(values_, roughness);
  }

 private:
  std::array<double, EnergyTable::roughnesses> values_{};
};

}  // namespace mlt
