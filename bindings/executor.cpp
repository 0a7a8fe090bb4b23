// Units that are run elsewhere: a job's executor, and the workers that run its tasks.
#include "bindings.h"
#include "py_job.h"

#include <atomic>

namespace mlt::python {
namespace {

/// A Python object with the methods of Executor.
class PyExecutor : public Executor {
 public:
  PyExecutor(PyJob& job, py::object executor) : job_(&job), executor_(hold(std::move(executor))) {}

  int wanted_tasks() override { return call<int>("wanted_tasks"); }
  void run(Job& /*job*/, uint64_t to) override { call<void>("run", job_, to); }
  void close() override { call<void>("close"); }

 private:
  template <class Result, class... Arguments>
  Result call(const char* method, const Arguments&... arguments) {
    const AcquiredGil acquire;
    try {
      return executor_->attr(method)(arguments...).template cast<Result>();
    } catch (const py::error_already_set& error) {
      throw RenderError(py::str(error.value()));
    }
  }

  PyJob* job_;
  std::shared_ptr<py::object> executor_;
};

/// Runs tasks on a machine that is not the owner's.
class Helper {
 public:
  Helper(LoadedPtr loaded, MadeIntegrator made)
      : loaded_(std::move(loaded)), made_(std::move(made)) {}
  py::bytes run(const std::string& task, int threads) {
    return without_gil(
        [&] { return mlt::run(task, loaded_->scene, *made_.integrator, threads, cancelled_); });
  }
  void cancel() { cancelled_ = true; }

 private:
  LoadedPtr loaded_;
  MadeIntegrator made_;
  std::atomic<bool> cancelled_{false};
};

}  // namespace

void bind_executor(py::module_& m) {
  static_cast<py::class_<PyJob>>(m.attr("Job"))
      .def(
          "attach",
          [](PyJob& job, py::object executor) {
            job.attach(std::make_unique<PyExecutor>(job, std::move(executor)));
          },
          py::arg("executor"),
          "Before start: an object that runs the units, with the methods wanted_tasks(), "
          "run(job, to) and close(); they are called by a thread of the job.")
      .def_property_readonly("stopping", &PyJob::stopping)
      .def_property_readonly("interrupted", &PyJob::interrupted)
      .def_property_readonly("units_done", &PyJob::units_done)
      .def_property_readonly(
          "units_per_cycle", [](PyJob& job) { return job.rendering().plan().units_per_cycle; },
          "After this number of units each strand has had its turn.")
      .def_property_readonly("task_count", [](PyJob& job) { return job.tasks().size(); })
      .def(
          "position", [](PyJob& job, size_t task) { return job.tasks().position(task); },
          py::arg("task"), "Up to which unit the task's strands are done.")
      .def(
          "skip", [](PyJob& job, size_t task, uint64_t to) { return job.tasks().skip(task, to); },
          py::arg("task"), py::arg("to"), "Move a task on that has nothing to do until there.")
      .def(
          "split", [](PyJob& job, size_t task) { return job.tasks().split(task); }, py::arg("task"),
          "Cut a task in two; False if it has but one strand.")
      .def(
          "task",
          [](PyJob& job, size_t task, uint64_t to) -> py::bytes {
            return without_gil([&] { return job.tasks().task(task, to); });
          },
          py::arg("task"), py::arg("to"), "What Helper.run needs to know.")
      .def("merge", &PyJob::merge, py::arg("task"), py::arg("result"), NoGil(),
           "Take in what Helper.run has returned.");

  py::class_<Helper>(m, "Helper", "Runs units of a render that another process owns.")
      .def(py::init<LoadedPtr, MadeIntegrator>(), py::arg("scene"), py::arg("integrator"))
      .def("run", &Helper::run, py::arg("task"), py::arg("threads"))
      .def("cancel", &Helper::cancel, "Whatever it runs now or later ends soon.");
}

}  // namespace mlt::python
