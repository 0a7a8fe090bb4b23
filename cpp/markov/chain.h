// A Markov chain: a state, a random stream of its own, and the kernel that moves it.
#pragma once

#include "markov/step.h"

namespace mlt {

template <class State, class Kernel, size_t stages = 1>
class Chain {
 public:
  Chain(Kernel kernel, const Rng& rng, State start = {})
      : kernel_(std::move(kernel)), rng_(rng), x_(std::move(start)) {}

  /// See metropolis_step.
  template <class Record>
  StepResult step(Record&& record) {
    return metropolis_step(x_, y_, kernel_, rng_, record);
  }
  /// Lets a kernel prepare its next proposals, if it cannot make them at once.
  template <class... Arguments>
  void prepare(size_t stage, Arguments&&... arguments) {
    kernel_.prepare(std::as_const(x_), y_, stage, rng_, arguments...);
  }
  /// Makes a proposal that is neither accepted nor rejected; returns its acceptance
  /// probability.
  double propose() { return acceptance(kernel_.propose(x_, y_, 0, rng_)); }

  const State& state() const { return x_; }
  /// After propose(), the proposal; after a step of one stage, the state that the chain is not in.
  const State& other() const { return y_[0]; }
  /// The proposal of a stage of the last step.
  const State& proposal(const StepResult& last, size_t stage) const {
    return last.accepted == static_cast<int>(stage) ? x_ : y_[stage];
  }
  /// The scratch states of the stages: proposals, and the state that the chain has left.
  const std::array<State, stages>& others() const { return y_; }
  /// Continues from another state, with the same stream.
  void restart(const State& x) { x_ = x; }

  Kernel& kernel() { return kernel_; }
  const Kernel& kernel() const { return kernel_; }
  Rng& rng() { return rng_; }
  const Rng& rng() const { return rng_; }

 protected:
  Kernel kernel_;
  Rng rng_;
  State x_;
  std::array<State, stages> y_{};
};

}  // namespace mlt
