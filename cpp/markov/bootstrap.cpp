#include "markov/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mlt {

Bootstrap resample(const std::vector<double>& weights, uint32_t chains, Rng& rng) {
  Bootstrap result;
  const double n = static_cast<double>(weights.size());
  double sum = 0, sum_of_squares = 0;
  for (const double w : weights) {
    sum += w;
    sum_of_squares += w * w;
  }
  if (!(sum > 0)) return result;
  result.b = sum / n;
  if (n > 1)
    result.b_error = std::sqrt(std::max(0.0, sum_of_squares / n - result.b * result.b) / (n - 1));

  const double spacing = sum / chains;
  double next = rng.next() * spacing, cumulative = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    cumulative += weights[i];
    for (; next < cumulative && result.seeds.size() < chains; next += spacing)
      result.seeds.push_back(static_cast<uint32_t>(i));
  }
  // by rounding, the last seed may be unassigned: it is the last candidate with any weight
  for (size_t i = weights.size(); result.seeds.size() < chains;)
    if (weights[--i] > 0) result.seeds.resize(chains, static_cast<uint32_t>(i));
  // Systematic order would tie a chain's number to its candidate; which chain gets which is chance.
  for (size_t i = result.seeds.size(); i > 1; --i)
    std::swap(result.seeds[i - 1], result.seeds[rng.below(i)]);
  return result;
}

}  // namespace mlt
