// What mutations there are, and the audit of one or of a mixture.
#include "python_mutation.h"

#include "base/parallel.h"
#include "mutation/audit.h"
#include "mutation/mutation_registry.h"

#include <pybind11/stl.h>

namespace mlt::python {
namespace {

py::list kinds() {
  py::list list;
  for (const MutationKind& kind : mutation_kinds()) {
    py::dict dict;
    dict["name"] = kind.name;
    dict["switch"] = kind.switch_name;
    dict["weight_name"] = kind.weight_name;
    dict["weight"] = kind.weight;
    dict["doc"] = kind.doc;
    list.append(dict);
  }
  return list;
}

AuditReport run_audit(const std::shared_ptr<LoadedScene>& loaded, const WeightedObjects& mixture,
                      int max_depth, bool hide_emitters, bool strict_normals, double near_specular,
                      uint64_t paths, uint64_t seed, int threads, double significance) {
  MutationSettings settings;
  settings.max_depth = max_depth;
  settings.hide_emitters = hide_emitters;
  settings.strict_normals = strict_normals;
  settings.near_specular = near_specular;
  AuditSettings how;
  how.paths = paths;
  how.seed = seed;
  how.threads = threads > 0 ? threads : hardware_threads();
  how.significance = significance;
  Mutations mutations;
  std::vector<double> weights;
  for (const auto& [mutation, weight] : mixture) {
    mutations.push_back(to_mutation(loaded, settings, mutation));
    weights.push_back(weight);
  }
  const py::gil_scoped_release release;
  return audit(*loaded->scene, settings, mutations, MutationChoice(weights), how);
}

py::list tests(const AuditReport& report) {
  py::list list;
  for (const AuditTest& t : report.tests)
    list.append(py::make_tuple(t.function, t.expected, t.change, t.error, t.z, t.p, t.adjusted_p));
  return list;
}

}  // namespace

void bind_mutations(py::module_& m) {
  m.def("mutation_kinds", &kinds);
  py::class_<AuditReport>(m, "AuditReport")
      .def_property_readonly("verdict", [](const AuditReport& r) { return name_of(r.verdict); })
      .def_readonly("reason", &AuditReport::reason)
      .def_readonly("b", &AuditReport::b)
      .def_readonly("samples", &AuditReport::samples)
      .def_readonly("effective_samples", &AuditReport::effective_samples)
      .def_readonly("steps", &AuditReport::steps)
      .def_readonly("accepted", &AuditReport::accepted)
      .def_readonly("invalid", &AuditReport::invalid)
      .def_property_readonly("tests", &tests,
                             "(function, expected, change, error, z, p, adjusted_p) of each.")
      .def("text", &AuditReport::text, py::arg("most"));
  m.def("audit", &run_audit, py::arg("scene"), py::arg("mixture"), py::arg("max_depth"),
        py::arg("hide_emitters"), py::arg("strict_normals"), py::arg("near_specular"),
        py::arg("paths"), py::arg("seed"), py::arg("threads"), py::arg("significance"));
}

}  // namespace mlt::python
