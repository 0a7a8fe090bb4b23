// The weights of independent samples, summed up.
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

/// How the light that positive numbers stand for is spread over them.
class WeightClasses {
 public:
  void add(double weight);
  WeightClasses& operator+=(const WeightClasses& other);

  /// How many of them, the largest, carry half of the sum.
  uint64_t carrying_half() const;

  void save(ByteWriter& bytes) const;
  void load(ByteReader& bytes);

 private:
  std::map<int, uint64_t> classes_;  ///< How many there are in each quarter of an octave.
};

/// What independent samples of paths tell, each sample by the sums over its paths.
struct SampleSums {
  MeanSums target;        ///< T / p: its mean is b.
  MeanSums brightness;    ///< L* / p: its mean is the brightness of the image.
  MeanSums of_chains;     ///< w2 L* / p: the brightness of the part that chains show.
  WeightClasses classes;  ///< Of the brightness.

  void add(double target_weight, double brightness_weight, double of_chains_weight);
  SampleSums& operator+=(const SampleSums& other);
  uint64_t count() const { return target.count(); }
  void save(ByteWriter& bytes) const;
  void load(ByteReader& bytes);
};

}  // namespace mlt
