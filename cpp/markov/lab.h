// The lecture's laboratory: Metropolis sampling of any function by any mixture of moves, on top of the
// one Metropolis-Hastings step.
//
// Of several moves one is chosen by weight (among those that suit the state), and the acceptance is
// that of the chosen move alone, with the probability of its choice as a part of T, as in the mixture
// of mutations of light paths (Veach 1997, sec. 11.4.1).
//
// X is what a state is made of: numbers here, any Python object in the bindings.
#pragma once

#include "base/error.h"
#include "base/rng.h"
#include "markov/step.h"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mlt::lab {

/// Coordinates; a discrete state is one coordinate, its index.
using Point = std::vector<double>;

/// "x = 0.25" or "x = (0.25, 1)", for messages.
std::string describe(const Point& x);
std::string describe(double number);

template <class X>
class Target {
 public:
  virtual ~Target() = default;
  virtual double operator()(const X& x) const = 0;
};

template <class X>
class Move {
 public:
  virtual ~Move() = default;
  /// A chain has its own copy of each move, since a move may learn.
  virtual std::unique_ptr<Move> clone() const = 0;
  /// May it act on x? A factor of its weight.
  virtual double suitability(const X& /*x*/) const { return 1; }
  /// Draws y from T(x -> .); false if there is no proposal.
  virtual bool propose(const X& x, X& y, Rng& rng) = 0;
  /// T(x -> y), up to a factor that does not depend on x and y. A symmetric move leaves it at 1.
  virtual double density(const X& /*x*/, const X& /*y*/) const { return 1; }
  /// Is told how its proposal fared.
  virtual void adapt(double /*acceptance*/) {}
  /// Its present size if that changes, else NaN.
  virtual double size() const { return std::numeric_limits<double>::quiet_NaN(); }
};

template <class X>
struct State {
  X x{};
  double target = 0;
};

/// The value of a target, which must be finite and not negative.
template <class X>
double checked_target(double value, const X& x) {
  if (value >= 0 && value < std::numeric_limits<double>::infinity()) return value;
  throw UsageError("the target is " + describe(value) + " at " + describe(x) +
                   "; it must be a finite number that is not negative");
}

/// A proposal, before its target is known.
struct Draft {
  bool generated = false;
  double forward = 0, backward = 0;  ///< P T(x -> y) and P T(y -> x)
};

template <class X>
class Mixture {
 public:
  using Moves = std::vector<std::pair<std::shared_ptr<const Move<X>>, double>>;
  static constexpr size_t none = std::numeric_limits<size_t>::max();

  explicit Mixture(const Moves& prototypes) {
    for (const auto& [move, weight] : prototypes) {
      moves_.push_back(move->clone());
      weights_.push_back(weight);
    }
  }

  /// Chooses a move for x; false if none suits it.
  bool choose(const X& x, Rng& rng) {
    draft_ = {};
    chosen_ = none;
    const double sum = weigh(x);
    if (sum == 0) return false;
    double u = rng.next() * sum;
    chosen_ = 0;
    while (chosen_ + 1 < shares_.size() && (u -= shares_[chosen_]) >= 0) ++chosen_;
    while (chosen_ > 0 && shares_[chosen_] == 0) --chosen_;  // u was rounded past the last share
    probability_ = shares_[chosen_] / sum;
    return true;
  }

  /// Lets the chosen move draw y.
  void draw(const X& x, X& y, Rng& rng) {
    Move<X>& move = *moves_[chosen_];
    if (move.propose(x, y, rng)) set_densities(x, y, move.density(x, y), move.density(y, x));
  }

  /// The same for a y that was drawn elsewhere: T of the chosen move both ways.
  void set_densities(const X& x, const X& y, double forward, double backward) {
    if (!(forward > 0))
      throw UsageError("a move proposed " + describe(y) + " from " + describe(x) +
                       " but its density T(x -> y) is " + describe(forward));
    if (!(backward >= 0))
      throw UsageError("a move's density T(x -> y) is " + describe(backward) + " from " +
                       describe(y) + " to " + describe(x));
    if (backward > 0) backward *= probability(y);
    draft_ = {true, probability_ * forward, backward};
  }

  Transition transition(const State<X>& x, const State<X>& y) const {
    if (!draft_.generated || y.target == 0) return impossible;
    return {draft_.forward / y.target, draft_.backward / x.target};
  }

  void adapt(const StepResult& result) {
    if (draft_.generated) moves_[chosen_]->adapt(result.acceptance);
  }

  /// Of the last step; `none` if no move suited the state.
  size_t chosen() const { return chosen_; }
  bool generated() const { return draft_.generated; }
  /// Of the first move that has one.
  double size() const {
    for (const auto& move : moves_)
      if (!std::isnan(move->size())) return move->size();
    return std::numeric_limits<double>::quiet_NaN();
  }

 private:
  /// Fills in each move's share of the choice at x; returns their sum.
  double weigh(const X& x) {
    double sum = 0;
    shares_.clear();
    for (size_t i = 0; i < moves_.size(); ++i) {
      const double suitability = moves_[i]->suitability(x);
      if (!(suitability >= 0 && suitability < std::numeric_limits<double>::infinity()))
        throw UsageError("a move's suitability is " + describe(suitability) + " at " + describe(x) +
                         "; it must be a finite number that is not negative");
      shares_.push_back(weights_[i] * suitability);
      sum += shares_.back();
    }
    return sum;
  }

  /// P_choose of the chosen move at y.
  double probability(const X& y) {
    const double sum = weigh(y);
    return sum > 0 ? shares_[chosen_] / sum : 0;
  }

  std::vector<std::unique_ptr<Move<X>>> moves_;
  std::vector<double> weights_, shares_;
  size_t chosen_ = none;
  double probability_ = 0;
  Draft draft_;
};

template <class X>
class Chain {
 public:
  Chain(const X& start, double target, const typename Mixture<X>::Moves& moves, uint64_t seed,
        uint64_t index)
      : mixture_(moves), rng_(seed, Purpose::chain, index) {
    if (checked_target(target, start) == 0)
      throw UsageError("the target is 0 at the start " + describe(start) +
                       "; a chain must start where it is positive");
    x_ = {start, target};
    y_[0] = x_;
  }

  /// One step; `record(state, weight, is_proposal)`.
  template <class Record>
  StepResult step(const Target<X>& target, Record&& record) {
    draft();
    if (generated()) set_target(target(proposal()));
    return finish(record);
  }

  /// The parts of a step, for chains that go in lockstep: draft, set_target if a proposal was
  /// generated, finish.
  void draft() {
    if (choose()) draw();
  }
  bool choose() { return mixture_.choose(x_.x, rng_); }
  void draw() { mixture_.draw(x_.x, y_[0].x, rng_); }
  void set_proposal(X y, double forward, double backward) {
    y_[0].x = std::move(y);
    mixture_.set_densities(x_.x, y_[0].x, forward, backward);
  }
  void set_target(double value) { y_[0].target = checked_target(value, y_[0].x); }

  template <class Record>
  StepResult finish(Record&& record) {
    struct Drafted {
      const Mixture<X>& mixture;
      Transition propose(const State<X>& x, const std::array<State<X>, 1>& y, size_t, Rng&) {
        return mixture.transition(x, y[0]);
      }
    } kernel{mixture_};
    const StepResult result = metropolis_step(
        x_, y_, kernel, rng_,
        [&](const State<X>& state, double weight) { record(state.x, weight, &state != &x_); });
    mixture_.adapt(result);
    return result;
  }

  const X& state() const { return x_.x; }
  const X& proposal() const { return y_[0].x; }
  bool generated() const { return mixture_.generated(); }
  const Mixture<X>& mixture() const { return mixture_; }

 private:
  State<X> x_;
  std::array<State<X>, 1> y_;
  Mixture<X> mixture_;
  Rng rng_;
};

}  // namespace mlt::lab
