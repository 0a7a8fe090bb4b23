// What mlt can do beside its plug-in.
#pragma once

#include "integrator/integrator.h"
#include "mutation/mutation.h"

#include <functional>

namespace mlt {

/// A mutation that is not among the kinds, such as one that is written in Python.
struct ExtraMutation {
  std::string name;
  double weight;
  std::function<std::shared_ptr<const Mutation>(const Scene&, const MutationSettings&)> make;
};

/// The same integrator with more mutations in its mixture. Throws UsageError if it is not an mlt.
IntegratorPtr with_mutations(const Integrator& integrator, const std::vector<ExtraMutation>& extra);

}  // namespace mlt
