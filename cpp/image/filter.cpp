#include "image/filter.h"

#include <functional>

#include "base/error.h"
#include "math/vec.h"

namespace mlt {

/// Builds a filter from the right half of its shape, which need not be normalised.
class FilterTable {
 public:
  static Filter make(const std::string& name, double radius,
                     const std::function<double(double)>& shape) {
    Filter filter;
    filter.name_ = name;
    filter.radius_ = radius;
    filter.scale_ = Filter::intervals / radius;
    for (int i = 0; i <= Filter::intervals; ++i)
      filter.table_.push_back(shape(radius * i / Filter::intervals));
    normalise(&filter);
    return filter;
  }

  static Filter make_box(double radius) {
    Filter filter = make("box", radius, [](double) { return 1.0; });
    filter.box_ = radius == 0.5;
    return filter;
  }

 private:
  static void normalise(Filter* filter) {
    std::vector<double>& table = filter->table_;
    double sum = 0.5 * (table.front() + table.back());
    for (size_t i = 1; i + 1 < table.size(); ++i) sum += table[i];
    const double integral = 2 * sum * filter->radius_ / Filter::intervals;
    if (!(integral > 0) || !std::isfinite(integral))
      throw UsageError("filter '" + filter->name_ + "': its parameters give it no positive weight");
    for (double& value : table) value /= integral;
  }
};

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
  return FilterTable::make_box(radius);
}

Filter tent_filter(double radius) {
  check_range("tent", "radius", radius, 0.01, max_radius);
  return FilterTable::make("tent", radius, [radius](double x) { return 1 - x / radius; });
}

Filter gaussian_filter(double stddev) {
  check_range("gaussian", "stddev", stddev, 0.01, max_radius / 4);
  const double radius = 4 * stddev, alpha = -1 / (2 * stddev * stddev);
  const double floor = std::exp(alpha * radius * radius);
  return FilterTable::make("gaussian", radius, [alpha, floor](double x) {
    return std::max(0.0, std::exp(alpha * x * x) - floor);
  });
}

Filter mitchell_filter(double b, double c) {
  check_range("mitchell", "B", b, -4, 4);
  check_range("mitchell", "C", c, -4, 4);
  return FilterTable::make("mitchell", 2, [b, c](double x) { return mitchell_shape(x, b, c); });
}

Filter catmullrom_filter() {
  return FilterTable::make("catmullrom", 2, [](double x) { return mitchell_shape(x, 0, 0.5); });
}

Filter lanczos_filter(int lobes) {
  check_range("lanczos", "lobes", lobes, 1, 16);
  return FilterTable::make("lanczos", lobes,
                           [lobes](double x) { return sinc(x) * sinc(x / lobes); });
}

}  // namespace mlt
