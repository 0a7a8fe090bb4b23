#include "mutation/audit.h"

#include "base/error.h"
#include "base/parallel.h"
#include "mutation/path_functions.h"
#include "mutation/path_seeds.h"

#include <fmt/format.h>

#include <map>
#include <numeric>

namespace mlt {
namespace {

constexpr int batches = 128;
/// A function that hardly ever changes is not tested, since a t-test needs more than a few events:
/// many small changes one way may wait for a few large ones the other way. Nor is one that is 0 for
/// almost all starting paths, since the few that would leave that set are missing.
constexpr double least_effective_changes = 100;
constexpr double most_splits = 4096;
constexpr int longest = 9;  ///< Edges of the longest paths that have tests of their own.
constexpr int first_tail = 3, last_tail = 7;  ///< Tests of paths of that many edges or more.
constexpr size_t most_signatures = 8;         ///< Signatures that have tests of their own ...
constexpr double least_share = 0.01;          ///< ... if they have this share of the light.

using RowKey = std::pair<size_t, std::string>;  // mutation, signature

/// Sums over the samples of one batch.
struct Batch {
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

  void add(const Batch& other) {
    light += other.light;
    weight += other.weight;
    weight_squared += other.weight_squared;
    lost += other.lost;
    steps += other.steps;
    for (auto values : {&Batch::expected, &Batch::chosen, &Batch::size, &Batch::size_squared,
                        &Batch::seen, &Batch::moved})
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
class Layout {
 public:
  Layout(const Scene& scene, std::vector<std::string> signatures)
      : functions_(scene), signatures_(std::move(signatures)) {}

  const PathFunctions& functions() const { return functions_; }
  size_t plain() const { return functions_.size() + signatures_.size(); }
  size_t numbers() const { return functions_.numbers().size(); }
  /// Of what is summed, and with the sums over lengths that are made of it at the end.
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

class Auditor {
 public:
  Auditor(const PathTarget& target, const PathMixture& mixture, const AuditSettings& how,
          const std::atomic<bool>& cancelled)
      : target_(&target),
        mixture_(mixture),
        how_(how),
        cancelled_(&cancelled),
        layout_(target.scene(), {}),
        samples_(std::max<uint64_t>(1, how.paths / batches)) {}

  AuditReport run() {
    weight_of_step_ = pilot();
    const uint64_t first = samples_;
    const uint64_t most = how_.most_paths > 0 ? how_.most_paths / batches : 16 * first;
    std::vector<Batch> done(batches);
    double level = how_.significance;
    uint64_t total = 0;
    for (uint64_t stage = 0;; ++stage) {
      parallel_for(how_.threads, batches, [&](uint64_t i) {
        Batch more = batch(stage * batches + i);
        if (stage == 0)
          done[i] = std::move(more);
        else
          done[i].add(more);
      });
      total += samples_;
      const bool last = 2 * total > most;
      if (!last) level /= 2;
      AuditReport found = report(done, total, level);
      if (last || *cancelled_ || !found.undecided()) return found;
      samples_ = total;
    }
  }

 private:
  /// Mean weight of a sample, roughly, in paths that a mutation suits: as a step's weight, it makes
  /// for one step per sample.
  double pilot() {
    std::map<std::string, double> by_signature;
    PathSeeds seeds = target_->seeds();
    PathMixture mixture = mixture_;
    Rng rng(how_.seed, Purpose::pilot, 0);
    const uint64_t n = std::max<uint64_t>(1000, how_.paths / 10);
    double light = 0, suited = 0;
    PathState x;
    for (uint64_t i = 0; i < n && !*cancelled_; ++i)
      seeds.draw(RandomSampler(rng), [&](const Connection& connection, double weight) {
        light += weight;
        if (!take(seeds, connection, mixture, x)) return;
        suited += weight;
        by_signature[signature(x.terms)] += weight;
      });
    layout_ = Layout(target_->scene(), brightest(by_signature, least_share * suited));
    if (!(light > 0) && !*cancelled_)
      throw RenderError("no light path was found among " + std::to_string(n) + " samples");
    return (suited > 0 ? suited : light) / static_cast<double>(n);
  }

  static std::vector<std::string> brightest(const std::map<std::string, double>& weights,
                                            double least) {
    std::vector<std::pair<double, std::string>> found;
    for (const auto& [signature, weight] : weights)
      if (weight > least) found.emplace_back(-weight, signature);
    std::sort(found.begin(), found.end());
    std::vector<std::string> result;
    for (size_t i = 0; i < std::min(most_signatures, found.size()); ++i)
      result.push_back(found[i].second);
    return result;
  }

  /// Assembles x from a connection; false if no mutation suits it.
  static bool take(const PathSeeds& seeds, const Connection& connection, PathMixture& mixture,
                   PathState& x) {
    seeds.assemble(connection, x);
    return !(x.target > 0) || mixture.suits(x);
  }

  Batch batch(uint64_t index) const {
    Batch sums;
    for (auto* values : {&sums.expected, &sums.size, &sums.size_squared, &sums.largest})
      values->assign(layout_.summed(), 0);
    for (auto* values : {&sums.chosen, &sums.seen}) values->assign(layout_.plain(), 0);
    sums.moved.assign(1 + longest, 0);
    PathSeeds seeds = target_->seeds();
    PathChain chain(mixture_, Rng(how_.seed, Purpose::inspect, index));
    PathState x;
    Scratch scratch;
    for (uint64_t i = 0; i < samples_ && !*cancelled_; ++i) {
      double weight_of_sample = 0;
      seeds.draw(RandomSampler(chain.rng()), [&](const Connection& connection, double weight) {
        sums.light += weight;
        if (!take(seeds, connection, chain.kernel(), x)) return;
        if (!(x.target > 0)) {
          sums.lost += weight;
          return;
        }
        weight_of_sample += weight;
        const double wanted = weight / weight_of_step_;
        const double splits = std::min(std::floor(wanted + chain.rng().next()), most_splits);
        const double each = wanted < most_splits ? weight_of_step_ : weight / splits;
        for (double s = 0; s < splits; ++s) step(x, each, chain, scratch, sums);
      });
      sums.weight += weight_of_sample;
      sums.weight_squared += sqr(weight_of_sample);
    }
    return sums;
  }

  struct Scratch {
    std::vector<double> before, after, change, step, mean;
    /// Where the blocks begin that a step from x may change, and what becomes of them.
    std::vector<size_t> blocks;
    std::string signature;
  };

  /// g(x) of all functions and signatures.
  void evaluate(const PathState& x, const std::string& signature,
                std::vector<double>& values) const {
    layout_.functions().evaluate(x, values);
    values.resize(layout_.plain(), 0);
    if (const size_t i = layout_.index(signature); i < layout_.signatures())
      values[layout_.functions().size() + i] = 1;
  }

  /// g(y) - g(x) of all functions; 0 if it is no greater than rounding, such as that of a cosine
  /// that is always 1.
  void evaluate_change(const PathState& y, const std::string& signature, Scratch& s) const {
    evaluate(y, signature, s.after);
    s.change.resize(s.after.size());
    for (size_t g = 0; g < s.after.size(); ++g) {
      const double before = s.before[g], after = s.after[g];
      const double rounding = 1e-13 * std::max(std::abs(before), std::abs(after));
      s.change[g] = std::abs(after - before) > rounding ? after - before : 0;
    }
  }

  /// A step, or 0 if it may be rounding.
  static double no_rounding(double step) { return step > 1e-9 ? step : 0; }

  /// How far apart two images of paths are, by the width of the image.
  double step_in_image(const PathState& x, const PathState& y) const {
    return no_rounding(
        length(Vec2(y.raster - x.raster) / Vec2(target_->scene().camera().raster().size)));
  }
  /// The greatest distance between vertices of the same place, by the size of the scene.
  double step_in_space(const PathState& x, const PathState& y) const {
    if (x.edges() != y.edges()) return 0;
    double most = 0;
    for (int i = 0; i <= x.edges(); ++i)
      if (x[i].at.infinite() == y[i].at.infinite())
        most = std::max(most, length(y[i].at.p - x[i].at.p));
    return no_rounding(std::min(1.0, most / target_->scene().bounds().radius));
  }

  /// h(x, y) of all functions that a step from x may change: the plain ones, then by blocks.
  void evaluate_step(const PathState& x, const PathState& y, Scratch& s, double share,
                     Batch& sums) const {
    const std::string to = signature(y.terms);
    evaluate_change(y, to, s);
    s.step.assign(s.mean.size(), 0);
    std::copy(s.change.begin(), s.change.end(), s.step.begin());
    const double in_image = step_in_image(x, y);
    const bool same_length = x.edges() == y.edges();
    if (in_image > 0) {
      sums.moved[0] += share;
      if (same_length && x.edges() <= longest) sums.moved[x.edges()] += share;
    }
    double* out = s.step.data() + layout_.plain();
    for (const size_t block : s.blocks) {
      const double factor = block == layout_.in_image()              ? in_image
                            : block == layout_.in_space()            ? step_in_space(x, y)
                            : block >= layout_.of_signature(0)       ? s.signature == to
                            : !same_length                           ? 0
                            : block >= layout_.in_image_of_length(1) ? in_image
                                                                     : 1;
      if (factor != 0)
        for (size_t i = 0; i < layout_.numbers(); ++i)
          out[i] = factor * s.change[layout_.functions().numbers()[i]];
      out += layout_.numbers();
    }
  }

  /// Calls found(place in s.mean, place in the sums, count) for all that a step from x may change.
  template <class Found>
  void for_each_range(const Scratch& s, Found&& found) const {
    found(size_t{0}, size_t{0}, layout_.plain());
    for (size_t i = 0; i < s.blocks.size(); ++i)
      found(layout_.block(i), s.blocks[i], layout_.numbers());
  }

  void step(const PathState& x, double weight, PathChain& chain, Scratch& s, Batch& sums) const {
    s.signature = signature(x.terms);
    evaluate(x, s.signature, s.before);
    for (size_t g = 0; g < s.before.size(); ++g) sums.seen[g] += s.before[g] != 0;
    s.blocks = {layout_.in_image(), layout_.in_space()};
    if (x.edges() <= longest)
      s.blocks.insert(s.blocks.end(),
                      {layout_.of_length(x.edges()), layout_.in_image_of_length(x.edges())});
    if (const size_t i = layout_.index(s.signature); i < layout_.signatures())
      s.blocks.push_back(layout_.of_signature(i));
    s.mean.assign(layout_.block(s.blocks.size()), 0);
    int recorded = 0;
    const auto record = [&](const PathState& state, double share) {
      if (!(share > 0) || &state == &chain.state()) return;  // x: no change
      ++recorded;
      evaluate_step(x, state, s, weight * share, sums);
      for_each_range(s, [&](size_t from, size_t to, size_t count) {
        for (size_t i = 0; i < count; ++i) {
          s.mean[from + i] += share * s.step[from + i];
          sums.largest[to + i] =
              std::max(sums.largest[to + i], weight * std::abs(s.step[from + i]));
        }
      });
    };
    chain.restart(x);
    const StepResult result = chain.step(record);
    ++sums.steps;
    AuditRow& row = sums.rows[{chain.kernel().chosen(), s.signature}];
    ++row.steps;
    row.generated += chain.kernel().generated(chain.proposal(result, 0));
    row.accepted += result.accepted >= 0;
    row.invalid += result.invalid;
    row.acceptance += result.acceptance;
    if (result.acceptance == 0) return;
    for_each_range(s, [&](size_t from, size_t to, size_t count) {
      for (size_t i = 0; i < count; ++i) {
        const double change = weight * s.mean[from + i];
        sums.expected[to + i] += change;
        sums.size[to + i] += std::abs(change);
        sums.size_squared[to + i] += sqr(change);
      }
    });
    if (result.accepted < 0) return;
    // Else what was accepted is what was recorded last.
    if (recorded > 1) evaluate_change(chain.state(), signature(chain.state().terms), s);
    for (size_t g = 0; g < s.change.size(); ++g) sums.chosen[g] += weight * s.change[g];
  }

  /// Adds the sums over all lengths from one on.
  void add_tails(Batch& batch) const {
    for (auto values : {&Batch::expected, &Batch::size, &Batch::size_squared, &Batch::largest}) {
      std::vector<double>& sums = batch.*values;
      sums.resize(layout_.size(), 0);
      for (int tail = first_tail; tail <= last_tail; ++tail)
        for (int k = tail; k <= longest; ++k)
          for (size_t i = 0; i < layout_.numbers(); ++i) {
            const auto add = [&](size_t to, size_t from) {
              double& sum = sums[to + i];
              sum =
                  values == &Batch::largest ? std::max(sum, sums[from + i]) : sum + sums[from + i];
            };
            add(layout_.of_tail(tail, false), layout_.of_length(k));
            add(layout_.of_tail(tail, true), layout_.in_image_of_length(k));
          }
    }
  }

  AuditReport report(std::vector<Batch> done, uint64_t samples, double level) const {
    for (Batch& batch : done) add_tails(batch);
    AuditReport report;
    report.level = level;
    std::map<RowKey, AuditRow> rows;
    double light = 0, weight = 0, weight_squared = 0;
    for (const Batch& batch : done) {
      light += batch.light;
      weight += batch.weight;
      weight_squared += batch.weight_squared;
      report.steps += batch.steps;
      report.lost += batch.lost;
      for (const auto& [key, row] : batch.rows) Batch::add(rows[key], row);
    }
    for (auto& [key, row] : rows) {
      row.mutation = mixture_.moves()[key.first]->name();
      row.signature = key.second;
      report.accepted += row.accepted;
      report.invalid += row.invalid;
      report.rows.push_back(row);
    }
    std::stable_sort(report.rows.begin(), report.rows.end(),
                     [](const AuditRow& a, const AuditRow& b) { return a.steps > b.steps; });
    report.samples = samples * batches;
    report.b = light / static_cast<double>(report.samples);
    report.suited = weight / light;
    report.lost /= light;
    report.effective_samples = weight > 0 ? sqr(weight) / weight_squared : 0;
    if (weight > 0) add_tests(done, weight, report);
    report.judge(how_);
    return report;
  }

  void add_tests(const std::vector<Batch>& done, double weight, AuditReport& report) const {
    for (size_t h = 0; h < layout_.size(); ++h) {
      if (!changes_enough(done, h)) continue;
      for (const bool expected : {true, false}) {
        if (!expected && h >= layout_.plain()) continue;
        AuditTest test = t_test(done, expected ? &Batch::expected : &Batch::chosen, h, weight);
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
      (two_sided((low + high) / 2, batches - 1) > report.level / count ? low : high) =
          (low + high) / 2;
    report.least_z = high + nine_in_ten;
    add_limits(done, report);
  }

  bool changes_enough(const std::vector<Batch>& done, size_t h) const {
    double size = 0, size_squared = 0, largest = 0, seen = 0;
    for (const Batch& batch : done) {
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
  void add_limits(const std::vector<Batch>& done, AuditReport& report) const {
    const auto add = [&](size_t block, AuditLimit limit, int first, int last) {
      double moved = 0;
      for (const Batch& batch : done)
        for (int k = first; k <= last; ++k) moved += batch.moved[k];
      const auto error = [&](const std::string& name, double pixels) {
        const std::vector<size_t>& numbers = layout_.functions().numbers();
        size_t i = 0;
        while (layout_.functions().names()[numbers[i]] != name) ++i;
        const size_t h = block == 0 ? numbers[i] : block + i;
        return moved > 0 && changes_enough(done, h)
                   ? t_test(done, &Batch::expected, h, moved).error * pixels
                   : infinity;
      };
      const Vec2 size(target_->scene().camera().raster().size);
      limit.pixels = report.least_z * std::max(error("image x", size.x), error("image y", size.y));
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
    for (const Batch& batch : done)
      for (int k = 1; k <= longest; ++k) (k > tested ? longer : moved) += batch.moved[k];
    if (longer > 0) report.untested = {tested + 1, longer / (moved + longer)};
  }

  static AuditTest t_test(const std::vector<Batch>& done, std::vector<double> Batch::* sums,
                          size_t g, double weight) {
    double mean = 0, variance = 0;
    for (const Batch& batch : done) mean += (batch.*sums)[g] / batches;
    for (const Batch& batch : done) variance += sqr((batch.*sums)[g] - mean) / (batches - 1);
    AuditTest test;
    const double error = std::sqrt(variance / batches);
    test.change = mean * batches / weight;
    test.error = error * batches / weight;
    test.z = error > 0 ? mean / error : 0;
    test.p = two_sided(test.z, batches - 1);
    return test;
  }

  /// P(|T| > |t|) of Student's t, by the normal approximation of Wallace 1959 ("Bounds on normal
  /// approximations to Student's and the chi-square distributions"): accurate to 1 % for
  /// n > 60.
  static double two_sided(double t, double n) {
    const double z = std::sqrt(n * std::log1p(sqr(t) / n)) * (8 * n + 1) / (8 * n + 3);
    return std::erfc(z * std::sqrt(0.5));
  }

  const PathTarget* target_;
  PathMixture mixture_;
  AuditSettings how_;
  const std::atomic<bool>* cancelled_;
  Layout layout_;
  uint64_t samples_;  ///< Samples of each batch of a stage.
  double weight_of_step_ = 0;
};

}  // namespace

AuditReport audit(const PathTarget& target, const PathMixture& mixture, const AuditSettings& how,
                  const std::atomic<bool>& cancelled) {
  return Auditor(target, mixture, how, cancelled).run();
}

AuditReport audit(const PathTarget& target, const Mutations& mutations,
                  const MixtureWeights& weights, const AuditSettings& how,
                  const std::atomic<bool>& cancelled) {
  return audit(target, PathMixture(mutations, std::make_shared<MixtureWeights>(weights)), how,
               cancelled);
}

AuditReport audit(const PathTarget& target, const MutationPtr& mutation, const AuditSettings& how) {
  return audit(target, {mutation}, MixtureWeights(std::vector<double>{1.0}), how);
}

}  // namespace mlt
