// The list of mutations, and the audit of one or of a mixture.
#include "python_mutation.h"
#include "scene_dict.h"

#include "base/parallel.h"
#include "mutation/audit.h"

#include <pybind11/stl.h>

namespace mlt::python {
namespace {

py::list all_mutations() {
  py::list list;
  for (const MutationPlugin& plugin : mutation_plugins()) {
    py::dict dict = to_dict(plugin.schema);
    dict["switch"] = plugin.switch_name;
    dict["weight_name"] = plugin.weight_name();
    dict["weight"] = plugin.weight;
    list.append(dict);
  }
  return list;
}

AuditReport run_audit(const LoadedPtr& loaded, const WeightedObjects& mixture, int max_depth,
                      bool hide_emitters, bool strict_normals, double near_specular, uint64_t paths,
                      uint64_t most_paths, uint64_t seed, int threads, double significance) {
  const PathTarget target(loaded->scene, path_rules(max_depth, hide_emitters, strict_normals),
                          near_specular);
  AuditSettings how;
  how.paths = paths;
  how.most_paths = most_paths;
  how.seed = seed;
  how.threads = threads > 0 ? threads : hardware_threads();
  how.significance = significance;
  const auto mixed = to_mixture(loaded, target, mixture);
  repeat_proposals(mixed.first);
  AuditReport report = run_interruptibly([&](const std::atomic<bool>& cancelled) {
    return audit(target, mixed.first, mixed.second, how, cancelled);
  });
  if (std::string fault = fault_of_repeated(mixed.first); !fault.empty()) {
    report.verdict = Verdict::wrong;
    report.reason = std::move(fault);
  }
  return report;
}

py::list tests(const AuditReport& report) {
  py::list list;
  for (const AuditTest& t : report.tests)
    list.append(py::make_tuple(t.function, t.expected, t.change, t.error, t.z, t.p, t.adjusted_p));
  return list;
}

py::list limits(const AuditReport& report) {
  py::list list;
  for (const AuditLimit& limit : report.limits)
    list.append(py::make_tuple(limit.edges, limit.or_more, limit.pixels));
  return list;
}

}  // namespace

void bind_mutations(py::module_& m) {
  m.def("mutations", &all_mutations);
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
      .def_property_readonly("limits", &limits, "(edges, or_more, pixels) of each.")
      .def("text", &AuditReport::text, py::arg("most"));
  m.def("audit", &run_audit, py::arg("scene"), py::arg("mixture"), py::arg("max_depth"),
        py::arg("hide_emitters"), py::arg("strict_normals"), py::arg("near_specular"),
        py::arg("paths"), py::arg("most_paths"), py::arg("seed"), py::arg("threads"),
        py::arg("significance"));
}

}  // namespace mlt::python
