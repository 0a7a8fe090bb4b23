// The tests of an audit: of each h, whether its mean over the batches is 0.
#pragma once

#include "mutation/audit_sums.h"

namespace mlt {

/// The report of the sums of all batches, each of so many `samples`, without a verdict. `level` is
/// the significance of all tests together.
AuditReport audit_report(std::vector<AuditSums> done, const AuditLayout& layout,
                         const PathMixture& mixture, const Vec2i& image, uint64_t samples,
                         double level);

}  // namespace mlt
