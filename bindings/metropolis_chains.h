// Chains of one target and one mixture: one after the other, or in lockstep for functions that take
// the states of many chains at once.
#pragma once

#include "metropolis_trace.h"

#include <optional>

namespace mlt::python {

/// Chains in Python, whatever their states are.
class AnyChains {
 public:
  virtual ~AnyChains() = default;
  virtual py::dict advance(size_t steps, bool expected_values) = 0;
};

/// Runs some steps of all chains, one chain after the other, and returns their trace;
/// `step(chain, record)` takes one.
template <class Space, class Chain, class Step>
py::dict advance_each(const Space& space, std::vector<Chain>& chains, size_t steps,
                      bool expected_values, bool native, Step&& step) {
  Trace<Space> trace(space, chains.size(), steps, expected_values);
  {
    std::optional<ReleasedGil> release;
    if (native) release.emplace();
    for (size_t c = 0; c < chains.size(); ++c)
      for (size_t i = 0; i < steps; ++i)
        trace.step(c, i, chains[c], [&](const auto& record) { return step(chains[c], record); });
  }
  return trace.take();
}

/// Chains of one target and one mixture, each with a random stream of its own. `native` ones run
/// without the interpreter's lock.
template <class Space>
class Chains final : public AnyChains {
 public:
  using X = typename Space::State;

  Chains(const Space& space, std::shared_ptr<const lab::Target<X>> target,
         const lab::Prototypes<X>& moves, const std::vector<X>& starts, uint64_t seed, bool native)
      : space_(space), target_(std::move(target)), native_(native) {
    for (size_t c = 0; c < starts.size(); ++c)
      chains_.emplace_back(starts[c], (*target_)(starts[c]), moves, seed, c);
  }

  py::dict advance(size_t steps, bool expected_values) override {
    return advance_each(
        space_, chains_, steps, expected_values, native_,
        [&](lab::Chain<X>& chain, const auto& record) { return chain.step(*target_, record); });
  }

 private:
  Space space_;
  std::shared_ptr<const lab::Target<X>> target_;
  bool native_;
  std::vector<lab::Chain<X>> chains_;
};

/// Chains in lockstep: Python's functions get the states of many chains at once, as an array.
class VectorChains final : public AnyChains {
 public:
  /// `vectorized[i]` is the Python object of move i, or None if that one is built in.
  VectorChains(const Numbers& space, py::object target, const lab::Prototypes<lab::Point>& moves,
               std::vector<py::object> vectorized, const std::vector<lab::Point>& starts,
               uint64_t seed);

  py::dict advance(size_t steps, bool expected_values) override;

 private:
  py::object to_array(const std::vector<lab::Point>& points) const;
  std::vector<double> evaluate(const std::vector<lab::Point>& points) const;
  void draw(const py::object& move, const std::vector<size_t>& group);

  Numbers space_;
  py::object function_;
  std::vector<py::object> vectorized_;
  Rng rng_;
  RandomGenerators generators_;
  std::vector<lab::Chain<lab::Point>> chains_;
};

}  // namespace mlt::python
