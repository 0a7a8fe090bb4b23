// Chi-square tests of samplers against their densities, on a rectangle or on the sphere.
//
// The cells are made from a pilot run: the domain is halved at medians of pilot samples until each
// cell holds about the same number, so a lobe of any width gets cells that resolve it. The pilot is
// then forgotten; the test counts fresh samples. The density is integrated over each cell by
// adaptive Gauss-Legendre quadrature that is refined where pilot samples lie. Draws that return
// nothing (failures, delta lobes) form one more cell with the expectation n (1 - integral of pdf).
// Cells with too small an expectation are pooled, smallest first.
#pragma once

#include "base/rng.h"
#include "harness/statistics.h"
#include "math/vec.h"

#include <functional>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace mlt::test {

struct ChiSquareResult {
  double p_value = 0;
  double statistic = 0;
  double dof = 0;
  double integral = 0;      // of the pdf over the domain; 1 - integral is the expected failure rate
  double failure_rate = 0;  // of the draws
  std::string problem;  // samples outside of the domain, a negative pdf, ... (p_value is then 0)
};

inline std::ostream& operator<<(std::ostream& out, const ChiSquareResult& r) {
  out << "chi-square " << r.statistic << " with " << r.dof
      << " degrees of freedom, p = " << r.p_value << ", integral of the pdf " << r.integral
      << ", failure rate " << r.failure_rate;
  return r.problem.empty() ? out : out << "; " << r.problem;
}

struct ChiSquareOptions {
  size_t cells = 512;                 // about this many, before pooling
  size_t pilot_samples = 20000;       // to place the cells
  double min_expectation = 5;         // smaller cells are pooled
  int max_depth = 60;                 // of the quadrature's bisection within a cell
  size_t max_evaluations = 20000000;  // of the pdf, in the quadrature
  double integral_tolerance = 2e-3;   // a pdf whose integral exceeds 1 by more is refused
  std::vector<double> x_breaks;       // where the pdf is known to jump: cell edges are put there
  std::vector<double> y_breaks;
};

/// Pearson's test on counts. One degree of freedom is lost to the given total.
inline ChiSquareResult chi_square_counts(const std::vector<double>& observed,
                                         const std::vector<double>& expected,
                                         double min_expectation = 5) {
  std::vector<size_t> order(expected.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return expected[a] < expected[b]; });
  ChiSquareResult result;
  double pooled_observed = 0, pooled_expected = 0;
  int bins = 0;
  const auto close_bin = [&] {
    result.statistic +=
        (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected;
    ++bins;
    pooled_observed = pooled_expected = 0;
  };
  for (size_t i : order) {
    pooled_observed += observed[i];
    pooled_expected += std::max(0.0, expected[i]);
    if (pooled_expected >= min_expectation) close_bin();
  }
  if (pooled_expected > 0) {
    close_bin();
  } else if (pooled_observed > 0) {
    result.problem = "samples where the density is zero";
    return result;
  }
  result.dof = bins - 1;
  result.p_value = bins > 1 ? chi_square_tail(result.statistic, result.dof)
                            : (std::abs(result.statistic) < 1e-6 ? 1 : 0);
  return result;
}

namespace detail {

struct Rect {
  Vec2 low, high;
  double area() const { return (high.x - low.x) * (high.y - low.y); }
};

using Points = std::vector<Vec2>;
using Density2D = std::function<double(const Vec2&)>;

/// A k-d tree of cells. `axis` 2 marks a leaf, whose number is `left`.
struct Cells {
  struct Node {
    int axis = 2;
    double split = 0;
    size_t left = 0, right = 0;
  };
  std::vector<Node> nodes;
  std::vector<Rect> rects;      // of the leaves
  std::vector<Points> samples;  // of the pilot run, in the leaves

  size_t find(const Vec2& p) const {
    size_t i = 0;
    while (nodes[i].axis < 2)
      i = p[nodes[i].axis] < nodes[i].split ? nodes[i].left : nodes[i].right;
    return nodes[i].left;
  }
};

struct CellBuilder {
  const ChiSquareOptions& options;
  size_t leaf_size;
  Cells cells;

  size_t build(const Rect& rect, Points points, int axis) {
    const size_t node = cells.nodes.size();
    cells.nodes.emplace_back();
    std::optional<double> split;
    for (int a = 0; a < 2 && !split; ++a)
      if ((split = break_inside(rect, a))) axis = a;
    for (int tries = 0; tries < 2 && !split && points.size() > leaf_size; ++tries) {
      split = median(rect, points, axis);
      if (!split) axis = 1 - axis;
    }
    if (!split) {
      cells.nodes[node] = {2, 0, cells.rects.size(), 0};
      cells.rects.push_back(rect);
      cells.samples.push_back(std::move(points));
      return node;
    }
    Points below, above;
    for (const Vec2& p : points) (p[axis] < *split ? below : above).push_back(p);
    Rect low = rect, high = rect;
    low.high[axis] = high.low[axis] = *split;
    const size_t left = build(low, std::move(below), 1 - axis);
    const size_t right = build(high, std::move(above), 1 - axis);
    cells.nodes[node] = {axis, *split, left, right};
    return node;
  }

  std::optional<double> break_inside(const Rect& rect, int axis) const {
    for (double b : axis == 0 ? options.x_breaks : options.y_breaks)
      if (b > rect.low[axis] && b < rect.high[axis]) return b;
    return std::nullopt;
  }

  static std::optional<double> median(const Rect& rect, Points& points, int axis) {
    const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
    std::nth_element(points.begin(), middle, points.end(),
                     [axis](const Vec2& a, const Vec2& b) { return a[axis] < b[axis]; });
    const double m = (*middle)[axis];
    if (!(m > rect.low[axis] && m < rect.high[axis])) return std::nullopt;
    return m;
  }
};

/// Integrates a density over a cell: 3 x 3 Gauss points against those of the two halves, either
/// way; the cell is halved across the axis that differs more. So that a narrow peak in a large cell
/// is not overlooked, pilot samples must also be seen, and the border must not stand out (cells are
/// made at medians, which puts borders on peaks).
struct Quadrature {
  const Density2D& pdf;
  double tolerance;     // of one cell's integral
  double pilot_weight;  // the mass that one pilot sample stands for
  int max_depth;
  size_t budget;         // of evaluations of the pdf
  bool invalid = false;  // the pdf was negative, infinite or not a number

  double integrate(const Rect& r, const Points& pilot) {
    return refine(r, pilot, gauss(r), max_depth);
  }

  double gauss(const Rect& r) {
    budget -= std::min<size_t>(budget, 9);
    constexpr double node = 0.77459666924148337704, w0 = 8. / 18, w1 = 5. / 18;
    constexpr double x[3] = {-node, 0, node}, w[3] = {w1, w0, w1};
    const Vec2 center = 0.5 * (r.low + r.high), half = 0.5 * (r.high - r.low);
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double f = pdf({center.x + half.x * x[i], center.y + half.y * x[j]});
        if (!(f >= 0) || !std::isfinite(f)) invalid = true;
        sum += w[i] * w[j] * f;
      }
    return sum * r.area();
  }

  double refine(const Rect& r, const Points& pilot, double coarse, int depth) {
    Rect halves[2][2] = {{r, r}, {r, r}};
    double parts[2][2], sums[2], differences[2];
    for (int axis = 0; axis < 2; ++axis) {
      halves[axis][0].high[axis] = halves[axis][1].low[axis] = 0.5 * (r.low[axis] + r.high[axis]);
      for (int i = 0; i < 2; ++i) parts[axis][i] = gauss(halves[axis][i]);
      sums[axis] = parts[axis][0] + parts[axis][1];
      differences[axis] = std::abs(sums[axis] - coarse);
    }
    int axis = differences[0] > differences[1] ? 0 : 1;
    const double difference = differences[axis];
    const double least = std::min({coarse, sums[0], sums[1]});
    const bool seen = pilot.empty() || difference < 0.1 * least;
    if (depth <= 0 || invalid || budget == 0) return sums[axis];
    if (seen && difference < tolerance) {
      const double across_x = border(r, 0), across_y = border(r, 1);
      if (r.area() * std::max(across_x, across_y) < std::max(8 * least, 4 * tolerance))
        return sums[axis];
      axis = across_x > across_y ? 0 : across_y > across_x ? 1 : depth % 2;
    }
    const double pilot_mass = pilot_weight * static_cast<double>(pilot.size());
    if (pilot.size() >= 4 && std::max(coarse, sums[axis]) < 0.1 * pilot_mass)
      axis = spread(r, pilot, 0) < spread(r, pilot, 1) ? 0 : 1;
    Points inside[2];
    for (const Vec2& p : pilot) inside[p[axis] >= halves[axis][1].low[axis]].push_back(p);
    double sum = 0;
    for (int i = 0; i < 2; ++i)
      sum += refine(halves[axis][i], inside[i], parts[axis][i], depth - 1);
    return sum;
  }

  /// The largest density at the ends and the middle of the two sides across an axis.
  double border(const Rect& r, int axis) {
    double largest = 0;
    for (int side = 0; side < 2; ++side)
      for (double t : {0.0, 0.5, 1.0}) {
        Vec2 p = r.low + t * (r.high - r.low);
        p[axis] = side ? r.high[axis] : r.low[axis];
        largest = std::max(largest, pdf(p));
      }
    return largest;
  }

  /// The part of the cell's side that the pilot samples take up.
  static double spread(const Rect& r, const Points& pilot, int axis) {
    const auto [low, high] =
        std::minmax_element(pilot.begin(), pilot.end(),
                            [axis](const Vec2& a, const Vec2& b) { return a[axis] < b[axis]; });
    return ((*high)[axis] - (*low)[axis]) / (r.high[axis] - r.low[axis]);
  }
};

}  // namespace detail

/// Tests `sample` (nothing: a failed draw) against the density `pdf` on the rectangle [low, high].
inline ChiSquareResult chi_square_rect(const std::function<std::optional<Vec2>(Rng&)>& sample,
                                       const std::function<double(const Vec2&)>& pdf,
                                       const Vec2& low, const Vec2& high, size_t n_samples,
                                       uint64_t seed, const ChiSquareOptions& options = {}) {
  const auto outside = [&](const Vec2& p) {
    return !(p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y);
  };
  const auto failed = [](const std::string& problem) {
    ChiSquareResult result;
    result.problem = problem;
    return result;
  };

  detail::Points pilot;
  Rng pilot_rng(seed, Purpose::test, 0);
  for (size_t i = 0; i < options.pilot_samples; ++i) {
    const std::optional<Vec2> p = sample(pilot_rng);
    if (p && outside(*p)) return failed("a sample lies outside of the domain or is not a number");
    if (p) pilot.push_back(*p);
  }
  const size_t leaf_size = std::max<size_t>(1, options.pilot_samples / options.cells);
  detail::CellBuilder builder{options, leaf_size, {}};
  builder.build({low, high}, std::move(pilot), 1);
  const detail::Cells& cells = builder.cells;

  // An error of 2 % of one standard deviation of the smallest cell's count is invisible.
  const double n = static_cast<double>(n_samples);
  detail::Quadrature quadrature{pdf, 0.02 * std::sqrt(options.min_expectation) / n,
                                1 / static_cast<double>(options.pilot_samples), options.max_depth,
                                options.max_evaluations};
  std::vector<double> expected, observed(cells.rects.size() + 1, 0.0);
  double integral = 0;
  for (size_t i = 0; i < cells.rects.size(); ++i) {
    const double mass = quadrature.integrate(cells.rects[i], cells.samples[i]);
    if (quadrature.invalid) return failed("the pdf is negative, infinite or not a number");
    integral += mass;
    expected.push_back(n * mass);
  }
  if (quadrature.budget == 0)
    return failed("the pdf is too narrow to integrate; more pilot samples would help");
  if (integral > 1 + options.integral_tolerance) {
    ChiSquareResult result = failed("the pdf integrates to more than 1");
    result.integral = integral;
    return result;
  }
  expected.push_back(std::max(0.0, n * (1 - integral)));

  Rng rng(seed, Purpose::test, 1);
  for (size_t i = 0; i < n_samples; ++i) {
    const std::optional<Vec2> p = sample(rng);
    if (p && outside(*p)) return failed("a sample lies outside of the domain or is not a number");
    observed[p ? cells.find(*p) : cells.rects.size()] += 1;
  }
  ChiSquareResult result = chi_square_counts(observed, expected, options.min_expectation);
  result.integral = integral;
  result.failure_rate = observed.back() / n;
  return result;
}

/// Tests a sampler of unit directions against its density in solid angle. `sample` draws from the
/// generator what it needs and returns nothing when it fails or takes a delta lobe; `pdf` is then
/// the density of the rest and integrates to less than 1. The domain is (z, phi), where solid angle
/// is area; the pdf may jump at the horizon z = 0.
inline ChiSquareResult chi_square_sphere(const std::function<std::optional<Vec3>(Rng&)>& sample,
                                         const std::function<double(const Vec3&)>& pdf,
                                         size_t n_samples, uint64_t seed,
                                         ChiSquareOptions options = {}) {
  options.x_breaks.push_back(0);
  return chi_square_rect(
      [&](Rng& rng) -> std::optional<Vec2> {
        const std::optional<Vec3> w = sample(rng);
        if (!w) return std::nullopt;
        const double off = std::abs(length_squared(*w) - 1);
        if (!(off < 1e-6)) return Vec2(std::numeric_limits<double>::quiet_NaN());
        return Vec2(std::min(1.0, std::max(-1.0, w->z)), std::atan2(w->y, w->x));
      },
      [&](const Vec2& p) {
        const double r = std::sqrt((1 - p.x) * (1 + p.x));
        return pdf({r * std::cos(p.y), r * std::sin(p.y), p.x});
      },
      {-1, -pi}, {1, pi}, n_samples, seed, options);
}

}  // namespace mlt::test
