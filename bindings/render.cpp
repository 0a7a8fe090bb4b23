// Jobs.
#include "bindings.h"
#include "light_path.h"
#include "py_job.h"
#include "scene_dict.h"
#include "text.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

namespace mlt::python {
namespace {

std::unique_ptr<PyJob> make_job(LoadedPtr loaded, const MadeIntegrator& made,
                                std::optional<double> spp, std::optional<double> time,
                                std::optional<double> error, uint64_t seed, int threads,
                                const CheckpointFile& checkpoint, const std::optional<Text>& aovs,
                                bool alpha) {
  RenderSettings settings;
  settings.budget = {spp, time, error};
  settings.seed = seed;
  settings.threads = threads;
  const std::string& asked = made.aovs.empty() ? loaded->aovs : made.aovs;
  ask_for_layers(aovs ? std::string(*aovs) : asked, *loaded, settings);
  settings.alpha = alpha;
  settings.hide_emitters = made.hide_emitters;
  settings.autosave.every = checkpoint.every;
  if (!checkpoint.path.empty())
    settings.autosave = autosave_to(checkpoint, checkpoint_of(*loaded, made, seed));
  return std::make_unique<PyJob>(std::move(loaded), made, settings);
}

/// Waits without the GIL, which mutations written in Python need. An exception of one of these is
/// raised as its Python object, each time anew: an error_already_set can be used only once.
bool wait(PyJob& job, double seconds) {
  try {
    return without_gil([&] { return job.wait(seconds); });
  } catch (const py::error_already_set& error) {
    PyErr_Restore(py::object(error.type()).release().ptr(),
                  py::object(error.value()).release().ptr(),
                  py::object(error.trace()).release().ptr());
    throw py::error_already_set();
  }
}

void checkpoint(PyJob& job, const Text& path, bool overwrite) {
  without_gil([&] { job.checkpoint(path, overwrite); });
}

/// Returns (images, weights, b) of the independent groups of a render.
py::tuple groups(PyJob& job) {
  const Rendering& rendering = job.rendering();
  const int count = Rendering::group_count;
  const Vec2i size = image_size(*job.loaded()->scene);
  py::array_t<float> images(std::vector<py::ssize_t>{count, size.y, size.x, 3});
  std::vector<double> weights(count), b(count);
  {
    float* to = images.mutable_data();
    const ReleasedGil release;
    Image parts(size.x, size.y, 3);
    for (const Rendering* part : rendering.parts()) parts += part->image();
    for (int g = 0; g < count; ++g) {
      GroupImage group = rendering.group(g);
      group.image += parts;
      to = std::copy(group.image.data.begin(), group.image.data.end(), to);
      weights[g] = group.weight;
      b[g] = group.b;
    }
  }
  return py::make_tuple(images, py::array_t<double>(count, weights.data()),
                        py::array_t<double>(count, b.data()));
}

py::object halves(PyJob& job, int layer) {
  std::optional<Halves> halves = without_gil([&] { return job.halves(layer); });
  if (!halves) return py::none();
  const auto pair = [](Half& half) {
    return py::make_tuple(to_array(std::move(half.image)), to_array(std::move(half.robust)));
  };
  return py::make_tuple(pair(halves->first), pair(halves->second));
}

void judge_by(PyJob& job, py::function error) {
  job.judge_by([held = hold(std::move(error))] {
    const AcquiredGil gil;
    return py::cast<double>((*held)());
  });
}

std::optional<double> known(double error) {
  return std::isnan(error) ? std::nullopt : std::optional(error);
}

std::optional<double> relative_error(const PyJob& job, int layer) {
  return known(without_gil([&] {
    return (layer < 0 ? *job.error() : estimate_error(job.rendering(), layer)).relative.value;
  }));
}

std::optional<double> flicker(const PyJob& job, const PyJob& before, int layer, int layer_before,
                              float factor_before) {
  return known(without_gil([&] {
    return error_of_change({&before.rendering(), layer_before, factor_before},
                           {&job.rendering(), layer})
        .value;
  }));
}

py::dict by_name(std::vector<NamedImage> images) {
  py::dict dict;
  for (NamedImage& one : images) dict[py::str(one.name)] = to_array(std::move(one.image));
  return dict;
}

py::dict layers(PyJob& job) {
  return by_name(without_gil([&] { return job.layers(); }));
}

py::dict light(PyJob& job) {
  return by_name(without_gil([&] { return job.light(); }));
}

std::vector<std::string> light_groups(PyJob& job) {
  const LightLayers* light = job.rendering().light_layers();
  if (!light) return {};
  return {light->names().begin(), light->names().begin() + light->group_count()};
}

py::tuple replay(PyJob& job, const std::pair<int, int>& pixel, uint64_t sample) {
  const Vec2i at(pixel.first, pixel.second);
  check_pixel(*job.loaded()->scene, at);
  Replay replay = job.replay(at, sample);
  std::vector<PyLightPath> paths;
  for (FoundPath& found : replay.paths) paths.push_back(light_path(job.loaded(), std::move(found)));
  return py::make_tuple(py::make_tuple(replay.raster.x, replay.raster.y), to_array(replay.radiance),
                        paths);
}

py::dict job_metadata(PyJob& job) {
  return py::cast(without_gil([&] { return job.metadata(); }));
}

}  // namespace

void bind_render(py::module_& m) {
  py::class_<CheckpointFile>(m, "CheckpointFile", "Where a render keeps its state.")
      .def(py::init([](const Text& path, double every, bool overwrite) {
             return CheckpointFile{path, every, overwrite};
           }),
           py::arg("path"), py::arg("every"), py::arg("overwrite"));

  py::class_<PyJob>(m, "Job")
      .def(py::init(&make_job), py::arg("scene"), py::arg("integrator"), py::arg("spp"),
           py::arg("time"), py::arg("error"), py::arg("seed"), py::arg("threads"),
           py::arg("checkpoint"), py::arg("aovs"), py::arg("alpha"))
      .def("judge_by", &judge_by, py::arg("error"),
           "Before start: what tells the error that the budget bounds, an upper bound or NaN; a "
           "thread of the job calls it.")
      .def("start", &PyJob::start, NoGil())
      .def("wait", &wait, py::arg("seconds"))
      .def("cancel", &PyJob::cancel, NoGil())
      .def(
          "save", [](PyJob& job) -> py::bytes { return without_gil([&] { return job.save(); }); },
          "The whole state as bytes; the render goes on.")
      .def("load", &PyJob::load, py::arg("state"), NoGil(),
           "Before start: go on where the state was saved.")
      .def(
          "extend",
          [](PyJob& job, std::optional<double> spp, std::optional<double> time,
             std::optional<double> error) { job.extend({spp, time, error}); },
          py::arg("spp"), py::arg("time"), py::arg("error"), NoGil(),
          "After the end: go on to a larger budget.")
      .def("checkpoint", &checkpoint, py::arg("path"), py::arg("overwrite"))
      .def("groups", &groups,
           "(images, weights, b) of the independent groups: float32 (G, height, width, 3), float64 "
           "(G,) and (G,); without direct light that is rendered separately.")
      .def_property_readonly("has_alpha", &PyJob::has_alpha)
      .def_property_readonly("ended", &PyJob::ended)
      .def_property_readonly("cancelled", &PyJob::cancelled)
      .def_property_readonly("progress", &PyJob::progress)
      .def_property_readonly("spp_done", &PyJob::spp_done)
      .def("image", [](PyJob& job) { return to_array(without_gil([&] { return job.image(); })); })
      .def("replay", &replay, py::arg("pixel"), py::arg("sample"), "(raster, radiance, paths)")
      .def("image_without_fireflies",
           [](PyJob& job) {
             return to_array(without_gil([&] { return job.image_without_fireflies(); }));
           })
      .def("halves", &halves, py::arg("layer") = Rendering::all_light,
           "Two halves of the image so far, or of a layer of light, that share no group, each as "
           "(image, image without fireflies); None while there are fewer than four groups.")
      .def("relative_error", &relative_error, py::arg("layer") = Rendering::all_light,
           "The relative error so far, of a layer of light if asked, or None if nothing is known.")
      .def("flicker", &flicker, py::arg("before"), py::arg("layer") = Rendering::all_light,
           py::arg("layer_before") = Rendering::all_light, py::arg("factor_before") = 1.0f,
           "After the end of both: the relative error of the change from the image of another job, "
           "times a factor, or None if nothing is known; of layers of light, if asked.")
      .def("layers", &layers, "Further images that the render was asked to keep, by name.")
      .def("light", &light, "The light of each lamp so far, by the names of these layers.")
      .def_property_readonly("light_groups", &light_groups)
      .def(
          "stats", [](PyJob& job) { return to_json(job.stats()); }, NoGil(), "As JSON.")
      .def("metadata", &job_metadata);
}

}  // namespace mlt::python
