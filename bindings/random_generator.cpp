#include "random_generator.h"

namespace mlt::python {
namespace {

/// What numpy asks of a bit generator: struct bitgen in numpy/random/bitgen.h, a part of numpy's
/// stable C interface ("Extending via CFFI/Cython" in its documentation).
struct BitGenerator {
  void* state;
  uint64_t (*next_uint64)(void*);
  uint32_t (*next_uint32)(void*);
  double (*next_double)(void*);
  uint64_t (*next_raw)(void*);
};

Rng& stream(void* state) { return *static_cast<RandomSource*>(state)->current; }

uint64_t next_bits(void* state) { return stream(state).next_bits(); }
uint32_t next_half(void* state) { return static_cast<uint32_t>(stream(state).next_bits() >> 32); }
double next_number(void* state) { return stream(state).next(); }

/// The Python object that owns both the stream and numpy's view of it.
struct PyBitGenerator {
  explicit PyBitGenerator(std::shared_ptr<RandomSource> s)
      : source(std::move(s)),
        interface{source.get(), next_bits, next_half, next_number, next_bits},
        lock(py::module_::import("threading").attr("Lock")()) {}

  std::shared_ptr<RandomSource> source;
  BitGenerator interface;
  py::object lock;
};

}  // namespace

RandomGenerator::RandomGenerator(const Rng& own) : source_(std::make_shared<RandomSource>(own)) {
  const py::object bits = py::cast(std::make_shared<PyBitGenerator>(source_));
  generator_ = py::module_::import("numpy.random").attr("Generator")(bits);
}

void bind_random_source(py::module_& m) {
  py::class_<PyBitGenerator, std::shared_ptr<PyBitGenerator>>(
      m, "BitGenerator", "The random stream of a chain, as numpy's bit generators are.")
      .def_property_readonly(
          "capsule",
          [](PyBitGenerator& self) { return py::capsule(&self.interface, "BitGenerator"); })
      .def_readonly("lock", &PyBitGenerator::lock);
}

}  // namespace mlt::python
