// The lecture's laboratory: Metropolis sampling of any function by any mixture of moves, with the
// step, the mixture and the chain that light paths use.
//
// X is the type of a state: numbers here, any Python object in the bindings.
#pragma once

#include "base/error.h"
#include "base/rng.h"
#include "markov/chain.h"
#include "markov/mixture.h"

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mlt::lab {

/// Coordinates; a discrete state is one coordinate, its index.
using Point = std::vector<double>;

/// A state in messages, such as "x = 0.25" or "x = (0.25, 1)".
std::string describe(const Point& x);
std::string describe(double number);

template <class X>
class Target {
 public:
  virtual ~Target() = default;
  virtual double operator()(const X& x) const = 0;
};

template <class X>
struct State {
  X x{};
  double target = 0;
};

/// A value that must be finite and not negative; `what` is for the message.
template <class X>
double checked(const std::string& what, double value, const X& x) {
  if (value >= 0 && value < std::numeric_limits<double>::infinity()) return value;
  throw UsageError(what + " is " + describe(value) + " at " + describe(x) +
                   "; it must be a finite number that is not negative");
}

template <class X>
class Move {
 public:
  virtual ~Move() = default;
  /// A copy for one chain, since a move may adapt.
  virtual std::shared_ptr<Move> clone() const = 0;
  /// Whether it may act on x: a factor of its weight.
  virtual double suitability(const X& /*x*/) const { return 1; }
  /// Draws y from q(x -> .); false if there is no proposal.
  virtual bool propose(const X& x, X& y, Rng& rng) = 0;
  /// q(x -> y), up to a factor that does not depend on x and y. A symmetric move leaves it at 1.
  virtual double density(const X& /*x*/, const X& /*y*/) const { return 1; }
  /// Called with the acceptance of the move's proposal, for moves that adapt.
  virtual void adapt(double /*acceptance*/) {}
  /// The current step size if that is adaptive, else NaN.
  virtual double size() const { return std::numeric_limits<double>::quiet_NaN(); }

  // The interface of a move in a mixture, for states with their targets:

  using State = lab::State<X>;
  struct Edit {
    /// q(x -> y) and q(y -> x), if the proposal was made elsewhere.
    std::optional<std::pair<double, double>> densities;
  };
  struct Scratch {};
  struct Context {
    Rng& rng;
    Scratch& scratch;
  };
  static size_t row(const State&) { return 0; }
  static MoveChoice* cached_choice(const State&) { return nullptr; }
  double suitability(const State& x) const {
    return checked("a move's suitability", suitability(x.x), x.x);
  }
  std::optional<Edit> propose(const State& x, State& y, const Context& context) {
    return propose(x.x, y.x, context.rng) ? std::optional<Edit>(Edit()) : std::nullopt;
  }
  Transition quotients(const State& x, const State& y, const Edit& edit) const {
    const auto [forward, backward] =
        edit.densities ? *edit.densities : std::pair(density(x.x, y.x), density(y.x, x.x));
    if (!(forward > 0))
      throw UsageError("a move proposed " + describe(y.x) + " from " + describe(x.x) +
                       " but its density q(x -> y) is " + describe(forward));
    if (!(backward >= 0))
      throw UsageError("a move's density q(x -> y) is " + describe(backward) + " from " +
                       describe(y.x) + " to " + describe(x.x));
    return {forward / y.target, backward / x.target};
  }
};

template <class X>
using Mixture = mlt::Mixture<Move<X>>;

/// Moves with their weights, to be copied for each chain.
template <class X>
using Prototypes = std::vector<std::pair<std::shared_ptr<const Move<X>>, double>>;

template <class X>
class Chain : public mlt::Chain<State<X>, Mixture<X>> {
  using Base = mlt::Chain<State<X>, Mixture<X>>;

 public:
  Chain(const X& start, double target, const Prototypes<X>& moves, uint64_t seed, uint64_t index)
      : Base(mixture_of(moves), Rng(seed, Purpose::chain, index), {start, target}) {
    if (checked("the target", target, start) == 0)
      throw UsageError("the target is 0 at the start " + describe(start) +
                       "; a chain must start where it is positive");
    this->y_[0] = this->x_;
  }

  /// Takes one step; calls `record(x, weight, is_proposal)`.
  template <class Record>
  StepResult step(const Target<X>& target, Record&& record) {
    if (choose()) draw();
    if (proposed()) set_target(target(this->other().x));
    return finish(record);
  }

  // The parts of a step, for chains that advance in lockstep: choose; draw, or set_proposal;
  // set_target if there is a proposal; finish.

  bool choose() { return this->kernel_.choose(this->x_, this->rng_); }
  void draw() { this->kernel_.draw(this->x_, this->y_[0], this->rng_); }
  void set_proposal(X y, double forward, double backward) {
    this->y_[0].x = std::move(y);
    this->kernel_.set_edit({std::pair(forward, backward)});
  }
  void set_target(double value) {
    this->y_[0].target = checked("the target", value, this->y_[0].x);
  }
  bool proposed() const { return this->kernel_.proposed(); }

  template <class Record>
  StepResult finish(Record&& record) {
    struct Proposed {
      Mixture<X>& mixture;
      Transition propose(const State<X>& x, const std::array<State<X>, 1>& y, size_t, Rng&) {
        return mixture.transition(x, y[0]);
      }
    } kernel{this->kernel_};
    const StepResult result = metropolis_step(this->x_, this->y_, kernel, this->rng_,
                                              [&](const State<X>& state, double weight) {
                                                record(state.x, weight, &state != &this->x_);
                                              });
    if (proposed()) this->kernel_.moves()[this->kernel_.chosen()]->adapt(result.acceptance);
    return result;
  }

  /// The size of the first adaptive move, or NaN.
  double move_size() const {
    for (const auto& move : this->kernel_.moves())
      if (!std::isnan(move->size())) return move->size();
    return std::numeric_limits<double>::quiet_NaN();
  }

 private:
  static Mixture<X> mixture_of(const Prototypes<X>& prototypes) {
    typename Mixture<X>::Moves moves;
    std::vector<double> weights;
    for (const auto& [move, weight] : prototypes) {
      moves.push_back(move->clone());
      weights.push_back(weight);
    }
    return {std::move(moves), std::make_shared<MixtureWeights>(std::move(weights))};
  }
};

}  // namespace mlt::lab
