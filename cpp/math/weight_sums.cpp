#include "math/weight_sums.h"

#include <algorithm>

namespace mlt {
namespace {

constexpr int classes_per_octave = 4;
// Classes of the smallest and of the largest positive number.
constexpr int first_class = classes_per_octave * -1074, last_class = classes_per_octave * 1024;

/// The class of a weight: floor(classes_per_octave log2(weight)).
int class_of(double weight) {
  int octave;
  const double fraction = std::frexp(weight, &octave);  // of the octave's end, from 1/2 on
  const int quarters = (fraction >= 0.5946035575013605) + (fraction >= 0.7071067811865476) +
                       (fraction >= 0.8408964152537145);  // 2^-3/4, 2^-1/2, 2^-1/4
  return classes_per_octave * (octave - 1) + quarters;
}

double weight_of(int index) { return std::exp2((index + 0.5) / classes_per_octave); }

}  // namespace

void MeanSums::add(double value) {
  ++count_;
  sum_ += value;
  squares_ += value * value;
}

MeanSums& MeanSums::operator+=(const MeanSums& other) {
  count_ += other.count_;
  sum_ += other.sum_;
  squares_ += other.squares_;
  return *this;
}

double MeanSums::variance_of_mean() const {
  if (count_ < 2) return 0;
  const double n = static_cast<double>(count_);
  return std::max(0.0, squares_ / n - mean() * mean()) / (n - 1);
}

void WeightClasses::add(double weight) {
  if (weight > 0 && std::isfinite(weight)) ++classes_[class_of(weight)];
}

WeightClasses& WeightClasses::operator+=(const WeightClasses& other) {
  for (const auto& [index, count] : other.classes_) classes_[index] += count;
  return *this;
}

uint64_t WeightClasses::carrying_half() const {
  double rest = 0;
  for (const auto& [index, count] : classes_)
    rest += 0.5 * weight_of(index) * static_cast<double>(count);
  uint64_t carrying = 0;
  for (auto it = classes_.rbegin(); it != classes_.rend() && rest > 0; ++it) {
    const double weight = weight_of(it->first), most = static_cast<double>(it->second);
    const double needed = std::ceil(rest / weight);
    carrying += needed < most ? static_cast<uint64_t>(needed) : it->second;
    rest -= weight * most;
  }
  return carrying;
}

void WeightClasses::save(ByteWriter& bytes) const {
  bytes.write<uint64_t>(classes_.size());
  for (const auto& [index, count] : classes_) {
    bytes.write(index);
    bytes.write(count);
  }
}

void WeightClasses::load(ByteReader& bytes) {
  classes_.clear();
  for (auto rest = bytes.read<uint64_t>(); rest > 0; --rest) {
    const int index = bytes.read<int>();
    if (index < first_class || index > last_class)
      throw RenderError("the saved state has a weight that no number can have");
    classes_[index] = bytes.read<uint64_t>();
  }
}

void SampleSums::add(double brightness_weight, double of_chains_weight) {
  brightness.add(brightness_weight);
  of_chains.add(of_chains_weight);
  classes.add(brightness_weight);
}

SampleSums& SampleSums::operator+=(const SampleSums& other) {
  brightness += other.brightness;
  of_chains += other.of_chains;
  classes += other.classes;
  return *this;
}

void SampleSums::save(ByteWriter& bytes) const {
  bytes.write(brightness);
  bytes.write(of_chains);
  classes.save(bytes);
}

void SampleSums::load(ByteReader& bytes) {
  brightness = bytes.read<MeanSums>();
  of_chains = bytes.read<MeanSums>();
  classes.load(bytes);
}

Estimate estimate(const MeanSums& sums) {
  return {sums.mean(), sums.variance_of_mean(), sums.count()};
}

Estimate stratified(const std::vector<MeanSums>& strata, const std::vector<double>& sizes) {
  Estimate sum;
  double size = 0;
  for (const double one : sizes) size += one;
  for (size_t i = 0; i < strata.size(); ++i) {
    if (strata[i].count() == 0) return {};
    const double share = sizes[i] / size;
    sum.mean += share * strata[i].mean();
    sum.variance += share * share * strata[i].variance_of_mean();
    sum.count += strata[i].count();
  }
  return sum;
}

Estimate pooled(const Estimate& a, const Estimate& b) {
  if (a.count + b.count == 0) return {};
  const double share = static_cast<double>(a.count) / static_cast<double>(a.count + b.count);
  return {share * a.mean + (1 - share) * b.mean,
          share * share * a.variance + (1 - share) * (1 - share) * b.variance, a.count + b.count};
}

}  // namespace mlt
