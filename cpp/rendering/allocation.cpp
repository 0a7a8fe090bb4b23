#include "rendering/allocation.h"

#include "rendering/allocation_samples.h"

#include <limits>

namespace mlt {
namespace {

/// a: steps of a chain that count as an independent one.
constexpr double like_one = 3;

/// A, pixels of the island in which a tour moves about: a share of the image, or this many.
constexpr double island_share = 1. / 64, least_island = 256;

/// Bounds of the samples' share of the time; the greatest where tours have anything to do.
constexpr double least_share = 0.05, greatest_share = 0.95, greatest_share_beside_tours = 0.8;

/// The least share of the time for the samples that tours start from, which look for rare light.
constexpr double least_share_of_starts = 0.03;

/// A J this much above another is as good: tours have their part of the time then, since what is
/// rare is hardly known, and samples are those of path tracing, whose noise is known better.
constexpr double hardly = 1.15;

/// Work for a start of tours, in steps, if there are no other samples.
constexpr double steps_of_tours_alone = 16;

/// The numbers of starts per sample that are tried.
constexpr int start_count = 10;
double starts_per_sample(int k) { return std::exp2(k - 7); }

/// Rounds x, so that a scene in another unit of length has the same image to the last bit.
double to_half_octaves(double x) { return std::exp2(std::round(2 * std::log2(x)) / 2); }

/// A division of the time, with its J.
struct Choice {
  Allocation allocation;
  double j = std::numeric_limits<double>::infinity();
};

/// What is known about one kind of samples, and about what tours start from.
class Forecast {
 public:
  Forecast(SampleTechniques techniques, const AllocationSums& samples, double b,
           double cost_of_mutation)
      : techniques_(techniques), samples_(samples), b_(b), t_m_(cost_of_mutation) {}
  void set_starts(const std::vector<Start>& starts, const AllocationSums& samples, double pixels) {
    starts_ = starts;
    island_ = std::max(least_island, island_share * pixels);
    start_samples_ = static_cast<double>(samples.count);
    t_0_ = samples.cost();
  }

  /// The division for chains whose target is T.
  Choice of_chains(int i) const {
    const double c = b_ * threshold(i), e = samples_.mean(samples_.above[i]),
                 work = like_one * b_ / c * t_m_;
    return choice(c, e, work, samples_.mean(samples_.squares[i]) + c * e);
  }

  /// The division for tours, with the best number of starts.
  Choice of_tours(int i) const {
    const double c = b_ * threshold(i);
    const Left left = left_by(c);
    const double variance = samples_.mean(samples_.squares[i]) + left.unseen + c * left.e;
    Choice best;
    for (int k = 0; k < start_count; ++k) {
      const double n = starts_per_sample(k), expected = like_one * left.e / c * t_m_ + n * t_0_;
      if (n * t_0_ < least_share_of_starts * (samples_.cost() + expected)) continue;
      const double steps = to_half_octaves(expected / (n * t_m_));
      Choice one = choice(c, left.e, n * steps * t_m_, variance + left.squares[k] / (n * island_));
      if (!(one.j < best.j)) continue;
      one.allocation.kappa0 = n * c / like_one;
      one.allocation.steps_per_start = steps;
      best = one;
    }
    return best;
  }

 private:
  /// What samples that are clamped at c leave to tours.
  struct Left {
    double e = 0;
    /// The second moment of clamped samples, of light that none of them has found.
    double unseen = 0;
    std::array<double, start_count> squares{};  ///< E[E^2; E > n c A]
  };
  Left left_by(double c) const {
    Left left;
    for (const Start& start : starts_) {
      const double tau = techniques_ == SampleTechniques::all ? start.energy : start.traced,
                   energy = start.energy * ClampingWeights(c).of_chain(tau),
                   share = start.count / start_samples_;
      if (tau > samples_.brightest)
        left.unseen += share * start.energy * sqr(std::min(c, tau)) / tau;
      left.e += share * energy;
      for (int k = 0; k < start_count; ++k)
        if (energy > starts_per_sample(k) * c * island_) left.squares[k] += share * sqr(energy);
    }
    return left;
  }

  Choice choice(double c, double left, double work, double variance) const {
    Choice choice;
    choice.j = variance * (samples_.cost() + work);
    choice.allocation.share = samples_.cost() / (samples_.cost() + work);
    choice.allocation.weights = ClampingWeights(c);
    choice.allocation.mutations_per_sample = samples_.cost() / t_m_;
    choice.allocation.techniques = techniques_;
    choice.allocation.brightness = b_;
    choice.allocation.left = left;
    return choice;
  }

  SampleTechniques techniques_;
  AllocationSums samples_;
  double b_, t_m_;
  // What tours start from:
  std::vector<Start> starts_;
  double start_samples_ = 1;  ///< How many samples have found them.
  double t_0_ = 0, island_ = least_island;
};

std::vector<Forecast> forecasts(MetropolisAlgorithm& algorithm, const CoarseImage& coarse,
                                std::optional<SampleTechniques> techniques,
                                AllocationSamples samples) {
  std::vector<Forecast> forecasts;
  std::vector<Start> starts;
  const SampleTechniques first = techniques.value_or(SampleTechniques::all);
  const bool tours = algorithm.has_tours();
  const AllocationSums of_starts = tours ? samples.draw(starts) : AllocationSums();
  const auto add = [&](SampleTechniques kind) {
    const bool known = tours && kind == SampleTechniques::all;
    const AllocationSums sums = known ? of_starts : samples.draw(kind);
    forecasts.emplace_back(kind, sums, coarse.b, algorithm.cost_of_mutation(sums.mean(sums.rays)));
    if (tours)
      forecasts.back().set_starts(starts, of_starts, algorithm.scene().camera().raster().pixels());
  };
  add(first);
  if (!techniques && algorithm.set_techniques(SampleTechniques::path_tracing))
    add(SampleTechniques::path_tracing);
  return forecasts;
}

/// The best division with one kind of samples, or one with the share that is given, as nearly as
/// may be. J is flat about its least, and known by few samples: of the thresholds with hardly more
/// the middle one is taken.
Choice best_of(const Forecast& forecast, bool tours, std::optional<double> share) {
  std::vector<Choice> choices, with_tours;
  for (int i = 0; i < threshold_count; ++i) {
    const Choice one = tours ? forecast.of_tours(i) : forecast.of_chains(i);
    if (!std::isfinite(one.j) || one.allocation.share < least_share) continue;
    if (!tours && one.allocation.share > greatest_share) continue;
    choices.push_back(one);
    if (tours && one.allocation.share <= greatest_share_beside_tours) with_tours.push_back(one);
    if (tours && one.allocation.left == 0) break;  // greater thresholds are no other
  }
  if (choices.empty()) return {};
  const auto least = [](const std::vector<Choice>& choices, auto&& rank) {
    return *std::min_element(choices.begin(), choices.end(),
                             [&](const Choice& a, const Choice& b) { return rank(a) < rank(b); });
  };
  if (share)
    return least(choices, [&](const Choice& a) { return std::abs(a.allocation.share - *share); });
  const auto j_of = [](const Choice& a) { return a.j; };
  if (!with_tours.empty() && least(with_tours, j_of).j < hardly * least(choices, j_of).j)
    choices = with_tours;
  const double most = hardly * least(choices, j_of).j;
  choices.erase(
      std::remove_if(choices.begin(), choices.end(), [&](const Choice& a) { return a.j > most; }),
      choices.end());
  return choices[choices.size() / 2];
}

}  // namespace

Allocation tours_alone(double b, double steps_per_start) {
  Allocation allocation;
  allocation.brightness = allocation.left = b;
  allocation.kappa0 = b / steps_per_start;
  allocation.steps_per_start = steps_per_start;
  return allocation;
}

Allocation allocate(MetropolisAlgorithm& algorithm, const CoarseImage& coarse,
                    const AllocationSettings& settings, const std::atomic<bool>& cancelled) {
  const SampleTechniques first = settings.techniques.value_or(SampleTechniques::all);
  algorithm.set_techniques(first);
  if (!(coarse.b > 0) && settings.share == 0) throw no_light_found(coarse.drawn);
  if (!(coarse.b > 0)) return samples_alone(first);
  if (settings.share == 0) return tours_alone(coarse.b, steps_of_tours_alone);
  Choice best;
  for (const Forecast& forecast :
       forecasts(algorithm, coarse, settings.techniques,
                 AllocationSamples(algorithm, coarse, settings, cancelled)))
    if (const Choice one = best_of(forecast, algorithm.has_tours(), settings.share);
        one.j < hardly * best.j)
      best = one;
  if (std::isinf(best.j)) return samples_alone(first);
  if (settings.share) best.allocation.share = *settings.share;
  algorithm.set_techniques(best.allocation.techniques);
  return best.allocation;
}

}  // namespace mlt
