#include "math/upsampling.h"

#include "math/colorimetry.h"

#include <algorithm>
#include <array>

namespace mlt {

namespace {

// Fits have the variable t = (lambda - middle) / half, in [-1, 1], for well-conditioned equations.
constexpr double middle = (first_wavelength + last_wavelength) / 2;
constexpr double half = (last_wavelength - first_wavelength) / 2;

SmoothReflectance in_nm(const Vec3& c, double scale) {
  const double a = c.x / sqr(half), b = c.y / half;
  return {a, b - 2 * a * middle, (a * middle - b) * middle + c.z, scale};
}

/// The constant v of a flat reflectance, which stays within (0, 1).
double flat_coefficient(double value) {
  const double r = std::clamp(value, 1e-9, 1 - 1e-9);
  return (r - 0.5) / std::sqrt(r * (1 - r));
}

/// Where a fit starts: a flat reflectance, not so near to white that its slopes vanish.
Vec3 flat_start(double value) { return {0, 0, flat_coefficient(std::min(value, 0.99))}; }

/// The linear functional from a reflectance to its colour under D65, as weights of its values every
/// 5 nm. It is scaled, by parts in 10^4, so that the colour of the reflectance 1 is exactly white.
class Observer {
 public:
  static constexpr size_t size = 95;
  static const Observer& get() {
    static const Observer observer;
    return observer;
  }
  const Vec3& weight(size_t i) const { return weights_[i]; }
  static double variable(size_t i) { return -1 + 2 * static_cast<double>(i) / (size - 1); }

 private:
  Observer() {
    constexpr size_t fine = 5;  // steps of the quadrature, of 1 nm, between two weights
    Vec3 white(0.0);
    for (size_t p = 0; p <= (size - 1) * fine; ++p) {
      const double w = first_wavelength + static_cast<double>(p);
      const Vec3 rgb = xyz_to_srgb(matching_functions(w) * d65(w));
      white += rgb;
      const size_t i = std::clamp<size_t>(p / fine, 1, size - 3);
      spread(rgb, i, static_cast<double>(p) / fine - static_cast<double>(i));
    }
    for (Vec3& weight : weights_) weight /= white;
  }
  /// Adds `rgb` times Lagrange's cubic interpolation of the values i - 1 to i + 2, at i + f.
  void spread(const Vec3& rgb, size_t i, double f) {
    weights_[i - 1] -= rgb * (f * (f - 1) * (f - 2) / 6);
    weights_[i] += rgb * ((f + 1) * (f - 1) * (f - 2) / 2);
    weights_[i + 1] -= rgb * ((f + 1) * f * (f - 2) / 2);
    weights_[i + 2] += rgb * ((f + 1) * f * (f - 1) / 6);
  }

  std::array<Vec3, size> weights_{};
};

/// The least squares problem of one colour. Its unknowns are q = c sqrt(m), and residuals are
/// divided by m, the largest component, so that dark colours are found as well as bright ones.
class Fit {
 public:
  explicit Fit(const Color& rgb)
      : target_(rgb), inverse_(1 / max_component(rgb)), scale_(std::sqrt(inverse_)) {}

  /// Levenberg's and Marquardt's method from the coefficients `start`.
  Vec3 solve(const Vec3& start) {
    Vec3 q = start / scale_;
    State state = evaluate(q);
    double damping = 1e-3;
    for (int step = 0; step < max_steps; ++step) {
      const Vec3 move = glm::inverse(state.curvature + Mat3(damping)) * state.gradient;
      const State next = evaluate(q - move);
      if (!(next.cost < state.cost)) {
        damping *= 10;
        if (damping > 1e3) break;
        continue;
      }
      const bool done = state.cost - next.cost < 1e-4 * next.cost || next.cost < tiny_cost;
      q -= move;
      state = next;
      damping *= 0.05;
      if (done) break;
    }
    return q * scale_;
  }

 private:
  /// Half the gradient of a sum of squares and, by Gauss and Newton, half its second derivative.
  struct State {
    double cost;
    Vec3 gradient;
    Mat3 curvature;
  };
  static constexpr int max_steps = 100;
  /// Weighs the squares of the unknowns: keeps them bounded near white and black components.
  static constexpr double regularisation = 1e-9;
  static constexpr double tiny_cost = 1e-12;

  State evaluate(const Vec3& q) const {
    const Observer& observer = Observer::get();
    const Vec3 c = q * scale_;
    Color rgb(0.0);
    Mat3 jacobian(0.0);  // a column for each coefficient
    for (size_t i = 0; i < Observer::size; ++i) {
      const double t = Observer::variable(i);
      const double v = (c.x * t + c.y) * t + c.z;
      const double s = 1 / std::sqrt(1 + v * v);
      const Vec3& weight = observer.weight(i);
      rgb += weight * (0.5 + 0.5 * v * s);
      const Vec3 slope = weight * (0.5 * s * s * s);
      jacobian[0] += slope * (t * t);
      jacobian[1] += slope * t;
      jacobian[2] += slope;
    }
    jacobian *= inverse_ * scale_;
    const Vec3 residual = (rgb - target_) * inverse_;
    const Mat3 transposed = glm::transpose(jacobian);
    return {dot(residual, residual) + regularisation * dot(q, q),
            transposed * residual + regularisation * q,
            transposed * jacobian + Mat3(regularisation)};
  }

  Color target_;
  double inverse_, scale_;
};

constexpr double axis_steps = ReflectanceTable::size - 1;

/// The values along an axis of the table, quadratically closer to each other towards 0 and 1 like
/// the paper's smoothstep, but with a simple inverse: interpolation is linear in the index.
double axis_value(size_t i) {
  const double u = static_cast<double>(i) / axis_steps;
  return u < 0.5 ? 2 * sqr(u) : 1 - 2 * sqr(1 - u);
}
double axis_place(double value) {
  return value < 0.5 ? std::sqrt(value / 2) : 1 - std::sqrt((1 - value) / 2);
}

/// The interval of an axis that holds a value in [0, 1], and the place in it.
struct Interval {
  size_t low;
  double f;

  explicit Interval(double value) {
    const double t = axis_place(value) * axis_steps;
    low = std::min(static_cast<size_t>(t), ReflectanceTable::size - 2);
    f = t - static_cast<double>(low);
  }
};

/// The greater one; a NaN loses against a number.
double within_unit(double x) { return std::min(1.0, std::max(0.0, x)); }
Color within_unit_cube(const Color& c) {
  return {within_unit(c.x), within_unit(c.y), within_unit(c.z)};
}

/// Darker colours have the spectrum of the colour of this brightness, times a scale: without it,
/// the saturated ones would have peaks that are as high as before and ever narrower.
constexpr double darkest = 0.02;

SmoothReflectance flat(double value) { return {0, 0, flat_coefficient(value)}; }

/// The table interpolates coefficients times this, which vary less: those of a flat reflectance are
/// (m - 1/2) / sqrt(m (1 - m)), and those of saturated colours near white are bounded.
double table_scale(double m) { return std::sqrt(m * (1.05 - m)); }

double layer_brightness(size_t layer) { return darkest + (1 - darkest) * axis_value(layer); }

Color color_of(size_t largest, double m, double next, double last) {
  Color rgb;
  rgb[static_cast<int>(largest)] = m;
  rgb[static_cast<int>((largest + 1) % 3)] = m * next;
  rgb[static_cast<int>((largest + 2) % 3)] = m * last;
  return rgb;
}

size_t largest_component(const Color& c) {
  return c.x >= c.y && c.x >= c.z ? 0 : c.y >= c.z ? 1 : 2;
}

}  // namespace

SmoothReflectance fit_reflectance(const Color& rgb) {
  const Color c = within_unit_cube(rgb);
  if (is_grey(c)) return flat(c.x);
  const double m = max_component(c);
  const Color bright = m < darkest ? c / m * darkest : c;
  const Color grey(mean(bright));
  Vec3 found = flat_start(grey.x);
  // Each fit starts near to its solution: from grey at once, a few saturated colours are not found.
  for (const double share : {0.5, 0.8, 0.95, 1.0})
    found = Fit(grey + share * (bright - grey)).solve(found);
  return in_nm(found, std::min(1.0, m / darkest));
}

const ReflectanceTable& ReflectanceTable::get() {
  static const ReflectanceTable table;
  return table;
}

ReflectanceTable::ReflectanceTable() : coefficients_(3 * size * size * size) {
  for (size_t largest = 0; largest < 3; ++largest)
    for (size_t k = 0; k < size; ++k) fill(largest, k);
}

/// Each fit starts at what scales to the coefficients of the next darker one; the first layer, from
/// grey outwards, at those of a neighbour.
void ReflectanceTable::fill(size_t largest, size_t brightness) {
  const double m = layer_brightness(brightness);
  const double darker = layer_brightness(brightness > 0 ? brightness - 1 : 0);
  const double from_darker = std::sqrt(darker / m) / table_scale(darker);
  std::array<Vec3, size> row;  // of the greater i
  row.fill(flat_start(m));
  for (size_t i = size; i-- > 0;)
    for (size_t j = size; j-- > 0;) {
      Vec3 start = row[std::min(j + 1, size - 1)];
      if (brightness > 0)
        start = from_darker * Vec3(coefficients_[index(largest, brightness - 1, i, j)]);
      row[j] = Fit(color_of(largest, m, axis_value(i), axis_value(j))).solve(start);
      coefficients_[index(largest, brightness, i, j)] = Vec3f(row[j] * table_scale(m));
    }
}

SmoothReflectance ReflectanceTable::at(const Color& rgb) const {
  const Color c = within_unit_cube(rgb);
  if (is_grey(c)) return flat(c.x);
  const size_t largest = largest_component(c);
  const double m = c[static_cast<int>(largest)];
  const double bright = std::max(m, darkest);
  const Interval k((bright - darkest) / (1 - darkest));
  const Interval i(c[static_cast<int>((largest + 1) % 3)] / m);
  const Interval j(c[static_cast<int>((largest + 2) % 3)] / m);
  Vec3 sum(0.0);
  for (size_t corner = 0; corner < 8; ++corner) {
    const size_t dk = corner & 1, di = corner >> 1 & 1, dj = corner >> 2;
    const double weight = (dk ? k.f : 1 - k.f) * (di ? i.f : 1 - i.f) * (dj ? j.f : 1 - j.f);
    sum += weight * Vec3(coefficients_[index(largest, k.low + dk, i.low + di, j.low + dj)]);
  }
  return in_nm(sum / table_scale(bright), std::min(1.0, m / darkest));
}

}  // namespace mlt
