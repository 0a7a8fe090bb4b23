// The trace of chains, as numpy arrays (or lists, for states that are Python objects).
#pragma once

#include "metropolis_python.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <vector>

namespace mlt::python {

/// Checks for Ctrl-C now and then.
inline void check_signals(size_t step) {
  if (step % 4096 != 0) return;
  const AcquiredGil acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// An array with one row for each chain, whose elements are set without the interpreter's lock.
template <class T>
class Table {
 public:
  Table(size_t chains, size_t columns)
      : columns_(columns),
        array_(std::vector<size_t>{chains, columns}),
        data_(array_.mutable_data()) {}
  T& operator()(size_t chain, size_t i) { return data_[chain * columns_ + i]; }
  py::object take() { return std::move(array_); }

 private:
  size_t columns_;
  py::array_t<T> array_;
  T* data_;
};

/// States of each chain, in order.
template <class Space>
class Store;

template <>
class Store<Numbers> {
 public:
  Store(const Numbers& space, size_t chains, size_t length)
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

template <>
class Store<Objects> {
 public:
  Store(const Objects&, size_t chains, size_t length) {
    for (size_t c = 0; c < chains; ++c) lists_.push_back(py::list(length));
  }
  void set(size_t chain, size_t i, const Object& x) { lists_[chain][i] = x.value; }
  py::object take() { return py::cast(lists_); }

 private:
  std::vector<py::list> lists_;
};

/// The trace of some steps of all chains. With expected values each step records two samples, the
/// proposal and the state that it was made from.
template <class Space>
class Trace {
 public:
  using X = typename Space::State;
  Trace(const Space& space, size_t chains, size_t steps, bool expected_values)
      : expected_(expected_values),
        states_(space, chains, steps),
        samples_(space, chains, expected_ ? 2 * steps : 0),
        weights_(chains, expected_ ? 2 * steps : 0),
        acceptance_(chains, steps),
        sizes_(chains, steps),
        accepted_(chains, steps),
        moves_(chains, steps) {}

  /// Records step i of chain c, which `make(record)` takes; it calls record(x, weight, is_proposal)
  /// for each sample. One without a weight is the state before.
  template <class Chain, class Make>
  void step(size_t c, size_t i, const Chain& chain, Make&& make) {
    check_signals(i + 1);
    const auto record = [&](const X& x, double weight, bool is_proposal) {
      if (!expected_) return;
      const size_t sample = 2 * i + (is_proposal ? 0 : 1);
      samples_.set(c, sample, x);
      weights_(c, sample) = weight;
    };
    for (const bool is_proposal : {true, false}) record(chain.state().x, 0, is_proposal);
    const StepResult result = make(record);
    states_.set(c, i, chain.state().x);
    acceptance_(c, i) = result.acceptance;
    accepted_(c, i) = result.accepted >= 0;
    const auto& mixture = chain.kernel();  // move -1: none suited the state
    moves_(c, i) = mixture.suited() ? static_cast<int32_t>(mixture.chosen()) : -1;
    sizes_(c, i) = chain.move_size();
  }

  py::dict take() {
    py::dict dict;
    dict["states"] = states_.take();
    dict["samples"] = expected_ ? samples_.take() : py::none();
    dict["weights"] = expected_ ? weights_.take() : py::none();
    dict["acceptance"] = acceptance_.take();
    dict["accepted"] = accepted_.take();
    dict["moves"] = moves_.take();
    dict["sizes"] = sizes_.take();
    return dict;
  }

 private:
  bool expected_;
  Store<Space> states_, samples_;
  Table<double> weights_, acceptance_, sizes_;
  Table<bool> accepted_;
  Table<int32_t> moves_;
};

}  // namespace mlt::python
