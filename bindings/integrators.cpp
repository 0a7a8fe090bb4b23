// Integrators: by name, from a dict, and with mutations that are written in Python.
#include "bindings.h"
#include "py_job.h"
#include "python_mutation.h"
#include "scene_dict.h"

#include "io/pack.h"
#include "job/plugins.h"

#include <pybind11/stl.h>

namespace mlt::python {
namespace {

MadeIntegrator by_name(const LoadedScene& loaded, const std::string& name,
                       const Assignments& assignments) {
  return make_integrator(choose_integrator(loaded, name, assignments, plugins()), plugins());
}

MadeIntegrator integrator_from_dict(const py::dict& dict) {
  return make_integrator(to_node(dict, "integrator", "integrator", plugins()), plugins());
}

/// mlt with mutations that are written in Python, for this scene alone.
MadeIntegrator with_python_mutations(const MadeIntegrator& made, const LoadedPtr& loaded,
                                     const WeightedObjects& mutations) {
  std::vector<ExtraMutation> extra;
  for (const auto& [object, weight] : mutations) {
    const auto held = hold(object);
    const auto make = [loaded, held](const PathTarget& target) {
      if (target.scene_ptr() != loaded->scene)
        throw UsageError("an integrator with mutations written in Python is for one scene only");
      const AcquiredGil gil;
      return to_mutation(loaded, target, *held);
    };
    extra.push_back({object.attr("name").cast<std::string>(), weight, make});
  }
  return with_mutations(made, extra);
}

}  // namespace

void bind_integrators(py::module_& m) {
  py::class_<MadeIntegrator>(m, "Integrator", "A light transport algorithm with its settings.")
      .def_property_readonly(
          "settings", [](const MadeIntegrator& made) { return made.settings.text(); }, "As JSON.")
      .def_readonly("warnings", &MadeIntegrator::warnings)
      .def(py::pickle(
          [](const MadeIntegrator& made) { return py::bytes(pack(node_of(made))); },
          [](const py::bytes& packed) { return make_integrator(unpack_node(packed), plugins()); }));
  m.def("integrator_by_name", &by_name, py::arg("scene"), py::arg("name"), py::arg("assignments"));
  m.def("integrator_from_dict", &integrator_from_dict, py::arg("dict"));
  m.def(
      "with_light_layers",
      [](const MadeIntegrator& made, bool groups, const Assignments& classes, bool exposures) {
        return with_light_layers(made, {groups, classes, exposures}, plugins());
      },
      py::arg("integrator"), py::arg("groups"), py::arg("classes"), py::arg("exposures") = false,
      "It again, keeping layers of light.");
  m.def("with_mutations", &with_python_mutations, py::arg("integrator"), py::arg("scene"),
        py::arg("mutations"));
}

}  // namespace mlt::python
