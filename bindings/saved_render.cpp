// Checkpoints, read and resumed.
#include "bindings.h"
#include "py_job.h"
#include "text.h"

#include "job/plugins.h"

#include <pybind11/stl.h>

namespace mlt::python {
namespace {

/// A checkpoint, its path, and the integrator that it names.
struct PyCheckpoint {
  explicit PyCheckpoint(const Text& file)
      : path(file.bytes),
        saved(read_checkpoint(file)),
        made(make_integrator(saved.integrator, plugins())) {}

  py::object built_in() const {
    if (saved.scene.kind != SceneSource::Kind::built_in) return py::none();
    std::optional<std::pair<int, int>> size;
    if (const auto& asked = saved.scene.options.size) size = {asked->x, asked->y};
    const LoadOptions& options = saved.scene.options;
    return py::make_tuple(saved.scene.name, options.defines, size, options.sensor, options.filter);
  }
  LoadedPtr load(const Text& moved_to) const {
    return std::make_shared<LoadedScene>(load_scene(saved, path, moved_to, plugins()));
  }
  void check(const LoadedScene& loaded) const { check_same_scene(saved, path, loaded); }
  void resume(PyJob& job) const { mlt::resume(job, saved, path); }

  std::string path;
  Checkpoint saved;
  MadeIntegrator made;
};

}  // namespace

void bind_checkpoint(py::module_& m) {
  py::class_<PyCheckpoint>(m, "Checkpoint", "A render on disk, read and found whole.")
      .def(py::init<const Text&>(), py::arg("path"), NoGil())
      .def_readonly("integrator", &PyCheckpoint::made)
      .def_property_readonly("seed", [](const PyCheckpoint& c) { return c.saved.seed; })
      .def_property_readonly(
          "built_in", &PyCheckpoint::built_in,
          "(name, defines, size, sensor, filter) of a scene of the package, or None.")
      .def("load_scene", &PyCheckpoint::load, py::arg("moved_to"), NoGil())
      .def("check", &PyCheckpoint::check, py::arg("scene"), NoGil(),
           "Raises SceneError unless it is the checkpoint's scene.")
      .def("resume", &PyCheckpoint::resume, py::arg("job"), NoGil(),
           "Before start: the job goes on from here.");
}

}  // namespace mlt::python
