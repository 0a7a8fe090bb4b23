// The ids in a pixel, ranked by how much of it each covers: Cryptomatte Specification, "Ranking
// Pixel Filter".
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace mlt {

struct IdCoverage {
  float id;
  double coverage;  ///< Weight of the samples that see it, or its share of the pixel.
};

class RankedCoverage {
 public:
  void add(float id, double weight) {
    for (IdCoverage& sum : sums_)
      if (sum.id == id) {
        sum.coverage += weight;
        return;
      }
    sums_.push_back({id, weight});
  }

  /// The shares of a pixel whose samples have this weight, the largest first. Filters with negative
  /// lobes leave ids with less than nothing: these are left out, and the others are scaled, so that
  /// all together cover as much as before, and never more than 1.
  std::vector<IdCoverage> ranked(double weight) const {
    std::vector<IdCoverage> ranks;
    double sum = 0, positive = 0;
    for (const IdCoverage& one : sums_) {
      sum += one.coverage;
      if (!(one.coverage > 0)) continue;
      positive += one.coverage;
      ranks.push_back(one);
    }
    if (!(weight > 0 && sum > 0)) return {};
    for (IdCoverage& one : ranks) one.coverage *= std::min(sum / weight, 1.0) / positive;
    std::sort(ranks.begin(), ranks.end(), [](const IdCoverage& a, const IdCoverage& b) {
      return std::pair(-a.coverage, a.id) < std::pair(-b.coverage, b.id);
    });
    return ranks;
  }

 private:
  std::vector<IdCoverage> sums_;
};

}  // namespace mlt
