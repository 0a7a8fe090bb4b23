#include "mutation/audit.h"

#include <fmt/format.h>

namespace mlt {

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::right: return "right";
    case Verdict::wrong: return "wrong";
    case Verdict::inconclusive: break;
  }
  return "inconclusive";
}

std::string AuditReport::text(size_t most) const {
  std::string out = fmt::format(
      "{}: {}\n{} samples worth {:.0f} suit in {:.3g} % of the light ({:.5g}), {} steps, {} "
      "accepted\n",
      name_of(verdict), reason, samples, effective_samples, 100 * suited, b, steps, accepted);
  for (size_t i = 0; i < std::min(most, tests.size()); ++i) {
    const AuditTest& t = tests[i];
    out += fmt::format(
        "  {:<26}{:<10}{:>11.3g} +- {:<9.2g} z = {:>6.2f}  p = {:<8.2g} corrected {:.2g}\n",
        t.function, t.expected ? "expected" : "chosen", t.change, t.error, t.z, t.p, t.adjusted_p);
  }
  for (size_t i = 0; i < std::min(most, rows.size()); ++i) {
    const AuditRow& row = rows[i];
    out += fmt::format("  {:<14}{:<16}{:>9} steps {:>9} generated {:>9} accepted  mean {:.3f}\n",
                       row.mutation, row.signature, row.steps, row.generated, row.accepted,
                       row.acceptance / static_cast<double>(row.steps));
  }
  return out;
}

}  // namespace mlt
