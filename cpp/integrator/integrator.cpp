#include "integrator/integrator.h"

#include "base/error.h"

namespace mlt {

Replay Rendering::replay(const Vec2i& /*pixel*/, uint64_t /*sample*/) {
  throw UsageError(
      "this integrator takes no samples of single pixels to be replayed; path, direct, "
      "ptracer and bdpt do");
}

IntegratorPtr Integrator::with_mutations(const std::vector<ExtraMutation>& /*extra*/) const {
  throw UsageError("'" + name() + "' has no mixture of mutations; mlt has");
}

}  // namespace mlt
