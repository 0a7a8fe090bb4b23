// Units that are run elsewhere: a job's crew, and the other side, which carries out its orders.
#include "bindings.h"
#include "py_job.h"

#include <pybind11/stl.h>

#include <atomic>

namespace mlt::python {
namespace {

/// A Python object with the methods of Crew.
class PyCrew : public Crew {
 public:
  PyCrew(PyJob& job, py::object crew) : job_(&job), crew_(std::move(crew)) {}
  ~PyCrew() override {
    const py::gil_scoped_acquire acquire;
    crew_ = py::object();
  }

  int wanted_parts() override {
    const py::gil_scoped_acquire acquire;
    return call("wanted_parts").cast<int>();
  }
  void advance(Job& /*job*/, uint64_t to) override {
    const py::gil_scoped_acquire acquire;
    call("advance", py::cast(job_, py::return_value_policy::reference), to);
  }
  void dismiss() override {
    const py::gil_scoped_acquire acquire;
    call("dismiss");
  }

 private:
  /// With the interpreter's lock.
  template <class... Arguments>
  py::object call(const char* method, const Arguments&... arguments) {
    try {
      return crew_.attr(method)(arguments...);
    } catch (const py::error_already_set& error) {
      throw RenderError(py::str(error.value()));
    }
  }

  PyJob* job_;
  py::object crew_;
};

void hire(PyJob& job, py::object crew) {
  (*job).hire(std::make_unique<PyCrew>(job, std::move(crew)));
}

py::bytes order(PyJob& job, size_t part, uint64_t to) {
  std::string bytes;
  {
    py::gil_scoped_release release;
    bytes = (*job).division().order(part, to);
  }
  return bytes;
}

/// Carries out orders on a machine that is not the owner's.
class Helper {
 public:
  Helper(LoadedPtr loaded, MadeIntegrator made)
      : loaded_(std::move(loaded)), made_(std::move(made)) {}
  py::bytes run(const std::string& order, int threads) {
    std::string outcome;
    {
      py::gil_scoped_release release;
      outcome = carry_out(order, loaded_->scene, *made_.integrator, threads, cancelled_);
    }
    return outcome;
  }
  void cancel() { cancelled_ = true; }

 private:
  LoadedPtr loaded_;
  MadeIntegrator made_;
  std::atomic<bool> cancelled_{false};
};

}  // namespace

void bind_crew(py::module_& m) {
  using NoGil = py::call_guard<py::gil_scoped_release>;

  static_cast<py::class_<PyJob>>(m.attr("Job"))
      .def("hire", &hire, py::arg("crew"),
           "Before start: an object that runs the units, with the methods wanted_parts(), "
           "advance(job, to) and dismiss(); they are called by a thread of the job.")
      .def_property_readonly("stopping", [](PyJob& job) { return (*job).stopping(); })
      .def_property_readonly("interrupted", [](PyJob& job) { return (*job).interrupted(); })
      .def_property_readonly("units_done", [](PyJob& job) { return (*job).units_done(); })
      .def_property_readonly("units_per_step", [](PyJob& job) { return (*job).units_per_step(); })
      .def_property_readonly("parts", [](PyJob& job) { return (*job).division().parts(); })
      .def(
          "position", [](PyJob& job, size_t part) { return (*job).division().position(part); },
          py::arg("part"), "Up to which unit the part is done.")
      .def(
          "pass_over",
          [](PyJob& job, size_t part, uint64_t to) { return (*job).division().pass(part, to); },
          py::arg("part"), py::arg("to"), "Move a part on that has nothing to do until there.")
      .def(
          "split", [](PyJob& job, size_t part) { return (*job).division().split(part); },
          py::arg("part"), "Cut a part in two; False if it is too small.")
      .def("order", &order, py::arg("part"), py::arg("to"), "What Helper.run needs to know.")
      .def(
          "fold",
          [](PyJob& job, size_t part, const std::string& outcome) { (*job).fold(part, outcome); },
          py::arg("part"), py::arg("outcome"), NoGil(), "What Helper.run has returned.");

  py::class_<Helper>(m, "Helper", "Runs units of a render that another process owns.")
      .def(py::init<LoadedPtr, MadeIntegrator>(), py::arg("scene"), py::arg("integrator"))
      .def("run", &Helper::run, py::arg("order"), py::arg("threads"))
      .def("cancel", &Helper::cancel, "Whatever it runs now or later ends soon.");
}

}  // namespace mlt::python
