// Vertices of light paths as Python objects, and the functions of Scene that sample new ones.
#include "light_path.h"
#include "ray_arrays.h"

#include <pybind11/stl.h>

namespace mlt::python {
namespace {

Vec3 to_vector(const Doubles& array, const char* what) {
  if (array.ndim() != 1 || array.size() != 3)
    throw UsageError(std::string(what) + " should be three numbers");
  const Vec3 v(array.data()[0], array.data()[1], array.data()[2]);
  if (!std::isfinite(length_squared(v))) throw UsageError(std::string(what) + " is not finite");
  return v;
}

Vec3 to_start(const Doubles& array) {
  const Vec3 v = to_vector(array, "start");
  check_start(v, "start");
  return v;
}

Vec3 to_direction(const Doubles& array, const char* what) {
  const Vec3 v = to_vector(array, what);
  if (!(length_squared(v) > 0)) throw UsageError(std::string(what) + " has no length");
  return normalize(v);
}

std::optional<PyVertex> first_hit(const LoadedScene& loaded, const Ray& ray) {
  SurfacePoint at;
  if (!loaded.scene->intersect(ray, at)) return std::nullopt;
  return PyVertex(inner_vertex(at), loaded);
}

std::optional<PyVertex> seen_from_vertex(const LoadedScene& loaded, const PyVertex& from,
                                         const Doubles& direction, std::optional<double> time) {
  if (from.at.infinite()) throw UsageError("no ray can start from a vertex at infinity");
  const Vec3 w = to_direction(direction, "direction");
  return first_hit(loaded, loaded.scene->spawn(from.at, w, time.value_or(from.at.time)));
}

py::object seen_from_point(const LoadedScene& loaded, const Doubles& from, const Doubles& direction,
                           double time) {
  if (from.ndim() == 2) return intersect_rays(loaded, from, direction, time);
  const Vec3 start = to_start(from) - loaded.scene->origin();
  const Ray ray{start, to_direction(direction, "direction"), time};
  return py::cast(first_hit(loaded, ray));
}

bool visible(const LoadedScene& loaded, const PyVertex& a, const PyVertex& b,
             std::optional<double> time) {
  if (a.at.infinite() && b.at.infinite())
    throw UsageError("both vertices are at infinity; nothing is between them");
  return loaded.scene->visible(a.at, b.at, time.value_or(a.at.time));
}

py::object scatter(const LoadedScene& loaded, const PyVertex& at, const Doubles& from,
                   const Doubles& u) {
  if (at.kind != VertexKind::inner)
    throw UsageError("only a vertex on a surface or in a medium scatters");
  const Frame& frame = at.at.shading;
  const auto sample = loaded.scene->bsdf(at.at).sample(
      at.at, frame.to_local(to_direction(from, "direction")), to_vector(u, "u"));
  if (!sample) return py::none();
  return py::make_tuple(PyVertex(inner_vertex(at.at, sample->lobe), loaded),
                        to_array(frame.to_world(sample->to)));
}

py::object camera_direction(const LoadedScene& loaded, const PyVertex& lens,
                            const Doubles& raster) {
  if (lens.kind != VertexKind::camera)
    throw UsageError("a path leaves the camera at its last vertex only");
  if (raster.size() != 2) throw UsageError("raster should be two numbers, in pixels");
  const Camera& camera = loaded.scene->camera();
  const Vec2 at(raster.data()[0], raster.data()[1]);
  if (!camera.raster().contains(at)) return py::none();
  return to_array(camera.direction(lens.at, at));
}

void bind_vertex_class(py::module_& m) {
  py::class_<PyVertex>(m, "Vertex",
                       "A vertex of a light path; it belongs to the scene of its path.")
      .def_property_readonly(
          "kind", [](const PyVertex& x) { return kind_of(x); },
          "'light', 'surface', 'medium' or 'camera'.")
      .def_property_readonly(
          "position", [](const PyVertex& x) { return to_array(x.position()); },
          "Where it is; at infinity, the direction towards it.")
      .def_property_readonly("normal", [](const PyVertex& x) { return to_array(x.at.ng); })
      .def_property_readonly("shading_normal",
                             [](const PyVertex& x) { return to_array(x.at.shading.n); })
      .def_property_readonly("uv",
                             [](const PyVertex& x) { return py::make_tuple(x.at.uv.x, x.at.uv.y); })
      .def_property_readonly(
          "lobe", [](const PyVertex& x) { return name_of(x.lobe); },
          "How it scatters: 'smooth', or by which delta, 'reflection' or 'transmission'.")
      .def_property_readonly(
          "delta", [](const PyVertex& x) { return x.delta(); },
          "Whether it scatters in one direction only.")
      .def_property_readonly("infinite", [](const PyVertex& x) { return x.at.infinite(); })
      .def_property_readonly(
          "shape", [](const PyVertex& x) { return shape_of(x); },
          "Which shape of the scene it is on; -1: none.")
      .def(
          "direction_to",
          [](const PyVertex& a, const PyVertex& b) { return to_array(direction(a.at, b.at)); },
          py::arg("other"), "The unit direction in which another vertex is seen.")
      .def("__repr__", [](const PyVertex& x) {
        const Vec3 p = x.position();
        return py::str("Vertex({}, ({:.4g}, {:.4g}, {:.4g}), {})")
            .format(kind_of(x), p.x, p.y, p.z, name_of(x.lobe));
      });
}

}  // namespace

void bind_vertex(py::module_& m) {
  bind_vertex_class(m);
  py::class_<LoadedScene, LoadedPtr> scene(m.attr("Scene"));
  const char* doc =
      "The surface that a ray meets first, as a (smooth) vertex; None if it meets none. It starts "
      "at a vertex (at the time of its path, if none is given) or at a point. For arrays (n, 3) of "
      "points and directions: a dict of arrays with n rows: distance, position, geo_normal, "
      "sh_normal, "
      "uv, shape_index and prim_index; NaN, an infinite distance and -1 for rays that meet "
      "nothing. "
      "Raises UsageError for other shapes, and for numbers that are no ray.";
  scene
      .def("intersect", &seen_from_vertex, py::arg("start"), py::arg("direction"),
           py::arg("time") = py::none(), doc)
      .def("intersect", &seen_from_point, py::arg("start"), py::arg("direction"),
           py::arg("time") = 0.0, doc)
      .def(
          "camera_rays", &camera_rays, py::arg("raster"), py::arg("time") = 0.0,
          "Rays from the middle of the lens through raster positions (n, 2), in pixels: two arrays "
          "(n, 3), starts and unit directions, as `intersect` takes them.")
      .def("visible", &visible, py::arg("a"), py::arg("b"), py::arg("time") = py::none(),
           "Whether nothing stands between two vertices; at the time of the first one, if not "
           "given.")
      .def(
          "scatter", &scatter, py::arg("vertex"), py::arg("direction"), py::arg("u"),
          "Samples the BSDF of a surface vertex for light or a camera in `direction`, with three "
          "random numbers u: (the vertex with the lobe that was chosen, the sampled direction), or "
          "None. Its density is in from_light and from_camera of the path that it leads to.")
      .def("camera_direction", &camera_direction, py::arg("vertex"), py::arg("raster"),
           "The direction that leaves the lens at the last vertex of a path for a raster position; "
           "None outside of the image.")
      .def_property_readonly(
          "raster_area",
          [](const LoadedScene& s) { return s.scene->camera().raster().sampled_area(); },
          "Of the image with the border that its filter needs, in square pixels: raster positions "
          "drawn by camera walks have the density 1 / raster_area.");
}

}  // namespace mlt::python
