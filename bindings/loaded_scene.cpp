// Loading of scenes, and their properties.
#include "bindings.h"
#include "scene_dict.h"
#include "scene_editing.h"
#include "scene_parts.h"
#include "shape_triangles.h"
#include "text.h"

#include "io/animation_times.h"
#include "io/pack.h"
#include "io/view_nodes.h"
#include "job/make_integrator.h"
#include "job/output.h"
#include "job/plugins.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace mlt::python {
namespace {

using Size = std::optional<std::pair<int, int>>;
using Sensor = std::optional<int64_t>;
using Defines = std::map<std::string, Text>;

LoadOptions load_options(const Size& size, const Sensor& sensor, const std::string& filter,
                         const Defines& defines = {}, std::optional<bool> lenient = {}) {
  LoadOptions options;
  options.sensor = sensor;
  options.filter = filter;
  options.lenient = lenient;
  options.defines.insert(defines.begin(), defines.end());
  if (size) options.size = Vec2i(size->first, size->second);
  return options;
}

/// Adds a warning if the scene's own integrator cannot render here; the scene may still be useful.
LoadedScene warned(LoadedScene loaded) {
  if (const std::string problem = integrator_problem(loaded, plugins()); !problem.empty())
    loaded.warnings.push_back(problem + "; the scene cannot be rendered unless another is named");
  return loaded;
}

LoadedScene from_file(const Text& path, const Defines& defines, const Size& size,
                      std::optional<bool> lenient, const Sensor& sensor,
                      const std::string& filter) {
  return warned(load_file(path, plugins(), load_options(size, sensor, filter, defines, lenient)));
}

LoadedScene from_string(const Text& xml, const Text& directory, const Defines& defines,
                        const Size& size, std::optional<bool> lenient, const Sensor& sensor,
                        const std::string& filter) {
  return warned(
      load_string(xml, directory, plugins(), load_options(size, sensor, filter, defines, lenient)));
}

/// `built_in` and `defines` name a scene of the Python package, for checkpoints.
LoadedScene scene_from_dict(const py::dict& dict, const Size& size, const Sensor& sensor,
                            const std::string& filter, const std::string& built_in,
                            const Defines& defines) {
  const Node node = to_node(dict, "scene", "scene", plugins());
  if (node.type != "scene")
    throw SceneError("scene: 'type' is '" + node.type + "', but should be 'scene'");
  const ReleasedGil release;
  LoadedScene loaded = build_scene(node, plugins(), load_options(size, sensor, filter));
  if (const std::string problem = integrator_problem(loaded, plugins()); !problem.empty())
    throw SceneError(problem);
  if (!built_in.empty())
    loaded.source = {SceneSource::Kind::built_in, built_in, "",
                     load_options(size, sensor, filter, defines)};
  return loaded;
}

py::dict info(const LoadedScene& loaded) {
  const Scene& scene = *loaded.scene;
  const Vec2i size = image_size(scene);
  const Vec3 center = scene.bounds().center + scene.origin();
  py::dict info;
  info["size"] = py::make_tuple(size.x, size.y);
  info["shapes"] = scene.shapes().size();
  info["triangles"] = scene.triangle_count();
  info["bytes"] = scene.bytes();
  info["emitters"] = scene.emitters().size();
  info["center"] = py::make_tuple(center.x, center.y, center.z);
  info["radius"] = scene.bounds().radius;
  info["integrator"] =
      loaded.integrator ? py::object(py::str(loaded.integrator->type)) : py::none();
  info["sensors"] = sensor_count(loaded.tree);
  info["sample_count"] = scene.sample_count();
  info["spectral"] = scene.camera().spectral();
  info["filter"] =
      scene.film().filter ? py::object(py::str(scene.film().filter->name())) : py::none();
  info["seconds"] = loaded.seconds;
  info["warnings"] = to_list(loaded.warnings);
  return info;
}

using BandEnds = std::optional<std::pair<double, double>>;

LoadedScene spectral_scene(const LoadedScene& loaded, const BandEnds& band) {
  return with_wavelengths(loaded, band ? fmt::format("{}:{}", band->first, band->second) : "",
                          plugins());
}

py::str describe_scene(const LoadedScene& loaded) {
  return py::str(
             "Scene({size[0]} x {size[1]}, {shapes} shapes, {triangles} triangles, {emitters} "
             "emitters, integrator={integrator!r})")
      .format(**info(loaded));
}

}  // namespace

void bind_scene(py::module_& m) {
  py::class_<LoadedScene, LoadedPtr> scene(
      m, "Scene", "An immutable world, as load_file, load_string or load_dict made it.");
  bind_scene_parts(scene);
  scene.def_property_readonly("width", [](const LoadedScene& s) { return image_size(*s.scene).x; })
      .def_property_readonly("height", [](const LoadedScene& s) { return image_size(*s.scene).y; })
      .def_property_readonly(
          "warnings", [](const LoadedScene& s) { return to_list(s.warnings); },
          "One line each, with file and line.")
      .def_property_readonly(
          "half", [](const LoadedScene& s) { return s.scene->film().half_precision; },
          "Whether the film asks for 16-bit EXR samples.")
      .def_property_readonly(
          "hash", [](const LoadedScene& s) { return fmt::format("{:016x}", s.hash); },
          "Of the description and of the files that it names, wherever they lie.")
      .def(py::pickle([](const LoadedScene& s) { return py::bytes(pack(s)); },
                      [](const py::bytes& bytes) {
                        const std::string packed = bytes;
                        const ReleasedGil release;
                        return std::make_shared<LoadedScene>(unpack_scene(packed, plugins()));
                      }))
      .def("with_wavelengths", &spectral_scene, py::arg("band") = py::none(), NoGil(),
           "The same scene, with spectral films: light has wavelengths instead of R, G and B.\n\n"
           "With a `band` of wavelengths, as in (400, 430), the image shows the mean radiance in "
           "it,\nper nm, as a grey.")
      .def(
          "animations", [](const LoadedScene& s) { return animation_times(s.tree); },
          "From when to when anything moves or changes: the times of keys that follow each other "
          "and differ.")
      .def("parameters", &scene_parameters, "What can be changed, by name, with its current value.")
      .def(
          "updated",
          [](const LoadedScene& s, const py::dict& values) {
            return warned(updated_scene(s, values));
          },
          py::arg("values"),
          "The scene with other values of some of its parameters.\n\n"
          "`values` maps names such as \"camera.to_world\" to values as a scene dict has them. "
          "What "
          "stays\nthe same is shared with this scene, which does not change. Raises UsageError for "
          "a "
          "name that\nthe scene does not have, SceneError for a value that does not fit.")
      .def(
          "triangles", &shape_triangles,
          "The shapes as triangles, to be drawn: a list of dicts with shape (as LightPath.vertices "
          "counts\nthem), positions (n, 3), faces (m, 3), albedo (RGB, at one point) and emits. A "
          "shape that is an\nequation is a grid of 32 x 32 cells; one that moves is where it is at "
          "time 0.")
      .def("info", &info, "What the scene holds, as a dict.")
      .def("__repr__", &describe_scene);

  m.def("load_file", &from_file, py::arg("path"), py::arg("defines"), py::arg("size"),
        py::arg("lenient"), py::arg("sensor"), py::arg("filter"), NoGil());
  m.def("load_string", &from_string, py::arg("xml"), py::arg("directory"), py::arg("defines"),
        py::arg("size"), py::arg("lenient"), py::arg("sensor"), py::arg("filter"), NoGil());
  m.def("load_dict", &scene_from_dict, py::arg("dict"), py::arg("size"), py::arg("sensor"),
        py::arg("filter"), py::arg("built_in") = "", py::arg("defines") = Defines());
}

}  // namespace mlt::python
