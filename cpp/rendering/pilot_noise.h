// The noise of samples and of chains in a pilot, for several weights of both (FamilyWeights).
#pragma once

#include <array>
#include <cstdint>

namespace mlt {

/// The thresholds c of FamilyWeights that are tried, in units of b.
inline constexpr std::array<double, 8> thresholds = {1. / 16, 1. / 4, 1, 4, 16, 64, 256, 1024};
using PerThreshold = std::array<double, thresholds.size()>;

/// The noise of one family, in units of the brightness of each pixel, and its cost.
struct Noise {
  PerThreshold squares{};
  PerThreshold of_samples{};  ///< The squares of samples, estimated by chains: f^2 / P.
  uint64_t count = 0, rays = 0;
  double cost_of_ray = 1;

  Noise& operator+=(const Noise& other) {
    for (size_t i = 0; i < thresholds.size(); ++i) {
      squares[i] += other.squares[i];
      of_samples[i] += other.of_samples[i];
    }
    count += other.count;
    rays += other.rays;
    cost_of_ray = other.cost_of_ray;
    return *this;
  }
  double n() const { return static_cast<double>(count); }
  /// Cost of a sample in rays; everything else costs about as much as one ray more.
  double cost() const { return cost_of_ray * (1 + static_cast<double>(rays) / n()); }
  double square(size_t threshold) const { return squares[threshold] / n(); }
};

/// The share of paths with a T / P above 64 b in the noise of samples.
inline double share_of_rare_light(const PerThreshold& squares) {
  return 1 - squares[thresholds.size() - 3] / squares.back();
}

}  // namespace mlt
