// The light that a path carries, and what scatters and absorbs it: a value in each of four lanes.
#pragma once

#include "math/color.h"
#include "math/exponential.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mlt {

/// In an RGB scene the lanes are R, G, B and G again, so that sums, maxima and comparisons need not
/// know what they are: only leaves (textures, lights, media) and the film do.
struct Spectrum {
  static constexpr int lanes = 4;
  double lane[lanes];

  Spectrum() = default;
  explicit Spectrum(double all) : lane{all, all, all, all} {}
  explicit Spectrum(const Color& c) : lane{c.x, c.y, c.z, c.y} {}
  Spectrum(double a, double b, double c, double d) : lane{a, b, c, d} {}

  double& operator[](int i) { return lane[i]; }
  double operator[](int i) const { return lane[i]; }

  /// The lanes of an RGB scene as a colour.
  Color rgb() const { return {lane[0], lane[1], lane[2]}; }
};

/// f(a, b), lane by lane.
template <class F>
Spectrum lane_by_lane(const Spectrum& a, const Spectrum& b, F&& f) {
  return {f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2]), f(a[3], b[3])};
}
template <class F>
Spectrum lane_by_lane(const Spectrum& a, F&& f) {
  return {f(a[0]), f(a[1]), f(a[2]), f(a[3])};
}

inline Spectrum operator+(const Spectrum& a, const Spectrum& b) {
  return lane_by_lane(a, b, [](double x, double y) { return x + y; });
}
inline Spectrum operator-(const Spectrum& a, const Spectrum& b) {
  return lane_by_lane(a, b, [](double x, double y) { return x - y; });
}
inline Spectrum operator*(const Spectrum& a, const Spectrum& b) {
  return lane_by_lane(a, b, [](double x, double y) { return x * y; });
}
inline Spectrum operator/(const Spectrum& a, const Spectrum& b) {
  return lane_by_lane(a, b, [](double x, double y) { return x / y; });
}
inline Spectrum operator*(const Spectrum& a, double b) { return a * Spectrum(b); }
inline Spectrum operator*(double a, const Spectrum& b) { return Spectrum(a) * b; }
inline Spectrum operator/(const Spectrum& a, double b) { return a / Spectrum(b); }
inline Spectrum operator-(const Spectrum& a) {
  return lane_by_lane(a, [](double x) { return -x; });
}
template <class T>
Spectrum& operator+=(Spectrum& a, const T& b) {
  return a = a + b;
}
template <class T>
Spectrum& operator*=(Spectrum& a, const T& b) {
  return a = a * b;
}
template <class T>
Spectrum& operator/=(Spectrum& a, const T& b) {
  return a = a / b;
}
inline bool operator==(const Spectrum& a, const Spectrum& b) {
  const double *x = a.lane, *y = b.lane;
  return (x[0] == y[0]) & (x[1] == y[1]) & (x[2] == y[2]) & (x[3] == y[3]);  // without a branch
}
inline bool operator!=(const Spectrum& a, const Spectrum& b) { return !(a == b); }

inline Spectrum max(const Spectrum& a, const Spectrum& b) {
  return lane_by_lane(a, b, [](double x, double y) { return std::max(x, y); });
}
inline Spectrum sqrt(const Spectrum& a) {
  return lane_by_lane(a, [](double x) { return std::sqrt(x); });
}
inline double max_component(const Spectrum& s) {
  return std::max(std::max(s[0], s[1]), std::max(s[2], s[3]));
}
inline double min_component(const Spectrum& s) {
  return std::min(std::min(s[0], s[1]), std::min(s[2], s[3]));
}

// Weights of all four lanes, which are those of RGB where the fourth lane equals the second:

inline double mean(const Spectrum& s) { return (s[0] + s[1] + s[2]) / 3 + (s[3] - s[1]) / 6; }
inline double luminance(const Spectrum& s) { return luminance(s.rgb()) + 0.35 * (s[3] - s[1]); }
inline double target_luminance(const Spectrum& s) {
  return target_luminance(s.rgb()) + 0.25 * (s[3] - s[1]);
}

inline bool is_black(const Spectrum& s) { return s == Spectrum(0); }
inline bool is_grey(const Spectrum& s) { return s == Spectrum(s[0]); }

/// e^s, in all lanes at once (exponential.h).
inline Spectrum exp(const Spectrum& s) {
  Spectrum result;
  for (int i = 0; i < Spectrum::lanes; ++i) result[i] = exponential(s[i]);
  return result;
}

/// Whether light of this throughput is zero in single precision, the precision of images.
inline bool vanishes(const Spectrum& throughput) {
  return max_component(throughput) < double{std::numeric_limits<float>::min()};
}

}  // namespace mlt
