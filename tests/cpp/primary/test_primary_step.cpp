// Primary-sample-space mutations leave their target unchanged, also where a walk uses more or fewer
// numbers after the step than before. The invariance test: weighted starts, one step, and paired
// differences against mean zero.
#include "primary/primary_step.h"

#include <gtest/gtest.h>

#include <functional>

#include "harness/chi_square.h"
#include "markov/lecture_examples.h"

namespace mlt {
namespace {

using namespace test;

constexpr double alpha = 1e-5;

// ---- the small step

TEST(SmallStep, IsSymmetricAndFollowsItsDensity) {
  // |s| has a density proportional to 1 / |s|, so log |s| is uniform.
  constexpr int cells = 64, n = 200'000;
  constexpr double smallest = 1. / 512, largest = 1. / 32, rounding = 1e-15;
  for (const double u : {0.25, 0.5, 0.999, 0.0001}) {
    std::vector<double> observed(2 * cells), expected(2 * cells, n / (2.0 * cells));
    Rng rng(51, Purpose::test, 0);
    for (int i = 0; i < n; ++i) {
      const double v = SmallStep()(u, rng);
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
    const double from_zero = SmallStep()(0, same);
    if (from_zero < 0.5) continue;  // a step upwards
    Rng probe = rng;
    const double sample = probe.next();
    double u = 1. / 32 * std::exp(-std::log(16.0) * (2 * sample - 1));
    for (int i = 0; i < 4; ++i, u = std::nextafter(u, 0)) {
      Rng again = rng;
      const double v = SmallStep()(u, again);
      ASSERT_GE(v, 0);
      ASSERT_LT(v, 1);
    }
  }
}

// ---- one step of a kernel

/// The numbers of a state, in the order in which walk_with() draws them.
std::vector<double> used(const PrimaryState& x) {
  const auto &camera = x.numbers[Stream::camera], &light = x.numbers[Stream::light];
  std::vector<double> all;
  for (size_t i = 0; i < camera.size(); ++i) {
    if (i > 0) all.push_back(light[i - 1]);
    all.push_back(camera[i]);
  }
  return all;
}
size_t used_count(const PrimaryState& x) {
  return x.numbers[Stream::camera].size() + x.numbers[Stream::light].size();
}

constexpr SmallStep steps[] = {{}, {SmallStep::Shape::gaussian, 0.02}};

/// A walk that uses two more numbers per bounce, of two streams, and ends when one of them says so.
/// Its value may be 0.
void walk_with(const SmallStep& step, const PrimarySamples* x, PrimaryState& y, Rng& rng) {
  PrimarySampler sampler(x, y.numbers, step, rng);
  const auto next = [&](Stream stream) {
    sampler.begin(stream);
    return sampler.next();
  };
  double throughput = 1 + next(Stream::camera), value = 0;
  for (int bounce = 0; bounce < 8; ++bounce) {
    const double u = next(Stream::light);
    throughput *= 0.4 + u * u;
    if (u > 0.3) value += throughput;
    if (next(Stream::camera) > 0.5 + 0.3 * u) break;
  }
  y.target = value;
}
void walk(const PrimarySamples* x, PrimaryState& y, Rng& rng) { walk_with({}, x, y, rng); }

using Kernel = PrimaryStep<std::function<void(const PrimarySamples* x, PrimaryState& y, Rng& rng)>>;

/// What is observed of a state.
std::vector<double> observe(const PrimaryState& s) {
  const std::vector<double> u = used(s);
  const double count = static_cast<double>(u.size());
  return {std::cos(2 * pi * u[0]),
          std::sin(2 * pi * u[0]),
          u[0] < 0.25 ? 1. : 0.,
          count,
          count == 3 ? 1. : 0.,
          count == 5 ? 1. : 0.,
          u.back(),
          std::cos(2 * pi * u.back()),
          u[1],
          std::sin(2 * pi * u[1]),
          std::log(s.target),
          s.target < 0.5 ? 1. : 0.};
}

struct Invariance {
  double p_value;
  int accepted = 0, dimension_changed = 0;
};

/// E[w g(y)] = E[w g(x)] for some steps x -> ... -> y of a kernel, for all g.
template <class Kernel>
Invariance invariance(Kernel kernel, int n = 300'000, int steps = 1) {
  Invariance out{};
  std::vector<Moments> differences;
  Rng rng(53, Purpose::test, 0);
  for (int i = 0; i < n; ++i) {
    PrimaryState x;
    walk(nullptr, x, rng);
    const double weight = x.target;  // the numbers' density is 1
    std::vector<double> change(observe(x).size());
    if (weight > 0) {
      const size_t before = used_count(x);
      std::array<PrimaryState, 2> y;
      const std::vector<double> g = observe(x);
      for (int k = 0; k < steps; ++k) {
        const StepResult step = metropolis_step(x, y, kernel, rng, forget);
        EXPECT_FALSE(step.invalid);
        if (step.accepted >= 0) ++out.accepted;
      }
      if (used_count(x) != before) ++out.dimension_changed;
      const std::vector<double> h = observe(x);
      for (size_t k = 0; k < g.size(); ++k) change[k] = weight * (h[k] - g[k]);
    }
    differences.resize(change.size());
    for (size_t k = 0; k < change.size(); ++k) differences[k].add(change[k]);
  }
  out.p_value = smallest_p_value(differences, std::vector<double>(differences.size(), 0.0));
  return out;
}

TEST(PrimaryStep, LeavesItsTargetUnchanged) {
  for (const SmallStep& step : steps)
    for (const double large : {1.0, 0.3, 0.0}) {
      const Kernel kernel(large, false, [&](const PrimarySamples* x, PrimaryState& y, Rng& rng) {
        walk_with(step, x, y, rng);
      });
      const Invariance result = invariance(kernel);
      EXPECT_GT(result.p_value, alpha) << large;
      EXPECT_GT(result.accepted, 50'000) << large;
      EXPECT_GT(result.dimension_changed, 1000) << large;
    }
}

/// Several steps: numbers that were dropped in between are drawn again.
TEST(PrimaryStep, LeavesItsTargetUnchangedOverSeveralSteps) {
  for (const double large : {0.2, 0.0}) {
    const Invariance result = invariance(Kernel(large, false, walk), 60'000, 12);
    EXPECT_GT(result.p_value, alpha) << large;
    EXPECT_GT(result.dimension_changed, 1000) << large;
  }
}

TEST(PrimaryStep, LeavesItsTargetUnchangedWithDelayedRejection) {
  for (const double large : {1.0, 0.4}) {
    const Invariance one = invariance(Kernel(large, false, walk));
    const Invariance two = invariance(Kernel(large, true, walk));
    EXPECT_GT(two.p_value, alpha) << large;
    EXPECT_GT(two.accepted, one.accepted + 10'000) << large;
  }
}

/// A second stage that forgets that the first was rejected.
struct Forgetful {
  Kernel kernel{1, true, walk};
  Kernel small{0, false, [](const PrimarySamples* x, PrimaryState& y, Rng& rng) {
                 walk_with({SmallStep::Shape::gaussian, 0.2}, x, y, rng);
               }};
  Transition propose(const PrimaryState& x, std::array<PrimaryState, 2>& y, size_t stage,
                     Rng& rng) {
    if (stage == 0) return kernel.propose(x, y, 0, rng);
    std::array<PrimaryState, 2> own;
    const Transition t = small.propose(x, own, 0, rng);
    y[1] = own[0];
    return t;
  }
};

TEST(PrimaryStep, ThatForgetsTheRejectionIsFound) {
  EXPECT_LT(invariance(Forgetful()).p_value, alpha);
}

/// The right kernel with something done to its quotients.
template <class Spoil>
struct SpoiltQuotient {
  Kernel kernel;
  Spoil spoil;
  Transition propose(const PrimaryState& x, std::array<PrimaryState, 2>& y, size_t stage,
                     Rng& rng) {
    const Transition t = kernel.propose(x, y, stage, rng);
    return stage > 0 || y[0].target == 0 ? t : spoil(t, x, y[0]);
  }
};
template <class Spoil>
SpoiltQuotient<Spoil> spoilt(double large, Spoil spoil) {
  return {Kernel(large, false, walk), spoil};
}

TEST(PrimaryStep, WithAWrongQuotientIsFound) {
  for (const double large : {1.0, 0.0}) {
    EXPECT_LT(invariance(
                  spoilt(large, [](Transition t, auto&,
                                   auto&) { return Transition{t.forward, std::sqrt(t.backward)}; }))
                  .p_value,
              alpha);
    // Counting the numbers as if they were not of density 1.
    EXPECT_LT(invariance(spoilt(large,
                                [](Transition t, const PrimaryState& x, const PrimaryState& y) {
                                  return Transition{t.forward * std::pow(1.1, used_count(y)),
                                                    t.backward * std::pow(1.1, used_count(x))};
                                }))
                  .p_value,
              alpha);
  }
}

/// Small steps with a flaw: flaw(numbers, rng) changes those of x into those of y.
template <class Flaw>
struct Flawed {
  Flaw flaw;
  Transition propose(const PrimaryState& x, std::array<PrimaryState, 2>& proposals, size_t stage,
                     Rng& rng) {
    if (stage > 0) return impossible;
    PrimaryState& y = proposals[0];
    PrimarySamples numbers = x.numbers;
    flaw(numbers, rng);
    walk_with(no_step, &numbers, y, rng);
    if (y.target == 0) return impossible;
    return {1 / y.target, 1 / x.target};
  }
};
template <class Flaw>
Flawed<Flaw> flawed(Flaw flaw) {
  return {flaw};
}

TEST(PrimaryStep, WithALopsidedStepIsFound) {
  EXPECT_LT(invariance(flawed([](PrimarySamples& numbers, Rng& rng) {
              for (double& u : numbers[Stream::light]) {
                const double v = SmallStep()(u, rng);
                const bool down = v < u && u - v < 0.5;
                if (!(down && rng.next() < 0.2)) u = v;
              }
            })).p_value,
            alpha);
}

TEST(PrimaryStep, ThatContinuesWithNumbersThatAreNotUniformIsFound) {
  EXPECT_LT(invariance(flawed([](PrimarySamples& numbers, Rng& rng) {
              std::vector<double> light = std::move(numbers[Stream::light]);
              for (double& u : light) u = SmallStep()(u, rng);
              while (light.size() < 10) light.push_back(std::sqrt(rng.next()));
              numbers = {};
              numbers[Stream::light] = std::move(light);
            })).p_value,
            alpha);
}

TEST(PrimaryStep, MovesEveryNumberALittleOrDrawsAllAfresh) {
  Rng rng(54, Purpose::test, 0);
  PrimaryState x;
  do walk(nullptr, x, rng);
  while (x.target == 0);
  std::array<PrimaryState, 2> y;
  Kernel kernel(0.3, false, walk);
  int large = 0;
  for (int i = 0; i < 10'000; ++i) {
    kernel.propose(x, y, 0, rng);
    if (kernel.last() == kernel.large) {
      ++large;
      continue;
    }
    const std::vector<double> u = used(x), v = used(y[0]);
    for (size_t k = 0; k < std::min(u.size(), v.size()); ++k) {
      const double distance = std::abs(u[k] - v[k]);
      EXPECT_LE(std::min(distance, 1 - distance), 1. / 32 + 1e-15);
    }
  }
  EXPECT_GT(chi_square_counts({large + 0., 10'000. - large}, {3000, 7000}).p_value, alpha);
}

TEST(PrimaryStep, RejectsWhatIsBlack) {
  Kernel kernel(1, false, [](auto*, PrimaryState& y, Rng&) { y.target = 0; });
  PrimaryState x;
  x.target = 1;
  std::array<PrimaryState, 2> y;
  Rng rng(55, Purpose::test, 0);
  EXPECT_EQ(acceptance(kernel.propose(x, y, 0, rng)), 0);
}

// ---- numbers

TEST(PrimarySamples, AreThoseThatWereDrawnLast) {
  Rng rng(56, Purpose::test, 0);
  PrimarySamples x, y;
  x[Stream::light] = {0.25, 0.5, 0.75};
  x[Stream::direct] = {0.5};
  PrimarySampler sampler(&x, y, no_step, rng);
  const double fresh = sampler.next();
  sampler.begin(Stream::light);
  EXPECT_EQ(sampler.next(), 0.25);
  sampler.begin(Stream::camera);
  const double fresh_again = sampler.next();
  sampler.begin(Stream::light);
  EXPECT_EQ(sampler.next(), 0.5);
  EXPECT_EQ(y[Stream::camera], std::vector({fresh, fresh_again}));
  EXPECT_EQ(y[Stream::light], std::vector({0.25, 0.5}));
  EXPECT_TRUE(y[Stream::direct].empty());
}

TEST(PrimarySamples, AreReadBackAsTheyWere) {
  Rng rng(57, Purpose::test, 0);
  PrimaryState x;
  walk(nullptr, x, rng);
  ByteWriter bytes;
  x.numbers.save(bytes);
  const std::string saved = bytes.take();
  ByteReader reader(saved);
  PrimarySamples same;
  same.load(reader);
  reader.finish();
  for (const Stream stream : {Stream::camera, Stream::light, Stream::direct})
    EXPECT_EQ(same[stream], x.numbers[stream]);
}

}  // namespace
}  // namespace mlt
