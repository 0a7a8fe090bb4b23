// Primary-sample-space mutations leave their target unchanged, also where a walk uses more or fewer
// numbers after the step than before. The invariance test: weighted starts, one step, and paired
// differences against mean zero.
#include "mutation/primary_sample.h"

#include <gtest/gtest.h>

#include "harness/chi_square.h"
#include "markov/lecture_examples.h"
#include "path/samplers.h"

namespace mlt {
namespace {

using namespace test;

constexpr double alpha = 1e-5;

// ---- the small step

TEST(SmallStep, IsSymmetricAndFollowsItsDensity) {
  // |s| has a density proportional to 1 / |s|, so log |s| is uniform.
  constexpr int cells = 64, n = 200'000;
  constexpr double smallest = 1. / 1024, largest = 1. / 64, rounding = 1e-15;
  for (const double u : {0.25, 0.5, 0.999, 0.0001}) {
    std::vector<double> observed(2 * cells), expected(2 * cells, n / (2.0 * cells));
    Rng rng(51, Purpose::test, 0);
    for (int i = 0; i < n; ++i) {
      const double v = small_step(u, rng);
      ASSERT_GE(v, 0);
      ASSERT_LT(v, 1);
      double s = v - u;
      if (std::abs(s) > 0.5) s -= std::copysign(1.0, s);
      const double size = std::abs(s);
      ASSERT_GE(size, smallest - rounding);
      ASSERT_LE(size, largest + rounding);
      const int cell =
          static_cast<int>(cells * std::log(size / smallest) / std::log(largest / smallest));
      observed[(s > 0 ? cells : 0) + std::min(cells - 1, std::max(0, cell))] += 1;
    }
    EXPECT_GT(chi_square_counts(observed, expected).p_value, alpha) << u;
  }
}

TEST(SmallStep, NeverReachesOne) {
  // Just less than 0 wraps to what is rounded to 1.
  for (uint64_t stream = 0; stream < 1000; ++stream) {
    Rng rng(52, Purpose::test, stream), same = rng;
    const double from_zero = small_step(0, same);
    if (from_zero < 0.5) continue;  // a step upwards
    Rng probe = rng;
    const double sample = probe.next();
    double u = 1. / 64 * std::exp(-std::log(16.0) * (2 * sample - 1));
    for (int i = 0; i < 4; ++i, u = std::nextafter(u, 0)) {
      Rng again = rng;
      const double v = small_step(u, again);
      ASSERT_GE(v, 0);
      ASSERT_LT(v, 1);
    }
  }
}

// ---- one step of a kernel

/// A walk that uses two more numbers per bounce and ends when one of them says so. Its value may
/// be 0.
void walk(PrimaryState& state, Rng& rng) {
  PrimarySampler sampler(state.numbers, rng);
  state.raster = {sampler.next(), 0};
  double throughput = 1 + state.raster.x, value = 0;
  for (int bounce = 0; bounce < 8; ++bounce) {
    const double u = sampler.next();
    throughput *= 0.4 + u * u;
    if (u > 0.3) value += throughput;
    if (sampler.next() > 0.5 + 0.3 * u) break;
  }
  state.rgb = Color(value, 0.5 * value, 0.1 * value);
  state.target = target_luminance(state.rgb);
  state.numbers.resize(sampler.used());
}

/// What is observed of a state.
std::vector<double> observe(const PrimaryState& s) {
  const double count = static_cast<double>(s.numbers.size());
  return {std::cos(2 * pi * s.raster.x),
          std::sin(2 * pi * s.raster.x),
          s.raster.x < 0.25 ? 1. : 0.,
          count,
          count == 3 ? 1. : 0.,
          count == 5 ? 1. : 0.,
          s.numbers.back(),
          std::cos(2 * pi * s.numbers.back()),
          s.numbers[1],
          std::sin(2 * pi * s.numbers[1]),
          std::log(s.target),
          s.target < 0.5 ? 1. : 0.};
}

struct Invariance {
  double p_value;
  int accepted = 0, dimension_changed = 0;
};

/// E[w g(y)] = E[w g(x)] for one step x -> y of a kernel, for all g.
template <class Kernel>
Invariance invariance(Kernel kernel, int n = 300'000) {
  Invariance out{};
  std::vector<Moments> differences;
  Rng rng(53, Purpose::test, 0);
  for (int i = 0; i < n; ++i) {
    PrimaryState x;
    walk(x, rng);
    const double weight = x.target;  // the numbers' density is 1
    std::vector<double> change(observe(x).size());
    if (weight > 0) {
      const size_t before = x.numbers.size();
      std::array<PrimaryState, 1> y;
      const std::vector<double> g = observe(x);
      const StepResult step = metropolis_step(x, y, kernel, rng, forget);
      EXPECT_FALSE(step.invalid);
      if (step.accepted >= 0) ++out.accepted;
      if (x.numbers.size() != before) ++out.dimension_changed;
      const std::vector<double> h = observe(x);
      for (size_t k = 0; k < g.size(); ++k) change[k] = weight * (h[k] - g[k]);
    }
    differences.resize(change.size());
    for (size_t k = 0; k < change.size(); ++k) differences[k].add(change[k]);
  }
  out.p_value = smallest_p_value(differences, std::vector<double>(differences.size(), 0.0));
  return out;
}

TEST(PrimarySampleKernel, LeavesItsTargetUnchanged) {
  for (const double large : {1.0, 0.3, 0.0}) {
    const Invariance result = invariance(PrimarySampleKernel(large, walk));
    EXPECT_GT(result.p_value, alpha) << large;
    EXPECT_GT(result.accepted, 50'000) << large;
    EXPECT_GT(result.dimension_changed, 1000) << large;
  }
}

/// The right kernel with something done to its quotients.
template <class Spoil>
struct SpoiltQuotient {
  PrimarySampleKernel<void (*)(PrimaryState&, Rng&)> kernel;
  Spoil spoil;
  Transition propose(const PrimaryState& x, std::array<PrimaryState, 1>& y, size_t stage,
                     Rng& rng) {
    const Transition t = kernel.propose(x, y, stage, rng);
    return y[0].target == 0 ? t : spoil(t, x, y[0]);
  }
};
template <class Spoil>
SpoiltQuotient<Spoil> spoilt(double large, Spoil spoil) {
  return {{large, walk}, spoil};
}

TEST(PrimarySampleKernel, WithAWrongQuotientIsFound) {
  for (const double large : {1.0, 0.0}) {
    EXPECT_LT(invariance(
                  spoilt(large, [](Transition t, auto&,
                                   auto&) { return Transition{t.forward, std::sqrt(t.backward)}; }))
                  .p_value,
              alpha);
    // Counting the numbers as if they were not of density 1.
    EXPECT_LT(invariance(spoilt(large,
                                [](Transition t, const PrimaryState& x, const PrimaryState& y) {
                                  return Transition{t.forward * std::pow(1.1, y.numbers.size()),
                                                    t.backward * std::pow(1.1, x.numbers.size())};
                                }))
                  .p_value,
              alpha);
  }
}

/// Small steps with a flaw.
template <class Flaw>
struct Flawed {
  Flaw flaw;
  Transition propose(const PrimaryState& x, std::array<PrimaryState, 1>& proposals, size_t,
                     Rng& rng) {
    PrimaryState& y = proposals[0];
    y.numbers.clear();
    flaw(x, y, rng);
    walk(y, rng);
    if (y.target == 0) return impossible;
    return {1 / y.target, 1 / x.target};
  }
};
template <class Flaw>
Flawed<Flaw> flawed(Flaw flaw) {
  return {flaw};
}

TEST(PrimarySampleKernel, WithALopsidedStepIsFound) {
  EXPECT_LT(invariance(flawed([](const PrimaryState& x, PrimaryState& y, Rng& rng) {
              for (const double u : x.numbers) {
                const double v = small_step(u, rng);
                const bool down = v < u && u - v < 0.5;
                y.numbers.push_back(down && rng.next() < 0.2 ? u : v);
              }
            })).p_value,
            alpha);
}

TEST(PrimarySampleKernel, ThatContinuesWithNumbersThatAreNotUniformIsFound) {
  EXPECT_LT(invariance(flawed([](const PrimaryState& x, PrimaryState& y, Rng& rng) {
              for (const double u : x.numbers) y.numbers.push_back(small_step(u, rng));
              for (int i = 0; i < 20; ++i) y.numbers.push_back(std::sqrt(rng.next()));
            })).p_value,
            alpha);
}

TEST(PrimarySampleKernel, MovesEveryNumberALittleOrDrawsAllAfresh) {
  Rng rng(54, Purpose::test, 0);
  PrimaryState x;
  do walk(x, rng);
  while (x.target == 0);
  std::array<PrimaryState, 1> y;
  PrimarySampleKernel kernel(0.3, walk);
  int large = 0;
  for (int i = 0; i < 10'000; ++i) {
    kernel.propose(x, y, 0, rng);
    if (kernel.last() == kernel.large) {
      ++large;
      continue;
    }
    for (size_t k = 0; k < std::min(x.numbers.size(), y[0].numbers.size()); ++k) {
      const double distance = std::abs(x.numbers[k] - y[0].numbers[k]);
      EXPECT_LE(std::min(distance, 1 - distance), 1. / 64 + 1e-15);
    }
  }
  EXPECT_GT(chi_square_counts({large + 0., 10'000. - large}, {3000, 7000}).p_value, alpha);
}

TEST(PrimarySampleKernel, RejectsWhatIsBlack) {
  PrimarySampleKernel kernel(1, [](PrimaryState& state, Rng&) { state.target = 0; });
  PrimaryState x;
  x.target = 1;
  std::array<PrimaryState, 1> y;
  Rng rng(55, Purpose::test, 0);
  EXPECT_EQ(acceptance(kernel.propose(x, y, 0, rng)), 0);
}

}  // namespace
}  // namespace mlt
