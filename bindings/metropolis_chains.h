// Chains of one target and one mixture: one after the other, or in lockstep for functions that take
// the states of many chains at once.
#pragma once

#include "metropolis_trace.h"

#include <optional>

namespace mlt::python {

/// Lets Ctrl-C through.
inline void check_signals(size_t step) {
  if (step % 4096 != 0) return;
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// Chains of one target and one mixture, each with a random stream of its own.
template <class Space>
class Chains {
 public:
  using X = typename Space::State;
  using Moves = lab::Prototypes<X>;

  Chains(const Space& space, std::shared_ptr<const lab::Target<X>> target, const Moves& moves,
         const std::vector<X>& starts, uint64_t seed, bool native)
      : space_(space), target_(std::move(target)), native_(native) {
    for (size_t c = 0; c < starts.size(); ++c)
      chains_.emplace_back(starts[c], (*target_)(starts[c]), moves, seed, c);
  }
  virtual ~Chains() = default;

  virtual py::dict advance(size_t steps, bool expected_values) {
    Trace<Space> trace(space_, chains_.size(), steps, expected_values);
    {
      std::optional<py::gil_scoped_release> release;
      if (native_) release.emplace();
      for (size_t c = 0; c < chains_.size(); ++c) advance_one(c, steps, trace);
    }
    return trace.take();
  }

 protected:
  Chains(const Space& space) : space_(space), native_(false) {}

  Space space_;
  std::shared_ptr<const lab::Target<X>> target_;
  bool native_;
  std::vector<lab::Chain<X>> chains_;

 private:
  void advance_one(size_t c, size_t steps, Trace<Space>& trace) {
    lab::Chain<X>& chain = chains_[c];
    for (size_t i = 0; i < steps; ++i) {
      check_signals(i + 1);
      trace.begin(c, i, chain.state().x);
      const StepResult result =
          chain.step(*target_, [&](const X& state, double weight, bool proposal) {
            trace.record(c, i, state, weight, proposal);
          });
      trace.end(c, i, chain, result);
    }
  }
};

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Chains in lockstep: Python's functions get the states of many chains at once, as an array.
class VectorChains final : public Chains<Numbers> {
 public:
  /// `vectorized[i]` is the Python object of move i, or None if that one is built in.
  VectorChains(const Numbers& space, py::object target, const Moves& moves,
               std::vector<py::object> vectorized, const std::vector<lab::Point>& starts,
               uint64_t seed);

  py::dict advance(size_t steps, bool expected_values) override;

 private:
  py::object to_array(const std::vector<lab::Point>& points) const;
  Doubles evaluate(const py::object& points) const;
  void draw(const py::object& move, const std::vector<size_t>& group);

  py::object function_;
  std::vector<py::object> vectorized_;
  RandomGenerator generator_;
};

}  // namespace mlt::python
