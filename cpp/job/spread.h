// Mean and variance of each value of an image over the independent groups.
#pragma once

#include "math/vec.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace mlt {

/// A mean, and the square of its standard error.
struct MeanWithError {
  double mean, variance;
};

/// Weighted mean and variance, value by value. D. West, "Updating mean and variance estimates: an
/// improved method", CACM 1979.
class Spread {
 public:
  void add(const std::vector<float>& values, double weight) {
    if (count_ == 0) {
      mean_.resize(values.size());
      squares_.resize(values.size());
      largest_.assign(values.size(), {-std::numeric_limits<float>::infinity(), 0});
    }
    weight_ += weight;
    ++count_;
    for (size_t i = 0; i < values.size(); ++i) {
      const double difference = values[i] - mean_[i];
      mean_[i] += static_cast<float>(difference * weight / weight_);
      squares_[i] += static_cast<float>(weight * difference * (values[i] - mean_[i]));
      if (values[i] > largest_[i].value) largest_[i] = {values[i], static_cast<float>(weight)};
    }
  }

  int count() const { return count_; }
  double weight() const { return weight_; }
  size_t size() const { return mean_.size(); }
  const std::vector<float>& mean() const { return mean_; }
  double variance(size_t i) const { return std::max(0.0f, squares_[i]) / ((count_ - 1) * weight_); }

  /// Mean and variance without the group of the largest value, if that is further from the mean of
  /// the others than four of their standard deviations.
  MeanWithError without_outlier(size_t i) const {
    constexpr double far = 4;
    const double w = largest_[i].weight, rest = weight_ - w, away = largest_[i].value - mean_[i];
    if (count_ < 3 || !(rest > 0)) return {mean_[i], variance(i)};
    const double mean = mean_[i] - w * away / rest;
    const double squares = std::max(0.0, squares_[i] - w * away * (largest_[i].value - mean));
    const double variance_of_one = squares / rest * (count_ - 1) / (count_ - 2);
    if (sqr(largest_[i].value - mean) <= sqr(far) * variance_of_one) return {mean_[i], variance(i)};
    return {mean, variance_of_one / (count_ - 1)};
  }

 private:
  struct Largest {
    float value, weight;
  };
  int count_ = 0;
  double weight_ = 0;
  std::vector<float> mean_, squares_;
  std::vector<Largest> largest_;
};

}  // namespace mlt
