// What an audit sums up over the steps of a kernel: h(x, y) for many functions h, in batches of
// samples.
#pragma once

#include "math/number.h"
#include "mutation/audit.h"
#include "mutation/path_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace mlt {

constexpr int audit_batches = 128;
constexpr int longest = 9;  ///< Edges of the longest paths that have tests of their own.
constexpr int first_tail = 3, last_tail = 7;  ///< Tests of paths of that many edges or more.

using RowKey = std::pair<size_t, std::string>;  // mutation, signature

/// Sums over the samples of one batch.
struct AuditSums {
  double light = 0;                        ///< Weight of all paths.
  double weight = 0, weight_squared = 0;   ///< Sums for paths that a mutation suits.
  std::vector<double> expected;            ///< Sums of w h(x, y), for each h.
  std::vector<double> chosen;              ///< As above with the chosen state, for each g.
  std::vector<double> size, size_squared;  ///< Sums of |w h(x, y)| as expected.
  std::vector<double> largest;             ///< Greatest |w h(x, y)| if all were accepted.
  std::vector<double> seen;                ///< Steps from an x with g(x) != 0, for each g.
  /// Accepted weight of steps that move the image position: of all, and by the number of edges.
  std::vector<double> moved;
  std::map<RowKey, AuditRow> rows;
  double lost = 0;  ///< Weight of paths without a target.
  uint64_t steps = 0;

  void add(const AuditSums& other) {
    light += other.light;
    weight += other.weight;
    weight_squared += other.weight_squared;
    lost += other.lost;
    steps += other.steps;
    for (auto values : {&AuditSums::expected, &AuditSums::chosen, &AuditSums::size,
                        &AuditSums::size_squared, &AuditSums::seen, &AuditSums::moved})
      for (size_t i = 0; i < (this->*values).size(); ++i) (this->*values)[i] += (other.*values)[i];
    for (size_t i = 0; i < largest.size(); ++i) largest[i] = std::max(largest[i], other.largest[i]);
    for (const auto& [key, row] : other.rows) add(rows[key], row);
  }
  static void add(AuditRow& sum, const AuditRow& row) {
    sum.steps += row.steps;
    sum.generated += row.generated;
    sum.accepted += row.accepted;
    sum.invalid += row.invalid;
    sum.acceptance += row.acceptance;
  }
};

/// Where each h stands in the sums of a batch: g(y) - g(x) of every function g, and of the
/// signatures; then blocks of one h for each g that is a number.
class AuditLayout {
 public:
  AuditLayout(const Scene& scene, std::vector<std::string> signatures)
      : functions_(scene), signatures_(std::move(signatures)) {}

  const PathFunctions& functions() const { return functions_; }
  size_t plain() const { return functions_.size() + signatures_.size(); }
  size_t numbers() const { return functions_.numbers().size(); }
  /// Number of sums over samples, and with those over lengths that are made of them at the end.
  size_t summed() const { return of_tail(first_tail, false); }
  size_t size() const { return of_tail(last_tail + 1, false); }
  size_t block(size_t i) const { return plain() + i * numbers(); }

  /// Times the step in the image, and times that in space.
  size_t in_image() const { return block(0); }
  size_t in_space() const { return block(1); }
  /// Where x and y have this number of edges; times the step in the image, too.
  size_t of_length(int k) const { return block(1 + k); }
  size_t in_image_of_length(int k) const { return block(1 + longest + k); }
  size_t of_signature(size_t i) const { return block(2 + 2 * longest + i); }

  /// Where x and y have one number of edges, k or more.
  size_t of_tail(int k, bool in_image) const {
    return of_signature(signatures_.size() + 2 * (k - first_tail) + in_image);
  }

  /// The index of a signature that has tests of its own, or their number.
  size_t index(const std::string& signature) const {
    return std::find(signatures_.begin(), signatures_.end(), signature) - signatures_.begin();
  }
  size_t signatures() const { return signatures_.size(); }

  std::string name(size_t h) const {
    if (h < functions_.size()) return functions_.names()[h];
    if (h < plain()) return "paths " + signatures_[h - functions_.size()];
    const size_t i = (h - plain()) / numbers();
    const std::string& g = functions_.names()[functions_.numbers()[(h - plain()) % numbers()]];
    if (i == 0) return g + ", by steps in the image";
    if (i == 1) return g + ", by steps in space";
    if (i < 2 + longest) return fmt::format("{} at {} edges", g, i - 1);
    if (i < 2 + 2 * longest)
      return fmt::format("{} at {} edges, by steps in the image", g, i - 1 - longest);
    const size_t rest = i - 2 - 2 * longest;
    if (rest < signatures_.size()) return g + " along " + signatures_[rest];
    const size_t tail = rest - signatures_.size();
    return fmt::format("{} at {} edges or more{}", g, first_tail + tail / 2,
                       tail % 2 == 0 ? "" : ", by steps in the image");
  }

 private:
  PathFunctions functions_;
  std::vector<std::string> signatures_;
};

}  // namespace mlt
