#include "mutation/audit.h"

#include <fmt/format.h>

#include <algorithm>

namespace mlt {
namespace {

constexpr double least_effective_samples = 1000;
/// At grazing angles a walk's directions and those of its vertices differ by rounding.
constexpr double most_lost = 1e-4;
/// Corrected p-values below this are no proof, and no reason to stop either.
constexpr double suspicious = 0.05;

std::string shift(const AuditLimit& limit) {
  return limit.edges == 0 ? fmt::format("{:.2g} pixel", limit.pixels)
                          : fmt::format("{:.2g} at {} edges{}", limit.pixels, limit.edges,
                                        limit.or_more ? " or more" : "");
}

/// What would have been found, in one clause.
std::string power(const AuditReport& report) {
  const std::vector<AuditLimit>& limits = report.limits;
  if (limits.empty()) {
    const AuditTest& t = *std::min_element(
        report.tests.begin(), report.tests.end(),
        [](const AuditTest& a, const AuditTest& b) { return a.function < b.function; });
    return fmt::format("a change of the mean of '{}' by more than {:.2g} would have been",
                       t.function, report.least_z * t.error);
  }
  std::string out = fmt::format("a shift of the image position by more than {} would have been",
                                shift(limits[0]));
  const auto worst = std::max_element(
      limits.begin(), limits.end(),
      [](const AuditLimit& a, const AuditLimit& b) { return a.pixels < b.pixels; });
  if (worst != limits.begin()) out += ", or by " + shift(*worst);
  if (report.untested.first > 1)
    out += fmt::format("; of {} edges or more ({:.2g} % of the steps) there were too few",
                       report.untested.first, 100 * report.untested.second);
  return out;
}

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::nothing_found: return "nothing found";
    case Verdict::wrong: return "wrong";
    case Verdict::inconclusive: break;
  }
  return "inconclusive";
}

bool AuditReport::undecided() const {
  return !tests.empty() && tests[0].adjusted_p > level && tests[0].adjusted_p < suspicious;
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
  if (!tests.empty() && tests[0].adjusted_p <= level) {
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
  const std::string least = fmt::format("least p = {:.2g} of {} tests after correction",
                                        tests[0].adjusted_p, tests.size());
  if (undecided() && tests[0].adjusted_p < 20 * level)
    return say(Verdict::inconclusive,
               fmt::format("the mean of '{}' may change ({}); give most_paths more than {}",
                           tests[0].function, least, samples));
  say(Verdict::nothing_found, power(*this) + " (" + least + ")");
}

std::string AuditReport::text(size_t most) const {
  std::string out = fmt::format(
      "{}{} {}\n{} samples worth {:.0f} suit in {:.3g} % of the light ({:.5g}), {} steps, {} "
      "accepted\n",
      name_of(verdict), verdict == Verdict::nothing_found ? ';' : ':', reason, samples,
      effective_samples, 100 * suited, b, steps, accepted);
  const size_t most_tests = std::min(most, tests.size());
  size_t width = 26;
  for (size_t i = 0; i < most_tests; ++i) width = std::max(width, tests[i].function.size() + 1);
  for (size_t i = 0; i < most_tests; ++i) {
    const AuditTest& t = tests[i];
    out += fmt::format(
        "  {:<{}}{:<10}{:>11.3g} +- {:<9.2g} z = {:>6.2f}  p = {:<8.2g} corrected {:.2g}\n",
        t.function, width, t.expected ? "expected" : "chosen", t.change, t.error, t.z, t.p,
        t.adjusted_p);
  }
  if (!limits.empty()) {
    out += "  shifts of the image position that nine audits of ten find: more than";
    for (const AuditLimit& limit : limits) out += (limit.edges == 0 ? " " : ", ") + shift(limit);
    out += "\n";
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
