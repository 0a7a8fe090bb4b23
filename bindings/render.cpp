// Integrators and jobs.
#include "bindings.h"
#include "light_path.h"
#include "values.h"

#include "render/output.h"
#include "render/plugins.h"

#include <pybind11/stl.h>

namespace mlt::python {
namespace {

using LoadedPtr = std::shared_ptr<LoadedScene>;

/// A job and what it was made from.
class PyJob {
 public:
  PyJob(LoadedPtr loaded, MadeIntegrator made, const RenderSettings& settings)
      : loaded_(std::move(loaded)),
        made_(std::move(made)),
        job_(std::make_unique<Job>(loaded_->scene, made_.integrator, settings)) {}
  ~PyJob() {
    py::gil_scoped_release release;
    job_.reset();
  }

  Job& operator*() { return *job_; }
  const LoadedPtr& loaded() const { return loaded_; }
  Stats stats() const { return render_stats(*job_, *loaded_, made_); }
  Metadata metadata() const { return render_metadata(stats(), made_); }

 private:
  LoadedPtr loaded_;
  MadeIntegrator made_;
  std::unique_ptr<Job> job_;
};

std::unique_ptr<PyJob> make_job(LoadedPtr loaded, const MadeIntegrator& made,
                                std::optional<double> spp, std::optional<double> time,
                                uint64_t seed, int threads) {
  RenderSettings settings;
  settings.budget = {spp, time};
  settings.seed = seed;
  settings.threads = threads;
  return std::make_unique<PyJob>(std::move(loaded), made, settings);
}

MadeIntegrator by_name(const LoadedScene& loaded, const std::string& name,
                       const Assignments& assignments) {
  return make_integrator(choose_integrator(loaded, name, assignments, plugins()), plugins());
}

MadeIntegrator from_dict(const py::dict& dict) {
  return make_integrator(to_node(dict, "integrator", "integrator", plugins()), plugins());
}

py::array_t<float> image(PyJob& job) {
  Image image;
  {
    py::gil_scoped_release release;
    image = (*job).image();
  }
  return to_array(std::move(image));
}

py::dict layers(PyJob& job) {
  std::vector<NamedImage> layers;
  {
    py::gil_scoped_release release;
    layers = (*job).layers();
  }
  py::dict dict;
  for (NamedImage& layer : layers) dict[py::str(layer.name)] = to_array(std::move(layer.image));
  return dict;
}

py::tuple replay(PyJob& job, const std::pair<int, int>& pixel, uint64_t sample) {
  const Vec2i at(pixel.first, pixel.second);
  check_pixel(*job.loaded()->scene, at);
  Replay replay = (*job).replay(at, sample);
  std::vector<PyLightPath> paths;
  for (FoundPath& found : replay.paths) paths.push_back(light_path(job.loaded(), std::move(found)));
  return py::make_tuple(py::make_tuple(replay.raster.x, replay.raster.y), to_array(replay.radiance),
                        paths);
}

py::dict metadata(PyJob& job) {
  py::dict dict;
  for (const auto& [name, value] : job.metadata()) dict[py::str(name)] = value;
  return dict;
}

}  // namespace

void bind_render(py::module_& m) {
  using NoGil = py::call_guard<py::gil_scoped_release>;

  py::class_<MadeIntegrator>(m, "Integrator", "A light transport algorithm with its settings.")
      .def_readonly("settings", &MadeIntegrator::settings, "As JSON.")
      .def_readonly("warnings", &MadeIntegrator::warnings);
  m.def("integrator_by_name", &by_name, py::arg("scene"), py::arg("name"), py::arg("assignments"));
  m.def("integrator_from_dict", &from_dict, py::arg("dict"));

  py::class_<PyJob>(m, "Job")
      .def(py::init(&make_job), py::arg("scene"), py::arg("integrator"), py::arg("spp"),
           py::arg("time"), py::arg("seed"), py::arg("threads"))
      .def(
          "start", [](PyJob& job) { (*job).start(); }, NoGil())
      .def(
          "wait", [](PyJob& job, double seconds) { return (*job).wait(seconds); },
          py::arg("seconds"), NoGil())
      .def(
          "cancel", [](PyJob& job) { (*job).cancel(); }, NoGil())
      .def_property_readonly("ended", [](PyJob& job) { return (*job).ended(); })
      .def_property_readonly("cancelled", [](PyJob& job) { return (*job).cancelled(); })
      .def_property_readonly("progress", [](PyJob& job) { return (*job).progress(); })
      .def("image", &image)
      .def("replay", &replay, py::arg("pixel"), py::arg("sample"), "(raster, radiance, paths)")
      .def("layers", &layers, "Further images that the render was asked to keep, by name.")
      .def(
          "stats", [](PyJob& job) { return to_json(job.stats()); }, NoGil(), "As JSON.")
      .def("metadata", &metadata);
}

}  // namespace mlt::python
