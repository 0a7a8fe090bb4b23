#include "image/filter.h"

#include "base/error.h"
#include "math/vec.h"

#include <algorithm>

namespace mlt {

Filter::Filter(const std::string& name, double radius, const std::function<double(double)>& shape)
    : name_(name),
      radius_(radius),
      scale_(intervals / radius),
      box_(name == "box" && radius == 0.5) {
  for (int i = 0; i <= intervals; ++i) table_.push_back(shape(radius * i / intervals));
  double sum = 0.5 * (table_.front() + table_.back());
  for (size_t i = 1; i + 1 < table_.size(); ++i) sum += table_[i];
  const double integral = 2 * sum * radius / intervals;
  if (!(integral > 0) || !std::isfinite(integral))
    throw UsageError("filter '" + name + "': its parameters give it no positive weight");
  for (double& value : table_) {
    value /= integral;
    largest_ = std::max(largest_, std::abs(value));
  }
}

bool Filter::has_negative_lobes() const {
  return std::any_of(table_.begin(), table_.end(), [](double value) { return value < 0; });
}

namespace {

constexpr double max_radius = 64;

void check_range(const char* filter, const char* parameter, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw UsageError(fmt::format("filter '{}': {} is {:f}; it must lie between {:f} and {:f}", filter,
                               parameter, value, low, high));
}

/// Mitchell & Netravali, "Reconstruction Filters in Computer Graphics", 1988, eq. 8, for x >= 0.
double mitchell_shape(double x, double b, double c) {
  const double x2 = x * x, x3 = x2 * x;
  if (x < 1) return ((12 - 9 * b - 6 * c) * x3 + (-18 + 12 * b + 6 * c) * x2 + (6 - 2 * b)) / 6;
  if (x < 2) {
    return ((-b - 6 * c) * x3 + (6 * b + 30 * c) * x2 + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) /
           6;
  }
  return 0;
}

double sinc(double x) { return x == 0 ? 1 : std::sin(pi * x) / (pi * x); }

}  // namespace

Filter box_filter(double radius) {
  check_range("box", "radius", radius, 0.01, max_radius);
  return {"box", radius, [](double) { return 1.0; }};
}

Filter tent_filter(double radius) {
  check_range("tent", "radius", radius, 0.01, max_radius);
  return {"tent", radius, [radius](double x) { return 1 - x / radius; }};
}

Filter gaussian_filter(double stddev) {
  check_range("gaussian", "stddev", stddev, 0.01, max_radius / 4);
  const double radius = 4 * stddev, alpha = -1 / (2 * stddev * stddev);
  const double floor = std::exp(alpha * radius * radius);
  return {"gaussian", radius,
          [alpha, floor](double x) { return std::max(0.0, std::exp(alpha * x * x) - floor); }};
}

Filter mitchell_filter(double b, double c) {
  check_range("mitchell", "B", b, -4, 4);
  check_range("mitchell", "C", c, -4, 4);
  return {"mitchell", 2, [b, c](double x) { return mitchell_shape(x, b, c); }};
}

Filter catmullrom_filter() {
  return {"catmullrom", 2, [](double x) { return mitchell_shape(x, 0, 0.5); }};
}

Filter lanczos_filter(int lobes) {
  check_range("lanczos", "lobes", lobes, 1, 16);
  return Filter("lanczos", lobes, [lobes](double x) { return sinc(x) * sinc(x / lobes); });
}

}  // namespace mlt
