// Sums of the weights of independent samples.
#pragma once

#include "base/bytes.h"

#include <cmath>
#include <map>

namespace mlt {

/// Mean and standard error of numbers that are added one by one.
class MeanSums {
 public:
  void add(double value);
  MeanSums& operator+=(const MeanSums& other);

  uint64_t count() const { return count_; }
  double mean() const { return count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0; }
  /// Squared standard error of the mean.
  double variance_of_mean() const;

 private:
  uint64_t count_ = 0;
  double sum_ = 0, squares_ = 0;
};

/// A histogram of positive numbers, which tells how many of them carry most of their sum.
class WeightClasses {
 public:
  void add(double weight);
  WeightClasses& operator+=(const WeightClasses& other);

  /// How many of the largest numbers carry half of the sum.
  uint64_t carrying_half() const;

  void save(ByteWriter& bytes) const;
  void load(ByteReader& bytes);

 private:
  std::map<int, uint64_t> classes_;  ///< How many numbers there are in each quarter of an octave.
};

/// Sums over independent samples of an image for its brightness, the mean of L*.
struct SampleSums {
  MeanSums brightness;    ///< L* / p.
  MeanSums of_chains;     ///< w2 L* / p, the part of the light that chains record.
  WeightClasses classes;  ///< Histogram of L* / p.

  void add(double brightness_weight, double of_chains_weight);
  SampleSums& operator+=(const SampleSums& other);
  uint64_t count() const { return brightness.count(); }
  void save(ByteWriter& bytes) const;
  void load(ByteReader& bytes);
};

/// A mean, its squared standard error, and the number of samples that it was made from.
struct Estimate {
  double mean = 0, variance = 0;
  uint64_t count = 0;
};

Estimate estimate(const MeanSums& sums);
/// The mean over strata of different sizes; no estimate as long as one of them has no sample.
Estimate stratified(const std::vector<MeanSums>& strata, const std::vector<double>& sizes);
/// The mean of two independent estimates, weighted by their numbers of samples.
Estimate pooled(const Estimate& a, const Estimate& b);

}  // namespace mlt
