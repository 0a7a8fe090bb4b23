// The two chains whose answer is known in closed form: two states, and a parabola. Each can be
// broken on purpose, so that its tests are seen to fail.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/rng.h"
#include "harness/chi_square.h"
#include "markov/step.h"

namespace mlt::test {

/// f(a) = 9, f(b) = 1; the states are 0 and 1.
struct TwoStates {
  std::array<std::array<double, 2>, 2> proposal;  // q(x -> y)
  bool forgets_proposal = false;

  static double f(int x) { return x == 0 ? 9 : 1; }

  Transition propose(const int& x, std::array<int, 1>& proposed, size_t, Rng& rng) {
    const int y = proposed[0] = rng.next() < proposal[x][0] ? 0 : 1;
    if (forgets_proposal) return {1 / f(y), 1 / f(x)};
    return {proposal[x][y] / f(y), proposal[y][x] / f(x)};
  }
};

inline TwoStates fair_coin() { return {{{{0.5, 0.5}, {0.5, 0.5}}}}; }
inline TwoStates better_coin() { return {{{{0.9, 0.1}, {0.9, 0.1}}}}; }

/// f(x) = (x - 1/2)^2 on [0, 1], with 10 % uniform proposals and 90 % local ones.
struct Parabola {
  double drift = 0;  // of the local proposals: the kernel then forgets that they are not symmetric

  static double f(double x) { return x < 0 || x > 1 ? 0 : (x - 0.5) * (x - 0.5); }
  static constexpr double integral = 1. / 12;
  /// Of f, from 0 to x.
  static double cumulative(double x) { return ((x - 0.5) * (x - 0.5) * (x - 0.5) + 0.125) / 3; }
  /// A state from the stationary distribution, by inversion.
  static double sample(double u) { return 0.5 + std::cbrt(0.25 * (u - 0.5)); }

  Transition propose(const double& x, std::array<double, 1>& proposed, size_t, Rng& rng) {
    double& y = proposed[0];
    y = rng.next() < 0.1 ? rng.next() : x + 0.1 * (rng.next() - 0.5 + drift);
    if (f(y) == 0) return impossible;
    return {1 / f(y), 1 / f(x)};
  }
};

inline const auto forget = [](const auto&, double) {};

constexpr int bins = 20;
inline int bin_of(double x) { return std::min(bins - 1, static_cast<int>(x * bins)); }

/// The integral of f over each bin.
inline std::vector<double> bin_integrals() {
  std::vector<double> integrals;
  for (int i = 0; i < bins; ++i)
    integrals.push_back(Parabola::cumulative((i + 1.) / bins) -
                        Parabola::cumulative(double(i) / bins));
  return integrals;
}

/// Chi-square of independent states against the stationary distribution of the parabola.
inline double parabola_p_value(const std::vector<double>& states) {
  std::vector<double> observed(bins), expected = bin_integrals();
  for (double& e : expected) e *= static_cast<double>(states.size()) / Parabola::integral;
  for (const double x : states) observed[bin_of(x)] += 1;
  return chi_square_counts(observed, expected).p_value;
}

/// Where `chains` independent chains are after `steps` steps.
template <class State, class Kernel, class Start>
std::vector<State> end_states(Kernel kernel, const Start& start, int chains, int steps,
                              uint64_t seed) {
  std::vector<State> states;
  for (int c = 0; c < chains; ++c) {
    Rng rng(seed, Purpose::test, static_cast<uint64_t>(c));
    State x = start(rng);
    std::array<State, 1> y{};
    for (int i = 0; i < steps; ++i) metropolis_step(x, y, kernel, rng, forget);
    states.push_back(x);
  }
  return states;
}

}  // namespace mlt::test
