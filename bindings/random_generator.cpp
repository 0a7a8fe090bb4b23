#include "random_generator.h"

namespace mlt::python {
namespace {

uint64_t next_bits(void* rng) { return static_cast<Rng*>(rng)->next_bits(); }
uint32_t next_half(void* rng) { return static_cast<uint32_t>(next_bits(rng) >> 32); }
double next_number(void* rng) { return static_cast<Rng*>(rng)->next(); }

/// A stream, and the functions of a bit generator of numpy.
struct BitGenerator {
  explicit BitGenerator(const Rng& own) : stream(own) {}

  Rng stream;
  /// struct bitgen in numpy/random/bitgen.h, a part of numpy's stable C interface ("Extending via
  /// CFFI/Cython" in its documentation).
  struct {
    void* state;
    uint64_t (*next_uint64)(void*);
    uint32_t (*next_uint32)(void*);
    double (*next_double)(void*);
    uint64_t (*next_raw)(void*);
  } interface{&stream, next_bits, next_half, next_number, next_bits};
  py::object lock = py::module_::import("threading").attr("Lock")();
};

}  // namespace

RandomGenerators::Generator RandomGenerators::take() {
  if (idle_.empty()) {
    auto bits = std::make_unique<BitGenerator>(own_);
    Rng* const stream = &bits->stream;
    return {py::module_::import("numpy.random").attr("Generator")(std::move(bits)), stream};
  }
  const Generator last = std::move(idle_.back());
  idle_.pop_back();
  return last;
}

void bind_random_source(py::module_& m) {
  py::class_<BitGenerator>(m, "BitGenerator",
                           "The random stream of a chain, as numpy's bit generators are.")
      .def_property_readonly(
          "capsule",
          [](BitGenerator& self) { return py::capsule(&self.interface, "BitGenerator"); })
      .def_readonly("lock", &BitGenerator::lock);
}

}  // namespace mlt::python
