#include "mutation/audit.h"

#include <fmt/format.h>

namespace mlt {
namespace {

constexpr double least_effective_samples = 1000;
/// At grazing angles a walk's directions and those of its vertices differ by rounding.
constexpr double most_lost = 1e-4;

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::right: return "right";
    case Verdict::wrong: return "wrong";
    case Verdict::inconclusive: break;
  }
  return "inconclusive";
}

void AuditReport::judge(const AuditSettings& how) {
  const auto say = [&](Verdict v, std::string why) {
    verdict = v;
    reason = std::move(why);
  };
  if (lost > most_lost)
    return say(Verdict::wrong,
               fmt::format("{:.2g} of the light is in paths without a target", lost));
  if (invalid > 0)
    return say(Verdict::wrong,
               fmt::format("{} steps had an acceptance that is not a number", invalid));
  if (suited == 0) return say(Verdict::inconclusive, "no path suits");
  if (effective_samples < least_effective_samples)
    return say(
        Verdict::inconclusive,
        fmt::format("the samples are worth only {:.0f} of equal weight; at least {:.0f} are needed",
                    effective_samples, least_effective_samples));
  if (!tests.empty() && tests[0].adjusted_p <= how.significance) {
    const AuditTest& t = tests[0];
    return say(Verdict::wrong,
               fmt::format("the mean of '{}' changes by {:.3g} +- {:.2g} (z = {:.1f})", t.function,
                           t.change, t.error, t.z));
  }
  if (accepted < how.least_accepted)
    return say(Verdict::inconclusive,
               fmt::format("only {} moves were accepted; at least {} are needed", accepted,
                           how.least_accepted));
  if (tests.empty()) return say(Verdict::inconclusive, "nothing that is measured changes");
  const size_t n = tests.size();
  say(Verdict::right, fmt::format("none of {} means changes (least p = {:.2g} after correction)", n,
                                  tests[0].adjusted_p));
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
