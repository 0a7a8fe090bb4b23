#include "mutation/audit_tests.h"

#include "mutation/path_mixture.h"

namespace mlt {
namespace {

/// A function that hardly ever changes is not tested, since a t-test needs more than a few events:
/// many small changes one way may wait for a few large ones the other way. Nor is one that is 0 for
/// almost all starting paths, since the few that would leave that set are missing.
constexpr double least_effective_changes = 100;

/// P(|T| > |t|) of Student's t, by the normal approximation of Wallace 1959 ("Bounds on normal
/// approximations to Student's and the chi-square distributions"): accurate to 1 % for
/// n > 60.
double two_sided(double t, double n) {
  const double z = std::sqrt(n * std::log1p(sqr(t) / n)) * (8 * n + 1) / (8 * n + 3);
  return std::erfc(z * std::sqrt(0.5));
}

AuditTest t_test(const std::vector<AuditSums>& done, std::vector<double> AuditSums::* sums,
                 size_t g, double weight) {
  double mean = 0, variance = 0;
  for (const AuditSums& batch : done) mean += (batch.*sums)[g] / audit_batches;
  for (const AuditSums& batch : done)
    variance += sqr((batch.*sums)[g] - mean) / (audit_batches - 1);
  AuditTest test;
  const double error = std::sqrt(variance / audit_batches);
  test.change = mean * audit_batches / weight;
  test.error = error * audit_batches / weight;
  test.z = error > 0 ? mean / error : 0;
  test.p = two_sided(test.z, audit_batches - 1);
  return test;
}

class Tests {
 public:
  Tests(std::vector<AuditSums> done, const AuditLayout& layout, const Vec2i& image)
      : done_(std::move(done)), layout_(layout), image_(image) {
    for (AuditSums& batch : done_) add_tails(batch);
  }

  AuditReport report(const PathMixture& mixture, uint64_t samples, double level) const {
    AuditReport report;
    report.level = level;
    std::map<RowKey, AuditRow> rows;
    double light = 0, weight = 0, weight_squared = 0;
    for (const AuditSums& batch : done_) {
      light += batch.light;
      weight += batch.weight;
      weight_squared += batch.weight_squared;
      report.steps += batch.steps;
      report.lost += batch.lost;
      for (const auto& [key, row] : batch.rows) AuditSums::add(rows[key], row);
    }
    for (auto& [key, row] : rows) {
      row.mutation = mixture.moves()[key.first]->name();
      row.signature = key.second;
      report.accepted += row.accepted;
      report.invalid += row.invalid;
      report.rows.push_back(row);
    }
    std::stable_sort(report.rows.begin(), report.rows.end(),
                     [](const AuditRow& a, const AuditRow& b) { return a.steps > b.steps; });
    report.samples = samples * audit_batches;
    report.b = light / static_cast<double>(report.samples);
    report.suited = weight / light;
    report.lost /= light;
    report.effective_samples = weight > 0 ? sqr(weight) / weight_squared : 0;
    if (weight > 0) add_tests(weight, report);
    return report;
  }

 private:
  /// Adds the sums over all lengths from one on.
  void add_tails(AuditSums& batch) const {
    for (auto values :
         {&AuditSums::expected, &AuditSums::size, &AuditSums::size_squared, &AuditSums::largest}) {
      std::vector<double>& sums = batch.*values;
      sums.resize(layout_.size(), 0);
      for (int tail = first_tail; tail <= last_tail; ++tail)
        for (int k = tail; k <= longest; ++k)
          for (size_t i = 0; i < layout_.numbers(); ++i) {
            const auto add = [&](size_t to, size_t from) {
              double& sum = sums[to + i];
              sum = values == &AuditSums::largest ? std::max(sum, sums[from + i])
                                                  : sum + sums[from + i];
            };
            add(layout_.of_tail(tail, false), layout_.of_length(k));
            add(layout_.of_tail(tail, true), layout_.in_image_of_length(k));
          }
    }
  }

  void add_tests(double weight, AuditReport& report) const {
    for (size_t h = 0; h < layout_.size(); ++h) {
      if (!changes_enough(h)) continue;
      for (const bool expected : {true, false}) {
        if (!expected && h >= layout_.plain()) continue;
        AuditTest test =
            t_test(done_, expected ? &AuditSums::expected : &AuditSums::chosen, h, weight);
        test.function = layout_.name(h);
        test.expected = expected;
        report.tests.push_back(test);
      }
    }
    if (report.tests.empty()) return;
    std::sort(report.tests.begin(), report.tests.end(),
              [](const AuditTest& a, const AuditTest& b) { return a.p < b.p; });
    const auto count = static_cast<double>(report.tests.size());
    double largest = 0;
    for (size_t i = 0; i < report.tests.size(); ++i) {
      const double corrected = report.tests[i].p * (count - static_cast<double>(i));
      largest = std::max(largest, std::min(1.0, corrected));
      report.tests[i].adjusted_p = largest;
    }
    constexpr double nine_in_ten = 1.2816;  // of a normal variable lie above minus this
    double low = 0, high = 100;
    while (high - low > 1e-6)
      (two_sided((low + high) / 2, audit_batches - 1) > report.level / count ? low : high) =
          (low + high) / 2;
    report.least_z = high + nine_in_ten;
    add_limits(report);
  }

  bool changes_enough(size_t h) const {
    double size = 0, size_squared = 0, largest = 0, seen = 0;
    for (const AuditSums& batch : done_) {
      largest = std::max(largest, batch.largest[h]);
      size += batch.size[h];
      size_squared += batch.size_squared[h];
      if (h < layout_.plain()) seen += batch.seen[h];
    }
    return size > 0 && sqr(size) >= least_effective_changes * size_squared &&
           size >= least_effective_changes * largest &&
           (h >= layout_.plain() || seen >= least_effective_changes);
  }

  /// A shift by d pixels in each accepted step changes the mean of the image position by d times
  /// the weight of these steps.
  void add_limits(AuditReport& report) const {
    const auto add = [&](size_t block, AuditLimit limit, int first, int last) {
      double moved = 0;
      for (const AuditSums& batch : done_)
        for (int k = first; k <= last; ++k) moved += batch.moved[k];
      const auto error = [&](const std::string& name, double pixels) {
        const std::vector<size_t>& numbers = layout_.functions().numbers();
        size_t i = 0;
        while (layout_.functions().names()[numbers[i]] != name) ++i;
        const size_t h = block == 0 ? numbers[i] : block + i;
        return moved > 0 && changes_enough(h)
                   ? t_test(done_, &AuditSums::expected, h, moved).error * pixels
                   : infinity;
      };
      limit.pixels =
          report.least_z * std::max(error("image x", image_.x), error("image y", image_.y));
      if (limit.pixels < infinity) report.limits.push_back(limit);
      return limit.pixels < infinity;
    };
    if (!add(0, {}, 0, 0)) return;
    int tested = 0;
    for (int k = 1; k <= longest; ++k)
      if (add(layout_.of_length(k), {k, false}, k, k)) tested = k;
    for (int tail = std::max(tested + 1, first_tail); tail <= last_tail; ++tail)
      if (add(layout_.of_tail(tail, false), {tail, true}, tail, longest)) return;
    double moved = 0, longer = 0;
    for (const AuditSums& batch : done_)
      for (int k = 1; k <= longest; ++k) (k > tested ? longer : moved) += batch.moved[k];
    if (longer > 0) report.untested = {tested + 1, longer / (moved + longer)};
  }

  std::vector<AuditSums> done_;
  const AuditLayout& layout_;
  Vec2 image_;
};

}  // namespace

AuditReport audit_report(std::vector<AuditSums> done, const AuditLayout& layout,
                         const PathMixture& mixture, const Vec2i& image, uint64_t samples,
                         double level) {
  return Tests(std::move(done), layout, image).report(mixture, samples, level);
}

}  // namespace mlt
