// Light paths for inspection: their vertices as numpy, contribution, densities and weights.
#include "light_path.h"

#include "python_mutation.h"

#include "job/output.h"
#include "mutation/proposals.h"

#include <pybind11/stl.h>

#include <algorithm>

namespace mlt::python {
namespace {

// ---- vertices

py::tuple row(const PyVertex& x) {
  const SurfacePoint& at = x.at;
  const auto triple = [](const Vec3& v) { return py::make_tuple(v.x, v.y, v.z); };
  const int64_t emitter = x.kind == VertexKind::light ? int64_t{x.emitter} : -1;
  return py::make_tuple(kind_of(x), triple(x.position()), triple(at.ng), triple(at.shading.n),
                        py::make_tuple(at.uv.x, at.uv.y), name_of(x.lobe), at.infinite(),
                        shape_of(x), at.primitive, emitter);
}

py::object vertices(const PyLightPath& path) {
  py::dict type;
  type["names"] = py::make_tuple("kind", "position", "normal", "shading_normal", "uv", "lobe",
                                 "infinite", "shape", "primitive", "emitter");
  type["formats"] = py::make_tuple("U7", "3f8", "3f8", "3f8", "2f8", "U12", "?", "i8", "u4", "i8");
  py::list rows;
  for (const Vertex& x : path.path.vertices) rows.append(row({x, *path.scene}));
  return py::module_::import("numpy").attr("array")(rows, type);
}

PyVertex vertex_at(const PyLightPath& path, py::ssize_t i) {
  const auto count = static_cast<py::ssize_t>(path.path.vertices.size());
  if (i < -count || i >= count)
    throw py::index_error("a path of " + std::to_string(count) + " vertices");
  return {path.path[static_cast<size_t>(i < 0 ? i + count : i)], *path.scene};
}

std::vector<PyVertex> vertices_at(const PyLightPath& path, const py::slice& slice) {
  size_t start, stop, step, length;
  if (!slice.compute(path.path.vertices.size(), &start, &stop, &step, &length))
    throw py::error_already_set();
  std::vector<PyVertex> found;
  for (size_t i = 0; i < length; ++i) found.emplace_back(path.path[start + i * step], *path.scene);
  return found;
}

PyLightPath with_vertices(const PyLightPath& x, const std::vector<PyVertex>& vertices) {
  const size_t n = vertices.size();
  bool right =
      n >= 2 && vertices[0].kind == VertexKind::light && vertices[n - 1].kind == VertexKind::camera;
  for (size_t i = 1; right && i + 1 < n; ++i) right = vertices[i].kind == VertexKind::inner;
  if (!right)
    throw UsageError(
        "a path should be one vertex on a light, any number on surfaces or in media, and one on "
        "the lens");
  Path y{{vertices.begin(), vertices.end()}};
  y.set_time(x.path.time);
  y.set_wavelength(x.path.wavelength);
  const Vec2 raster = raster_position(*x.scene->scene, y).value_or(Vec2(std::nan("")));
  return {x.scene, std::move(y), raster, x.strict_normals, {}, {}, {}};
}

// ---- terms

PathTerms terms(const PyLightPath& path, bool sample_direct = true) {
  PathTerms terms;
  compute_terms(*path.scene->scene, path.path, {sample_direct, path.strict_normals}, terms);
  return terms;
}

template <class Value>
py::array_t<double> array_of(int count, Value&& value) {
  py::array_t<double> values(count);
  for (int i = 0; i < count; ++i) values.mutable_at(i) = value(i);
  return values;
}

/// Reads one of the terms, of the first k + `more` vertices.
auto column(double TermsAt::* member, int more) {
  return [=](const PyLightPath& path) {
    const PathTerms t = terms(path);
    return array_of(path.path.edges() + more, [&](int i) { return t[i].*member; });
  };
}

py::object wavelengths_in_nm(const PyLightPath& path) {
  const double u = path.path.wavelength;
  if (u < 0) return py::none();
  const Spectrum nm = at_wavelengths(u, [](double at) { return at; });
  return array_of(Spectrum::lanes, [&](int j) { return nm[j]; });
}

py::array_t<double> densities(const PyLightPath& path, bool sample_direct) {
  const PathTerms t = terms(path, sample_direct);
  return array_of(t.edges() + 2, [&](int s) { return technique_density(t, s); });
}

py::array_t<double> weights(const PyLightPath& path, const std::string& heuristic,
                            bool sample_direct) {
  const std::vector<std::string> names = {"balance", "power", "maximum"};
  const auto found = std::find(names.begin(), names.end(), heuristic);
  if (found == names.end())
    throw UsageError("unknown heuristic '" + heuristic + "'" + suggestion(heuristic, names));
  const auto kind = static_cast<Heuristic>(found - names.begin());
  const PathTerms t = terms(path, sample_direct);
  return array_of(t.edges() + 2, [&](int s) { return mis_weight(t, s, kind); });
}

std::string signature_of(const PyLightPath& path, double near_specular) {
  return signature(*path.scene->scene, path.path, near_specular);
}

py::str describe_path(const PyLightPath& path) {
  py::str text = py::str("LightPath({!r}, raster=({:.2f}, {:.2f})")
                     .format(signature_of(path, 0), path.raster.x, path.raster.y);
  if (path.technique)
    text += py::str(", s={}, t={}").format(path.technique->first, path.technique->second);
  if (path.acceptance) text += py::str(", acceptance={:.3g}").format(*path.acceptance);
  return text + py::str(")");
}

// ---- sources of paths

PyLightPath trace(const LoadedPtr& scene, const std::pair<int, int>& pixel, uint64_t seed,
                  int max_depth, bool strict_normals) {
  const Vec2i at(pixel.first, pixel.second);
  check_pixel(*scene->scene, at);
  const InspectSettings settings{seed, path_rules(max_depth, false, strict_normals)};
  return light_path(scene, trace_path_through(*scene->scene, at, settings), strict_normals);
}

PyLightPath sample(const LoadedPtr& scene, uint64_t seed, int max_depth, bool strict_normals) {
  const InspectSettings settings{seed, path_rules(max_depth, false, strict_normals)};
  return light_path(scene, sample_path(*scene->scene, settings), strict_normals);
}

std::vector<PyLightPath> proposals(const LoadedPtr& scene, const PyLightPath& x,
                                   const py::object& mutation, uint64_t seed, int count,
                                   int max_depth, double near_specular) {
  if (x.scene->scene != scene->scene) throw UsageError("the path is one of another scene");
  const PathTarget target(scene->scene, path_rules(max_depth, false, x.strict_normals),
                          near_specular);
  const MutationPtr made = to_mutation(scene, target, mutation);
  std::vector<PyLightPath> result;
  for (const Proposal& y : propose(target, x.path, made, seed, count)) {
    result.push_back(light_path(scene, y.path, x.strict_normals));
    result.back().acceptance = y.acceptance;
  }
  return result;
}

using PathClass = py::class_<PyLightPath>;

/// The vertices of a path, and what each of them has.
void bind_vertices(PathClass& path) {
  path.def_property_readonly(
          "signature", [](const PyLightPath& p) { return signature_of(p, 0); },
          "Heckbert's notation, light to camera: L, a D or S for each surface, E.")
      .def("signature_with", &signature_of, py::arg("near_specular"),
           "The same, where a surface below this roughness counts as S.")
      .def_property_readonly(
          "vertices", &vertices,
          "A structured array: kind, position, normal, shading_normal, uv, lobe, infinite, shape, "
          "primitive, emitter. At infinity, position is the direction towards the vertex.")
      .def("__getitem__", &vertex_at, "Vertex i, counted from the light.")
      .def("__getitem__", &vertices_at)
      .def("__iter__",
           [](const PyLightPath& p) {
             py::list all;
             for (const Vertex& x : p.path.vertices) all.append(PyVertex(x, *p.scene));
             return py::iter(all);
           })
      .def("with_vertices", &with_vertices, py::arg("vertices"),
           "Another path of the same scene, time and wavelengths, through these vertices.")
      .def_property_readonly("scene", [](const PyLightPath& p) { return p.scene; })
      .def_property_readonly(
          "G", column(&TermsAt::G, 0),
          "G(x_i, x_{i+1}) for i = 0 ... k - 1 (Veach 1997, eq. 8.2), without visibility.")
      .def_property_readonly(
          "from_light", column(&TermsAt::from_light, 1),
          "Density of each x_i when a walk from the light makes it, per unit of area.")
      .def_property_readonly(
          "from_camera", column(&TermsAt::from_camera, 1),
          "Density of each x_i when a walk from the camera makes it, per unit of area.")
      .def("__len__", [](const PyLightPath& p) { return p.path.vertices.size(); })
      .def("__repr__", &describe_path);
}

/// What a path has as a whole, and the densities of the techniques that find it.
void bind_whole(PathClass& path) {
  path.def_property_readonly(
          "edges", [](const PyLightPath& p) { return p.path.edges(); }, "k")
      .def_property_readonly("time", [](const PyLightPath& p) { return p.path.time; })
      .def_property_readonly(
          "wavelengths", &wavelengths_in_nm,
          "Its four wavelengths in nm, each about a quarter of what the eye sees apart; None in "
          "scenes that are not spectral. If it is dispersed, the first one alone counts.")
      .def_property_readonly(
          "dispersed", [](const PyLightPath& p) { return terms(p).dispersed(); },
          "Whether it is refracted by an index that depends on the wavelength.")
      .def_property_readonly(
          "raster", [](const PyLightPath& p) { return py::make_tuple(p.raster.x, p.raster.y); },
          "Where it meets the image, in pixels from the upper left corner.")
      .def_readonly("technique", &PyLightPath::technique, "(s, t) that found it, or None.")
      .def_property_readonly(
          "estimate",
          [](const PyLightPath& p) {
            return p.estimate ? py::object(to_array(*p.estimate)) : py::none();
          },
          "What it brought to the image: RGB of its contribution over its density, weighted; or "
          "None.")
      .def_readonly("acceptance", &PyLightPath::acceptance,
                    "Of a proposal: the probability of accepting it; else None.")
      .def(
          "contribution",
          [](const PyLightPath& p) {
            return to_array(shown(*p.scene->scene, contribution(terms(p))));
          },
          "f(x), RGB (Veach 1997, eq. 8.7), without visibility.")
      .def("densities", &densities, py::arg("sample_direct") = true,
           "p_{s,t}(x) in the product-area measure, for s = 0 ... k + 1.")
      .def("weights", &weights, py::arg("heuristic") = "power", py::arg("sample_direct") = true,
           "The weights of multiple importance sampling, for s = 0 ... k + 1.");
}

void bind_path_class(py::module_& m) {
  PathClass path(
      m, "LightPath",
      "A light path: x_0 on a light ... x_k on the camera's lens, whichever way it was made.");
  bind_vertices(path);
  bind_whole(path);
}

}  // namespace

const char* kind_of(const Vertex& x) {
  constexpr const char* names[] = {"light", "surface", "camera"};
  return x.at.in_medium() ? "medium" : names[static_cast<size_t>(x.kind)];
}

const char* name_of(Lobe lobe) {
  constexpr const char* names[] = {"smooth", "reflection", "transmission"};
  return names[static_cast<size_t>(lobe)];
}

int64_t shape_of(const Vertex& x) {
  return x.at.shape == SurfacePoint::no_shape ? -1 : int64_t{x.at.shape};
}

PyLightPath light_path(LoadedPtr scene, FoundPath found, bool strict_normals) {
  const std::pair technique(found.s, found.t);
  const Color estimate = shown(*scene->scene, found.estimate);
  return {std::move(scene),
          std::move(found.path),
          found.raster,
          strict_normals,
          technique,
          estimate,
          {}};
}

PyLightPath light_path(LoadedPtr scene, const PathState& x, bool strict_normals) {
  return {std::move(scene), x.path, x.raster, strict_normals, {}, {}, {}};
}

py::array_t<double> to_array(const Color& color) {
  return array_of(3, [&](int i) { return color[i]; });
}

void bind_light_path(py::module_& m) {
  bind_vertex(m);
  bind_path_class(m);
  py::class_<LoadedScene, LoadedPtr> scene(m.attr("Scene"));
  scene.def("trace_path", &trace, py::kw_only(), py::arg("pixel"), py::arg("seed") = 0,
            py::arg("max_depth") = 10, py::arg("strict_normals") = false,
            "A light path through the pixel (x, y), found by path tracing (s = 0 or s = 1). "
            "Samples are taken until one finds light.");
  scene.def(
      "sample_path", &sample, py::kw_only(), py::arg("seed") = 0, py::arg("max_depth") = 10,
      py::arg("strict_normals") = false,
      "A light path anywhere on the image, found by any technique of bidirectional path tracing.");
  scene.def("propose", &proposals, py::arg("path"), py::arg("mutation"), py::kw_only(),
            py::arg("seed") = 0, py::arg("count") = 100, py::arg("max_depth") = 10,
            py::arg("near_specular") = 0.1,
            "What a mutation, alone, would make of a path in `count` tries: those that found a "
            "path, each with its `acceptance`.");
}

}  // namespace mlt::python
