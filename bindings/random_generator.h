// numpy's Generator on top of our streams, so that a move written in Python draws from the stream
// of its chain with all of numpy's distributions, and a run stays a function of its seed.
#pragma once

#include "bindings.h"

#include "base/rng.h"

#include <memory>

namespace mlt::python {

/// A stream that numbers come from: usually that of a chain.
struct RandomSource {
  explicit RandomSource(const Rng& rng) : own(rng), current(&own) {}
  RandomSource(const RandomSource&) = delete;
  RandomSource& operator=(const RandomSource&) = delete;

  Rng own;
  Rng* current;
};

/// The `numpy.random.Generator` of a run; it draws from whichever stream it is pointed to.
class RandomGenerator {
 public:
  explicit RandomGenerator(const Rng& own);

  /// While an object of this class lives, numbers come from `rng`.
  class Use {
   public:
    Use(const RandomGenerator& generator, Rng& rng) : source_(generator.source_) {
      source_->current = &rng;
    }
    ~Use() { source_->current = &source_->own; }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

   private:
    std::shared_ptr<RandomSource> source_;
  };

  const py::object& generator() const { return generator_; }

 private:
  std::shared_ptr<RandomSource> source_;
  py::object generator_;
};

/// The class of the bit generator that numpy sees.
void bind_random_source(py::module_& m);

}  // namespace mlt::python
