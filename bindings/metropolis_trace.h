// What chains leave behind, as numpy arrays (or lists, for states that are Python objects).
#pragma once

#include "metropolis_python.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <vector>

namespace mlt::python {

inline py::array_t<double> table_of(size_t chains, size_t columns) {
  return py::array_t<double>(std::vector<size_t>{chains, columns});
}

/// The index of the move that a chain has chosen; -1: none suited its state.
template <class Chain>
int32_t chosen_move(const Chain& chain) {
  return chain.kernel().suited() ? static_cast<int32_t>(chain.kernel().chosen()) : -1;
}

/// States of each chain, in order.
class NumberStore {
 public:
  NumberStore(const Numbers& space, size_t chains, size_t length)
      : width_(space.dimensions),
        length_(length),
        array_(std::vector<size_t>{chains, length, width_}) {}
  void set(size_t chain, size_t i, const lab::Point& x) {
    std::copy(x.begin(), x.end(), array_.mutable_data() + (chain * length_ + i) * width_);
  }
  py::object take() { return std::move(array_); }

 private:
  size_t width_, length_;
  py::array_t<double> array_;
};

class ObjectStore {
 public:
  ObjectStore(const Objects&, size_t chains, size_t length) {
    for (size_t c = 0; c < chains; ++c) lists_.push_back(py::list(length));
  }
  void set(size_t chain, size_t i, const Object& x) { lists_[chain][i] = x.value; }
  py::object take() { return py::cast(lists_); }

 private:
  std::vector<py::list> lists_;
};

inline NumberStore make_store(const Numbers& s, size_t c, size_t n) { return {s, c, n}; }
inline ObjectStore make_store(const Objects& s, size_t c, size_t n) { return {s, c, n}; }

/// Everything that happened in some steps of all chains. With expected values each step leaves two
/// samples, the proposal and the state that it was made from.
template <class Space>
class Trace {
 public:
  using X = typename Space::State;
  Trace(const Space& space, size_t chains, size_t steps, bool expected_values)
      : expected_(expected_values),
        steps_(steps),
        states_(make_store(space, chains, steps)),
        samples_(make_store(space, chains, expected_ ? 2 * steps : 0)),
        weights_(table_of(chains, expected_ ? 2 * steps : 0)),
        acceptance_(table_of(chains, steps)),
        sizes_(table_of(chains, steps)),
        accepted_(std::vector<size_t>{chains, steps}),
        moves_(std::vector<size_t>{chains, steps}) {
    std::fill_n(weights_.mutable_data(), weights_.size(), 0.0);
    sample_weight_ = weights_.mutable_data();
    acceptance_data_ = acceptance_.mutable_data();
    sizes_data_ = sizes_.mutable_data();
    accepted_data_ = accepted_.mutable_data();
    moves_data_ = moves_.mutable_data();
  }

  /// Before a step: both of its samples are x, until they are recorded with a weight.
  void begin(size_t chain, size_t step, const X& x) {
    if (!expected_) return;
    samples_.set(chain, 2 * step, x);
    samples_.set(chain, 2 * step + 1, x);
  }

  void record(size_t chain, size_t step, const X& state, double weight, bool proposal) {
    if (!expected_) return;
    const size_t i = 2 * step + (proposal ? 0 : 1);
    samples_.set(chain, i, state);
    sample_weight_[chain * 2 * steps_ + i] = weight;
  }

  /// After a step: the state, the index of the move that was chosen (-1: none), and its size.
  void end(size_t c, size_t step, const X& x, int32_t move, double size, const StepResult& result) {
    const size_t i = c * steps_ + step;
    states_.set(c, step, x);
    acceptance_data_[i] = result.acceptance;
    accepted_data_[i] = result.accepted >= 0;
    moves_data_[i] = move;
    sizes_data_[i] = size;
  }
  void end(size_t c, size_t step, const lab::Chain<X>& chain, const StepResult& result) {
    end(c, step, chain.state().x, chosen_move(chain), chain.move_size(), result);
  }

  py::dict take() {
    py::dict dict;
    dict["states"] = states_.take();
    dict["samples"] = expected_ ? samples_.take() : py::none();
    dict["weights"] = expected_ ? py::object(std::move(weights_)) : py::none();
    dict["acceptance"] = std::move(acceptance_);
    dict["accepted"] = std::move(accepted_);
    dict["moves"] = std::move(moves_);
    dict["sizes"] = std::move(sizes_);
    return dict;
  }

 private:
  using Store = decltype(make_store(std::declval<Space>(), 0, 0));
  bool expected_;
  size_t steps_;
  Store states_, samples_;
  py::array_t<double> weights_, acceptance_, sizes_;
  py::array_t<bool> accepted_;
  py::array_t<int32_t> moves_;
  double *sample_weight_, *acceptance_data_, *sizes_data_;
  bool* accepted_data_;
  int32_t* moves_data_;
};

}  // namespace mlt::python
