// numpy's Generator for the streams of C++, so that a move written in Python draws from the stream
// of its chain with all of numpy's distributions, and a run stays a function of its seed.
#pragma once

#include "bindings.h"

#include "base/rng.h"

#include <vector>

namespace mlt::python {

/// Generators for calls of Python. While one call waits for another thread, that thread gets
/// another generator. Numbers that Python draws outside of a call come from a stream that is equal
/// to `own` at first.
class RandomGenerators {
  struct Generator {
    py::object numpy;  ///< Keeps the stream alive.
    Rng* stream;
  };

 public:
  explicit RandomGenerators(const Rng& own) : own_(own) {}

  /// A `numpy.random.Generator` that draws from `rng` while this object lives.
  class Use {
   public:
    Use(RandomGenerators& all, Rng& rng) : all_(all), rng_(rng), used_(all.take()) {
      std::swap(*used_.stream, rng_);
    }
    ~Use() {
      std::swap(*used_.stream, rng_);
      all_.idle_.push_back(std::move(used_));
    }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

    const py::object& operator*() const { return used_.numpy; }

   private:
    RandomGenerators& all_;
    Rng& rng_;
    Generator used_;
  };

 private:
  Generator take();

  Rng own_;
  std::vector<Generator> idle_;
};

/// Binds the class of the bit generator for numpy.
void bind_random_source(py::module_& m);

}  // namespace mlt::python
