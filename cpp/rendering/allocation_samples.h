// Samples from which the division of time is found: what they lose by each threshold, and how much
// their values differ.
#pragma once

#include "base/parallel.h"
#include "rendering/allocation.h"
#include "rendering/coarse_image.h"
#include "rendering/metropolis_algorithm.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace mlt {

/// The thresholds that are tried: half octaves, in units of b.
inline constexpr int threshold_count = 40;
inline double threshold(int i) { return std::exp2(0.5 * i - 5); }
using PerThreshold = std::array<double, threshold_count>;

/// Sums over independent samples of one kind.
struct AllocationSums {
  PerThreshold squares{};  ///< For V.
  PerThreshold above{};    ///< For e.
  double brightest = 0;    ///< The greatest tau.
  double rays = 0, cost_of_ray = 1;
  uint64_t count = 0;

  AllocationSums& operator+=(const AllocationSums& other) {
    for (int i = 0; i < threshold_count; ++i) {
      squares[i] += other.squares[i];
      above[i] += other.above[i];
    }
    brightest = std::max(brightest, other.brightest);
    rays += other.rays;
    count += other.count;
    return *this;
  }
  double mean(double sum) const { return count > 0 ? sum / static_cast<double>(count) : 0.0; }
  /// Cost of a sample in rays of chains; everything else costs about as much as one ray more.
  double cost() const { return cost_of_ray * (1 + mean(rays)); }
};

/// Draws samples, and sums them up.
class AllocationSamples {
 public:
  AllocationSamples(MetropolisAlgorithm& algorithm, const CoarseImage& coarse,
                    const AllocationSettings& settings, const std::atomic<bool>& late)
      : algorithm_(algorithm),
        raster_(algorithm.scene().camera().raster()),
        coarse_(coarse),
        settings_(settings),
        late_(late) {}

  /// Samples that may go to the image.
  AllocationSums draw(SampleTechniques techniques) {
    algorithm_.set_techniques(techniques);
    AllocationSums sums = draw([&] { return algorithm_.sample_source(); }, [](auto&, uint64_t) {});
    sums.cost_of_ray = algorithm_.sample_source()->cost_of_ray();
    return sums;
  }
  /// Samples that tours start from; `starts` becomes what they have found.
  AllocationSums draw(std::vector<Start>& starts) {
    algorithm_.set_techniques(SampleTechniques::all);
    std::array<std::vector<Start>, part_count> found;
    AllocationSums sums =
        draw([&] { return algorithm_.starting_paths(); },
             [&](StartingPaths& paths, uint64_t part) { found[part] = paths.starts(); });
    for (const auto& some : found) starts.insert(starts.end(), some.begin(), some.end());
    sums.cost_of_ray = algorithm_.sample_source()->cost_of_ray();
    return sums;
  }

 private:
  /// Draws pairs of samples with the same image position. The samples of a render are stratified
  /// over the pixels, so that only differences within a pair are noise. `finished(source, part)` is
  /// called for each source.
  template <class MakeSource, class Finished>
  AllocationSums draw(MakeSource&& make_source, Finished&& finished) const {
    std::array<AllocationSums, part_count> sums;
    const uint64_t stream = mix_bits(settings_.seed ^ mix_bits(uint64_t(Purpose::allocation)));
    in_parts(settings_.threads, settings_.samples / 2,
             [&](uint64_t part, uint64_t i, uint64_t last) {
               const auto source = make_source();
               for (; i < last && goes_on(sums[part].count, late_); ++i) {
                 PixelSampler first(stream, static_cast<uint32_t>(i)),
                     second(mix_bits(stream), static_cast<uint32_t>(i));
                 const Vec2 position = raster_.sample(first.next2());
                 second.next2();
                 const PerThreshold a = add(source->sample(position, first), sums[part]),
                                    b = add(source->sample(position, second), sums[part]);
                 for (int t = 0; t < threshold_count; ++t)
                   sums[part].squares[t] += sqr(a[t] - b[t]);
               }
               sums[part].rays = static_cast<double>(source->rays().total());
               finished(*source, part);
             });
    AllocationSums all;
    for (const AllocationSums& one : sums) all += one;
    return all;
  }

  /// Returns the light that the sample adds to its own pixel, clamped at each threshold. All light
  /// that it adds to others by light tracing counts as noise. Light that is left to samples at any
  /// threshold (CertainLight) does not count: lamps are much brighter than the coarse image says of
  /// their surroundings, and so their noise is much less.
  PerThreshold add(const std::vector<FoundLight>& found, AllocationSums& sums) const {
    PerThreshold own_pixel{};
    for (const FoundLight& one : found) {
      if (!(one.weight > 0)) continue;
      sums.brightest = std::max(sums.brightest, one.target_over_density);
      const double value = target_luminance(one.rgb) * coarse_.map(one.raster, one.certainty);
      for (int t = 0; t < threshold_count; ++t) {
        const double clamped =
            value * ClampingWeights::of_sample(one.target_over_density, coarse_.b * threshold(t));
        sums.above[t] += value - clamped;
        if (one.own_pixel)
          own_pixel[t] += clamped;
        else
          sums.squares[t] += sqr(clamped);
      }
    }
    ++sums.count;
    return own_pixel;
  }

  MetropolisAlgorithm& algorithm_;
  const Raster& raster_;
  const CoarseImage& coarse_;
  const AllocationSettings& settings_;
  const std::atomic<bool>& late_;
};

}  // namespace mlt
