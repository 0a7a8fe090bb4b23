// A mixture of moves as the kernel of the Metropolis-Hastings step. Of the moves that suit a state
// one is chosen by weight, and the acceptance is that of the chosen move alone, with the
// probability of its choice as a part of q: the reverse state may suit other moves (Veach 1997,
// sec. 11.4.1).
//
// A move is a class with
//
//   State, Edit              types: of states, and of the record of a proposal
//   Scratch, Context{Rng&, Scratch&}   data of a chain for it; the same with random numbers
//   static size_t row(const State&)   the row of weights for this state
//   static MoveChoice* cached_choice(const State&)   where the state caches its choice, until
//                            the state changes; nullptr if it does not
//   double suitability(const State&) const   may it act on x? A factor of its weight
//   std::optional<Edit> propose(x, y, context)   makes y from x
//   Transition quotients(x, y, edit)   q(x -> y) / L*(y) and q(y -> x) / L*(x), without the
//                            probability of its choice
//
// where a State has its target, known at the latest when the step ends; 0 if y is impossible.
#pragma once

#include "markov/step.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

namespace mlt {

/// Weights of the moves, row by row; a state beyond the last row uses the last one.
class MixtureWeights {
 public:
  MixtureWeights() = default;
  explicit MixtureWeights(std::vector<double> weights) : rows_{std::move(weights)} {}
  explicit MixtureWeights(std::vector<std::vector<double>> rows) : rows_(std::move(rows)) {}

  const std::vector<double>& operator[](size_t row) const {
    return rows_[std::min(row, rows_.size() - 1)];
  }
  const std::vector<std::vector<double>>& rows() const { return rows_; }

 private:
  std::vector<std::vector<double>> rows_;
};

/// The choice of a move at a state: each one's share, and their sum.
struct MoveChoice {
  bool known = false;
  std::shared_ptr<const MixtureWeights> weights;  ///< The weights that it was made by.
  double sum = 0;
  std::vector<double> shares;
};

template <class Move>
class Mixture {
 public:
  using State = typename Move::State;
  using Scratch = typename Move::Scratch;
  using Moves = std::vector<std::shared_ptr<Move>>;

  Mixture(Moves moves, std::shared_ptr<const MixtureWeights> weights)
      : moves_(std::move(moves)), weights_(std::move(weights)) {}

  /// Called by metropolis_step, if the moves evaluate the target of their proposals.
  Transition propose(const State& x, std::array<State, 1>& proposals, size_t, Rng& rng) {
    if (choose(x, rng)) draw(x, proposals[0], rng);
    return transition(x, proposals[0]);
  }

  // The parts of a proposal, for chains that advance in lockstep.

  /// Chooses a move for x; false if none suits it.
  bool choose(const State& x, Rng& rng) {
    edit_.reset();
    row_ = Move::row(x);
    const MoveChoice& at_x = choice(x);
    const std::vector<double>& shares = at_x.shares;
    suited_ = at_x.sum > 0;
    chosen_ = 0;
    if (!suited_) return false;
    double u = rng.next() * at_x.sum;
    while (chosen_ + 1 < shares.size() && (u -= shares[chosen_]) >= 0) ++chosen_;
    while (shares[chosen_] == 0) --chosen_;  // u was rounded past the last share
    probability_ = shares[chosen_] / at_x.sum;
    return true;
  }
  /// Proposes y by the chosen move.
  void draw(const State& x, State& y, Rng& rng) {
    typename Move::Context context{rng, scratch_};
    edit_ = moves_[chosen_]->propose(x, y, context);
  }
  /// Sets the edit of the chosen move, if its y was made elsewhere.
  void set_edit(const typename Move::Edit& edit) { edit_ = edit; }
  /// The transition to the proposal y, whose target is known.
  Transition transition(const State& x, const State& y) {
    if (!generated(y)) return impossible;
    const Transition own = moves_[chosen_]->quotients(x, y, *edit_);
    if (own.forward == 0) return impossible;  // y has another form than the move makes
    return {probability_ * own.forward, own.backward == 0 ? 0 : probability(y) * own.backward};
  }

  /// Whether any move suits x.
  bool suits(const State& x) { return choice(x).sum > 0; }

  // The results of the last step:

  /// Whether any move suited the state, and which one was chosen.
  bool suited() const { return suited_; }
  size_t chosen() const { return chosen_; }
  /// The row of weights that it was chosen by.
  size_t row() const { return row_; }
  /// Whether there is a proposal, and whether one with this state can be accepted at all.
  bool proposed() const { return edit_.has_value(); }
  bool generated(const State& y) const { return proposed() && y.target != 0; }
  const typename Move::Edit& edit() const { return *edit_; }

  Move& operator[](size_t i) const { return *moves_[i]; }
  const Moves& moves() const { return moves_; }
  Scratch& scratch() { return scratch_; }
  const Scratch& scratch() const { return scratch_; }

 protected:
  /// The probability with which the chosen move is chosen at a state.
  double probability(const State& at) {
    const MoveChoice& choices = choice(at);
    const double share = choices.shares[chosen_];
    return share > 0 ? share / choices.sum : 0.0;
  }

 private:
  const MoveChoice& choice(const State& x) {
    MoveChoice* kept = Move::cached_choice(x);
    if (kept && kept->known && kept->weights == weights_) return *kept;
    MoveChoice& choice = kept ? *kept : uncached_;
    choice.known = true;
    if (choice.weights != weights_) choice.weights = weights_;
    choice.shares.resize(moves_.size());
    const double* weights = (*weights_)[Move::row(x)].data();
    double *shares = choice.shares.data(), sum = 0;
    for (const auto& move : moves_) {
      const double weight = *weights++;
      sum += * shares++ = weight > 0 ? weight * move->suitability(x) : 0.0;
    }
    choice.sum = sum;
    return choice;
  }

  Moves moves_;
  std::shared_ptr<const MixtureWeights> weights_;
  Scratch scratch_{};
  MoveChoice uncached_;  ///< For states that do not cache their choice.
  size_t chosen_ = 0, row_ = 0;
  bool suited_ = false;
  double probability_ = 0;
  std::optional<typename Move::Edit> edit_;
};

}  // namespace mlt
