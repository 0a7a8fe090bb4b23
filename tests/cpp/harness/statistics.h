// Statistics for tests: distribution functions, t-tests, and Holm's correction.
//   Press et al., "Numerical Recipes", 3rd ed., secs. 6.2 (gamma) and 6.4 (beta)
//   Welch 1947; Holm 1979, "A simple sequentially rejective multiple test procedure"
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace mlt::test {

/// Q(a, x), the regularised upper incomplete gamma function.
inline double gamma_q(double a, double x) {
  if (x <= 0) return 1;
  const double scale = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1) {  // the series of P
    double term = 1 / a, sum = term;
    for (double n = a + 1; term > sum * 1e-17; ++n) sum += term *= x / n;
    return 1 - sum * scale;
  }
  constexpr double tiny = 1e-300;  // Lentz's method for the continued fraction of Q
  double b = x + 1 - a, c = 1 / tiny, d = 1 / b, h = d;
  for (int i = 1; i < 100000; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = an * d + b;
    if (std::abs(d) < tiny) d = tiny;
    c = b + an / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1 / d;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-16) break;
  }
  return scale * h;
}

/// The probability that a chi-square variable with `dof` degrees of freedom exceeds x.
inline double chi_square_tail(double x, double dof) { return gamma_q(0.5 * dof, 0.5 * x); }

/// I_x(a, b), the regularised incomplete beta function.
inline double incomplete_beta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - incomplete_beta(b, a, 1 - x);
  constexpr double tiny = 1e-300;
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  double c = 1, d = 1 - (a + b) * x / (a + 1);
  d = 1 / (std::abs(d) < tiny ? tiny : d);
  double h = d;
  for (int m = 1; m < 100000; ++m) {
    double change = 1;
    for (const double numerator : {m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
                                   -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))}) {
      d = 1 + numerator * d;
      d = 1 / (std::abs(d) < tiny ? tiny : d);
      c = 1 + numerator / c;
      if (std::abs(c) < tiny) c = tiny;
      change = d * c;
      h *= change;
    }
    if (std::abs(change - 1) < 1e-16) break;
  }
  return front * h / a;
}

inline double normal_cdf(double z) { return 0.5 * std::erfc(-z * std::sqrt(0.5)); }

/// The two-sided p-value of Student's t: P(|T| > |t|).
inline double student_t_two_sided(double t, double dof) {
  return incomplete_beta(0.5 * dof, 0.5, dof / (dof + t * t));
}

inline double student_t_cdf(double t, double dof) {
  const double tail = 0.5 * student_t_two_sided(t, dof);
  return t > 0 ? 1 - tail : tail;
}

/// t with P(|T| > t) = p, by bisection.
inline double student_t_quantile_two_sided(double p, double dof) {
  double low = 0, high = 1;
  while (student_t_two_sided(high, dof) > p && high < 1e300) high *= 2;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (student_t_two_sided(middle, dof) > p ? low : high) = middle;
  }
  return high;
}

/// Running mean and variance (Welford 1962).
class Moments {
 public:
  void add(double x) {
    ++n_;
    const double delta = x - mean_;
    mean_ += delta / n_;
    m2_ += delta * (x - mean_);
  }
  double count() const { return n_; }
  double mean() const { return mean_; }
  double variance() const { return n_ > 1 ? m2_ / (n_ - 1) : 0; }
  double variance_of_mean() const { return n_ > 0 ? variance() / n_ : 0; }

 private:
  double n_ = 0, mean_ = 0, m2_ = 0;
};

inline Moments moments(const std::vector<double>& values) {
  Moments m;
  for (double v : values) m.add(v);
  return m;
}

struct TTest {
  double difference;      // of the means
  double standard_error;  // of that difference
  double t, dof;
  double p_value;  // two-sided; 1 if the samples are constant and equal, 0 if constant and not

  /// The difference that a test at level alpha would have found with this power (one-sided 90 %
  /// by default), so that noise cannot pass for agreement.
  double detectable(double alpha = 1e-3, double power = 0.9) const {
    return standard_error * (student_t_quantile_two_sided(alpha, dof) +
                             student_t_quantile_two_sided(2 * (1 - power), dof));
  }
};

inline TTest t_test(double difference, double variance, double dof) {
  const double se = std::sqrt(variance);
  if (se == 0) return {difference, 0, 0, dof, difference == 0 ? 1.0 : 0.0};
  const double t = difference / se;
  return {difference, se, t, dof, student_t_two_sided(t, dof)};
}

/// Is the mean of the values `expected`? Needs two values at least.
inline TTest one_sample_t_test(const Moments& a, double expected = 0) {
  if (a.count() < 2) throw std::invalid_argument("a t-test needs at least two values");
  return t_test(a.mean() - expected, a.variance_of_mean(), a.count() - 1);
}

/// Are the means of two populations equal, whose variances need not be?
inline TTest welch_t_test(const Moments& a, const Moments& b) {
  if (a.count() < 2 || b.count() < 2)
    throw std::invalid_argument("Welch's t-test needs at least two values on each side");
  const double va = a.variance_of_mean(), vb = b.variance_of_mean(), v = va + vb;
  const double dof =
      v > 0 ? v * v / (va * va / (a.count() - 1) + vb * vb / (b.count() - 1)) : a.count() - 1;
  return t_test(a.mean() - b.mean(), v, dof);
}

/// Holm's adjusted p-values: compare each with alpha, and the chance of even one false rejection in
/// the whole family is below alpha. A NaN counts as 0 (rejected).
inline std::vector<double> holm_adjusted(std::vector<double> p) {
  for (double& x : p)
    if (std::isnan(x)) x = 0;
  std::vector<size_t> order(p.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return p[a] < p[b]; });
  double largest = 0;
  for (size_t i = 0; i < order.size(); ++i) {
    largest = std::max(largest, std::min(1.0, p[order[i]] * static_cast<double>(p.size() - i)));
    p[order[i]] = largest;
  }
  return p;
}

/// Which hypotheses are rejected at the family-wise level alpha.
inline std::vector<bool> holm(const std::vector<double>& p_values, double alpha) {
  std::vector<bool> rejected;
  for (double p : holm_adjusted(p_values)) rejected.push_back(p <= alpha);
  return rejected;
}

/// The smallest of Holm's adjusted p-values of one-sample t-tests, each of one quantity.
inline double smallest_p_value(const std::vector<Moments>& quantities,
                               const std::vector<double>& expected) {
  std::vector<double> p;
  for (size_t i = 0; i < quantities.size(); ++i)
    p.push_back(one_sample_t_test(quantities[i], expected[i]).p_value);
  const std::vector<double> adjusted = holm_adjusted(p);
  return *std::min_element(adjusted.begin(), adjusted.end());
}

}  // namespace mlt::test
