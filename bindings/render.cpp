// Integrators and jobs.
#include "bindings.h"
#include "python_mutation.h"
#include "values.h"

#include "io/pack.h"
#include "render/checkpoint.h"
#include "render/output.h"
#include "render/plugins.h"

#include <pybind11/stl.h>

#include <algorithm>

namespace mlt::python {
namespace {

using LoadedPtr = std::shared_ptr<LoadedScene>;

/// A job and what it was made from.
class PyJob {
 public:
  PyJob(LoadedPtr loaded, MadeIntegrator made, const RenderSettings& settings)
      : loaded_(std::move(loaded)),
        made_(std::move(made)),
        seed_(settings.seed),
        job_(std::make_unique<Job>(loaded_->scene, made_.integrator, settings)) {}
  ~PyJob() {
    py::gil_scoped_release release;
    job_->stop();  // while a crew may still use this object
    job_.reset();
  }

  Job& operator*() { return *job_; }
  const LoadedPtr& loaded() const { return loaded_; }
  Stats stats() const { return render_stats(*job_, *loaded_, made_); }
  Metadata metadata() const { return render_metadata(stats(), *loaded_, made_); }
  void checkpoint(const std::string& path) {
    check_checkpoint_writable(path);
    Checkpoint checkpoint = checkpoint_of(*loaded_, made_, seed_);
    checkpoint.state = job_->save();
    write_checkpoint(path, checkpoint);
  }

 private:
  LoadedPtr loaded_;
  MadeIntegrator made_;
  uint64_t seed_;
  std::unique_ptr<Job> job_;
};

/// A checkpoint, its path, and the integrator that it names.
struct PyCheckpoint {
  explicit PyCheckpoint(const std::string& file)
      : path(file),
        saved(read_checkpoint(file)),
        made(make_integrator(saved.integrator, plugins())) {}

  py::object built_in() const {
    if (saved.scene.kind != SceneSource::Kind::built_in) return py::none();
    std::optional<std::pair<int, int>> size;
    if (const auto& asked = saved.scene.options.size) size = {asked->x, asked->y};
    return py::make_tuple(saved.scene.name, saved.scene.options.defines, size);
  }
  LoadedPtr load(const std::string& moved_to) const {
    return std::make_shared<LoadedScene>(load_scene(saved, path, moved_to, plugins()));
  }
  void check(const LoadedScene& loaded) const { check_same_scene(saved, path, loaded); }
  void take(PyJob& job) const { take_up(*job, saved, path); }

  std::string path;
  Checkpoint saved;
  MadeIntegrator made;
};

std::unique_ptr<PyJob> make_job(LoadedPtr loaded, const MadeIntegrator& made,
                                std::optional<double> spp, std::optional<double> time,
                                std::optional<double> error, uint64_t seed, int threads,
                                const std::string& checkpoint, double every) {
  RenderSettings settings;
  settings.budget = {spp, time, error};
  settings.seed = seed;
  settings.threads = threads;
  settings.autosave.every = every;
  if (!checkpoint.empty()) {
    check_checkpoint_writable(checkpoint);
    settings.autosave = autosave_to(checkpoint, every, checkpoint_of(*loaded, made, seed));
  }
  return std::make_unique<PyJob>(std::move(loaded), made, settings);
}

MadeIntegrator by_name(const LoadedScene& loaded, const std::string& name,
                       const Assignments& assignments) {
  return make_integrator(choose_integrator(loaded, name, assignments, plugins()), plugins());
}

MadeIntegrator from_dict(const py::dict& dict) {
  return make_integrator(to_node(dict, "integrator", "integrator", plugins()), plugins());
}

/// mlt with mutations that are written in Python, for this scene alone.
MadeIntegrator with_python_mutations(const MadeIntegrator& made, const LoadedPtr& loaded,
                                     const WeightedObjects& mutations) {
  std::vector<ExtraMutation> extra;
  for (const auto& [object, weight] : mutations) {
    const auto held = hold(object);
    const auto make = [loaded, held](const Scene& scene, const MutationSettings& settings) {
      if (&scene != loaded->scene.get())
        throw UsageError("an integrator with mutations written in Python serves one scene only");
      const py::gil_scoped_acquire gil;
      return to_mutation(loaded, settings, *held);
    };
    extra.push_back({object.attr("name").cast<std::string>(), weight, make});
  }
  return with_mutations(made, extra);
}

/// Waits without the GIL, which mutations written in Python need. What went wrong in one of these is
/// raised as Python knows it, each time anew: an error_already_set serves only once.
bool wait(PyJob& job, double seconds) {
  try {
    const py::gil_scoped_release release;
    return (*job).wait(seconds);
  } catch (const py::error_already_set& error) {
    PyErr_Restore(py::object(error.type()).release().ptr(),
                  py::object(error.value()).release().ptr(),
                  py::object(error.trace()).release().ptr());
    throw py::error_already_set();
  }
}

py::array_t<float> image(PyJob& job) {
  Image image;
  {
    py::gil_scoped_release release;
    image = (*job).image();
  }
  return to_array(std::move(image));
}

/// (images, weights, b): the independent groups of a render.
py::tuple groups(PyJob& job) {
  const Rendering& rendering = (*job).rendering();
  const int count = rendering.group_count();
  const Vec2i size = image_size(*job.loaded()->scene);
  py::array_t<float> images(std::vector<py::ssize_t>{count, size.y, size.x, 3});
  std::vector<double> weights(count), b(count);
  {
    float* to = images.mutable_data();
    py::gil_scoped_release release;
    for (int g = 0; g < count; ++g) {
      const GroupImage group = rendering.group(g);
      to = std::copy(group.image.data.begin(), group.image.data.end(), to);
      weights[g] = group.weight;
      b[g] = group.b;
    }
  }
  return py::make_tuple(images, py::array_t<double>(count, weights.data()),
                        py::array_t<double>(count, b.data()));
}

py::bytes save(PyJob& job) {
  std::string state;
  {
    py::gil_scoped_release release;
    state = (*job).save();
  }
  return state;
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
  Metadata metadata;
  {
    py::gil_scoped_release release;
    metadata = job.metadata();
  }
  py::dict dict;
  for (const auto& [name, value] : metadata) dict[py::str(name)] = value;
  return dict;
}

// ---- units that are run elsewhere

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

void bind_render(py::module_& m) {
  using NoGil = py::call_guard<py::gil_scoped_release>;

  py::class_<MadeIntegrator>(m, "Integrator", "A light transport algorithm with its settings.")
      .def_readonly("settings", &MadeIntegrator::settings, "As JSON.")
      .def_readonly("warnings", &MadeIntegrator::warnings)
      .def(py::pickle(
          [](const MadeIntegrator& made) { return py::bytes(pack(node_of(made))); },
          [](const py::bytes& packed) { return make_integrator(unpack_node(packed), plugins()); }));
  m.def("integrator_by_name", &by_name, py::arg("scene"), py::arg("name"), py::arg("assignments"));
  m.def("integrator_from_dict", &from_dict, py::arg("dict"));
  m.def("with_mutations", &with_python_mutations, py::arg("integrator"), py::arg("scene"),
        py::arg("mutations"));

  py::class_<PyCheckpoint>(m, "Checkpoint", "A render on disk, read and found whole.")
      .def(py::init<const std::string&>(), py::arg("path"), NoGil())
      .def_readonly("integrator", &PyCheckpoint::made)
      .def_property_readonly("seed", [](const PyCheckpoint& c) { return c.saved.seed; })
      .def_property_readonly("built_in", &PyCheckpoint::built_in,
                             "(name, defines, size) of a scene of the package, or None.")
      .def("load_scene", &PyCheckpoint::load, py::arg("moved_to"), NoGil())
      .def("check", &PyCheckpoint::check, py::arg("scene"), NoGil(),
           "Raises SceneError unless it is the checkpoint's scene.")
      .def("take_up", &PyCheckpoint::take, py::arg("job"), NoGil(),
           "Before start: the job goes on from here.");

  py::class_<PyJob>(m, "Job")
      .def(py::init(&make_job), py::arg("scene"), py::arg("integrator"), py::arg("spp"),
           py::arg("time"), py::arg("error"), py::arg("seed"), py::arg("threads"),
           py::arg("checkpoint") = "", py::arg("every") = 60.0)
      .def(
          "start", [](PyJob& job) { (*job).start(); }, NoGil())
      .def("wait", &wait, py::arg("seconds"))
      .def(
          "cancel", [](PyJob& job) { (*job).cancel(); }, NoGil())
      .def("save", &save, "The whole state as bytes; the render goes on.")
      .def(
          "load", [](PyJob& job, const std::string& state) { (*job).load(state); },
          py::arg("state"), NoGil(), "Before start: go on where the state was saved.")
      .def(
          "extend",
          [](PyJob& job, std::optional<double> spp, std::optional<double> time,
             std::optional<double> error) { (*job).extend({spp, time, error}); },
          py::arg("spp"), py::arg("time"), py::arg("error"), NoGil(),
          "After the end: go on to a larger budget.")
      .def("checkpoint", &PyJob::checkpoint, py::arg("path"), NoGil())
      .def("groups", &groups,
           "(images, weights, b) of the independent groups: float32 (G, height, width, 3), float64 "
           "(G,) and (G,); without light that is rendered aside.")
      .def_property_readonly("ended", [](PyJob& job) { return (*job).ended(); })
      .def_property_readonly("cancelled", [](PyJob& job) { return (*job).cancelled(); })
      .def_property_readonly("progress", [](PyJob& job) { return (*job).progress(); })
      .def_property_readonly("spp_done", [](PyJob& job) { return (*job).spp_done(); })
      .def("image", &image)
      .def("replay", &replay, py::arg("pixel"), py::arg("sample"), "(raster, radiance, paths)")
      .def("layers", &layers, "Further images that the render was asked to keep, by name.")
      .def(
          "stats", [](PyJob& job) { return to_json(job.stats()); }, NoGil(), "As JSON.")
      .def("metadata", &metadata)
      .def("hire", &hire, py::arg("crew"),
           "Before start: an object that runs the units, with the methods wanted_parts(), "
           "advance(job, to) and dismiss(); they are called by a thread of the job.")
      // For a crew:
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
