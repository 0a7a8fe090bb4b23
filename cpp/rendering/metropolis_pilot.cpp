#include "rendering/metropolis_pilot.h"

#include "base/parallel.h"
#include "markov/bootstrap.h"
#include "rendering/pilot_noise.h"

#include <cmath>
#include <map>

namespace mlt {
namespace {

/// The light that one chain adds to the pixels, for each of `thresholds`.
using PixelSums = std::map<std::pair<int, int>, PerThreshold>;

struct Forecast {
  Allocation allocation;
  double variance = 0;  ///< Expected variance, times the time.
};

/// With this number of steps, tours are more work than the sample that they start from. The fewer,
/// the more samples look for rare light.
constexpr double least_steps_per_sample = 16;

/// Up to this ratio of variances the samples are preferred: their noise is known better.
constexpr double hardly = 1.15;

class Pilot {
 public:
  Pilot(MetropolisAlgorithm& algorithm, const Raster& raster, const TypicalBrightness& typical,
        const PilotSettings& settings, const std::atomic<bool>& cancelled)
      : algorithm_(algorithm),
        raster_(raster),
        typical_(typical),
        settings_(settings),
        cancelled_(cancelled),
        candidates_{settings.seed, Purpose::allocation, settings.samples} {}

  /// Estimates b from candidates; 0: there is no light for chains to start from.
  double find_starts() {
    const std::vector<double> weights = draw_candidates(
        candidates_, settings_.threads, cancelled_, [&] { return algorithm_.source(); },
        [&](MetropolisAlgorithm::Source& source, Rng& rng) {
          return weigh(source, raster_, RandomSampler(rng)).target;
        },
        [](const MetropolisAlgorithm::Source&) {});
    Rng rng = candidates_.rng(candidates_.count);
    starts_ = resample(weights, settings_.chains, rng);
    return starts_.b;
  }

  /// Draws pairs of samples with the same image position. The samples of a render are stratified
  /// over the pixels, so that only differences within a pair are noise.
  /// Returns false if the algorithm has none of these techniques.
  bool draw_samples(SampleTechniques techniques) {
    if (!algorithm_.set_techniques(techniques)) return false;
    techniques_ = techniques;
    samples_ = {};
    std::array<Noise, part_count> noise;
    const uint64_t stream = mix_bits(settings_.seed ^ mix_bits(uint64_t(Purpose::allocation)));
    in_parts(settings_.threads, settings_.samples / 2,
             [&](uint64_t part, uint64_t i, uint64_t last) {
               const auto source = algorithm_.sample_source();
               for (; i < last && !cancelled_; ++i) {
                 PixelSampler first(stream, static_cast<uint32_t>(i)),
                     second(mix_bits(stream), static_cast<uint32_t>(i));
                 const Vec2 position = raster_.sample(first.next2());
                 second.next2();
                 const PerThreshold a = add_sample(source->sample(position, first), noise[part]),
                                    b = add_sample(source->sample(position, second), noise[part]);
                 for (size_t t = 0; t < thresholds.size(); ++t)
                   noise[part].squares[t] += sqr(a[t] - b[t]);
               }
               noise[part].rays = source->rays().total();
               noise[part].cost_of_ray = source->cost_of_ray();
             });
    for (const Noise& one : noise) samples_ += one;
    return true;
  }
  /// Whether rare paths make most of the noise of samples, or much of it as chains tell it. The
  /// chains of a pilot have hardly found them, and seem less noisy than they will be. What is rare
  /// for path tracing alone does not count for chains: tours start from samples of all techniques.
  bool has_rare_light() const {
    return share_of_rare_light(samples_.squares) > 0.5 ||
           (techniques_ == SampleTechniques::all && share_of_rare_light(chains_.of_samples) > 0.4);
  }

  /// With a share s of the time the variance is v1 c1 / s + v2 c2 / (1 - s); it is least, and (sqrt
  /// (v1 c1) + sqrt(v2 c2))^2, for s / (1 - s) = sqrt(v1 c1) / sqrt(v2 c2).
  Forecast forecast() {
    const double greatest_share =
        has_rare_light() ? settings_.greatest_share_with_rare_light : settings_.greatest_share;
    Allocation best;
    best.techniques = techniques_;
    if (samples_.count == 0 || chains_.count == 0) return {best};  // cancelled
    best.mutations_per_sample = samples_.cost() / chains_.cost();
    const double mutations_per_start =
        best.mutations_per_sample * algorithm_.source()->cost_of_ray() / samples_.cost_of_ray;
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < thresholds.size(); ++i) {
      const double v1 = samples_.cost() * samples_.square(i),
                   v2 = chains_.cost() * chains_.square(i);
      const double share = settings_.share.value_or(std::clamp(
          std::sqrt(v1) / (std::sqrt(v1) + std::sqrt(v2)), settings_.least_share, greatest_share));
      const double variance = v1 / share + v2 / (1 - share);
      if (!(variance < hardly * least)) continue;
      least = std::min(least, variance);
      best.share = share;
      best.weights = weights(i);
      best.steps_per_sample = mutations_per_start * (1 - share) / share;
    }
    return {best, least};
  }

  /// Sums squares of all that a chain adds to a pixel: staying in one makes the image noisier.
  void run_chains() {
    chains_ = {};
    const std::vector<uint32_t>& seeds = starts_.seeds;
    struct Recorder : ChainRecorder {
      explicit Recorder(const Pilot& p) : pilot(p) {}
      void record(const Vec2& raster, const Color& rgb_per_target, double weight,
                  double target_over_density) override {
        const double relative = pilot.relative(rgb_per_target, raster),
                     value = weight * pilot.starts_.b * relative;
        PerThreshold& sums = pixels[{static_cast<int>(std::floor(raster.x)),
                                     static_cast<int>(std::floor(raster.y))}];
        for (size_t t = 0; t < thresholds.size(); ++t) {
          const FamilyWeights weights = pilot.weights(t);
          sums[t] += value * weights.of_chain(target_over_density);
          of_samples[t] +=
              value * relative * target_over_density * sqr(weights.of_sample(target_over_density));
        }
      }
      const Pilot& pilot;
      PixelSums pixels;
      PerThreshold of_samples{};
    };
    const auto together = static_cast<size_t>(algorithm_.chains_together());
    std::vector<Noise> noise((seeds.size() + together - 1) / together);
    parallel_for(settings_.threads, noise.size(), [&](uint64_t team) {
      if (cancelled_) return;
      const size_t first = team * together, last = std::min(first + together, seeds.size());
      std::vector<std::unique_ptr<RenderChain>> chains;
      std::vector<Recorder> recorders(last - first, Recorder(*this));
      std::vector<ChainVisit> visits;
      for (size_t i = first; i < last; ++i) {
        const ChainId id{settings_.seed,      0,
                         static_cast<int>(i), static_cast<int>(seeds.size()),
                         starts_.b,           Purpose::allocation};
        chains.push_back(algorithm_.start(id, candidates_.rng(seeds[i]),
                                          candidates_.rng(candidates_.count + 1 + i)));
        visits.push_back({chains.back().get(), &recorders[i - first]});
      }
      algorithm_.advance(visits, settings_.steps);
      Noise& sum = noise[team];
      for (const Recorder& recorder : recorders) {
        for (size_t t = 0; t < thresholds.size(); ++t) sum.of_samples[t] += recorder.of_samples[t];
        for (const auto& [pixel, sums] : recorder.pixels)
          for (size_t t = 0; t < thresholds.size(); ++t) sum.squares[t] += sqr(sums[t]);
      }
      sum.count = settings_.steps * chains.size();
      for (const auto& chain : chains) sum.rays += chain->stats().rays.total();
    });
    for (const Noise& one : noise) chains_ += one;
  }

 private:
  /// The weight of light in the noise: its share of the brightness of its pixel.
  double relative(const Color& rgb, const Vec2& raster) const {
    return target_luminance(rgb) / typical_(raster);
  }
  FamilyWeights weights(size_t i) const { return FamilyWeights(starts_.b * thresholds[i]); }

  /// Returns the light that the sample adds to its own pixel. All light that it adds to others by
  /// light tracing counts as noise.
  PerThreshold add_sample(const std::vector<FoundLight>& found, Noise& noise) const {
    PerThreshold own_pixel{};
    for (const FoundLight& one : found) {
      const double value = relative(one.rgb, one.raster);
      for (size_t t = 0; t < thresholds.size(); ++t) {
        const double weighted = value * weights(t).of_sample(one.target_over_density);
        if (one.own_pixel)
          own_pixel[t] += weighted;
        else
          noise.squares[t] += sqr(weighted);
      }
    }
    ++noise.count;
    return own_pixel;
  }

  MetropolisAlgorithm& algorithm_;
  const Raster& raster_;
  const TypicalBrightness& typical_;
  const PilotSettings& settings_;
  const std::atomic<bool>& cancelled_;
  Candidates candidates_;
  Bootstrap starts_;
  SampleTechniques techniques_ = SampleTechniques::all;
  Noise samples_, chains_;
};

/// Rounds x, so that a scene in another unit of length has the same image to the last bit.
double to_half_octaves(double x) { return std::exp2(std::round(2 * std::log2(x)) / 2); }

/// Sets weights and lengths of tours. For N1 samples and N2 independent steps c would be b N1 / N2
/// (see FamilyWeights). Steps that follow each other are alike, and the larger the share of the
/// samples, the noisier the chains were in the pilot: 3 / sqrt(1 - share) of them count as one.
void set_tours(Allocation& allocation, double b) {
  const double share = allocation.share,
               steps = allocation.mutations_per_sample * (1 - share) / share;
  allocation.weights = FamilyWeights(b / to_half_octaves(steps * std::sqrt(1 - share) / 3));
  allocation.b = b;
  allocation.steps_per_sample =
      std::max(to_half_octaves(allocation.steps_per_sample), least_steps_per_sample);
}

Allocation chains_alone(double b) {
  Allocation allocation;
  allocation.b = b;
  allocation.steps_per_sample = least_steps_per_sample;
  return allocation;
}

}  // namespace

Allocation allocate(MetropolisAlgorithm& algorithm, const Raster& raster,
                    const TypicalBrightness& typical, const PilotSettings& settings,
                    const std::atomic<bool>& cancelled) {
  Pilot pilot(algorithm, raster, typical, settings, cancelled);
  const SampleTechniques first = settings.techniques.value_or(SampleTechniques::all);
  algorithm.set_techniques(first);
  const double b = pilot.find_starts();
  if (cancelled) return samples_alone(first);
  if (!(b > 0) && settings.share == 0) throw no_light_found(settings.samples);
  if (!(b > 0)) return samples_alone(first);
  if (settings.share == 0) return chains_alone(b);
  pilot.draw_samples(first);
  pilot.run_chains();
  Forecast best = pilot.forecast();
  if (!settings.techniques && pilot.draw_samples(SampleTechniques::path_tracing)) {
    pilot.run_chains();
    if (const Forecast other = pilot.forecast(); other.variance < best.variance) best = other;
  }
  algorithm.set_techniques(best.allocation.techniques);
  if (algorithm.has_tours() && best.variance > 0) set_tours(best.allocation, b);
  return best.allocation;
}

}  // namespace mlt
