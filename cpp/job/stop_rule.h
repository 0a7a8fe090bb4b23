// When a render ends: at the first of its budgets that is used up.
#pragma once

#include "base/bytes.h"
#include "rendering/integrator.h"

#include <atomic>
#include <functional>
#include <optional>
#include <string>

namespace mlt {

/// The most samples per pixel that a render takes; up to here no number of units overflows.
constexpr double max_spp = 2147483647;

/// Limits of a render; with none, the scene's sample count, else 64. For a render that is resumed
/// each counts from its very beginning.
struct Budget {
  std::optional<double> spp;
  std::optional<double> seconds;  ///< Wall time, bootstrap included.
  std::optional<double> error;    ///< Relative; see ErrorEstimate::relative.

  bool empty() const { return !spp && !seconds && !error; }
};

class StopRule {
 public:
  /// Throws UsageError for an invalid budget.
  StopRule(const Budget& budget, const Scene& scene) : scene_(&scene) { set(budget); }
  /// Replaces the budget. Not while the render is going on.
  void set(const Budget& budget);

  /// Sets what tells the error, in place of estimate_error: an upper bound, or NaN if it is not
  /// known.
  void judge_by(std::function<double()> error) { error_ = std::move(error); }

  /// The largest number of samples per pixel that may be taken.
  double most_spp() const { return budget_.spp.value_or(max_spp); }

  /// Called once the rendering is prepared. Throws RenderError for an error that it cannot reach.
  void begin(const Rendering& rendering);
  /// Why the render ends after this number of units: "spp", "time", "error", or "" if it goes on.
  std::string why_to_end(const Rendering& rendering, uint64_t units, double seconds);
  /// The unit before which why_to_end is to be called again.
  uint64_t next_pause(const Rendering& rendering, uint64_t units) const;
  const std::optional<double>& seconds() const { return budget_.seconds; }
  bool out_of_time(double seconds) const { return budget_.seconds && seconds >= *budget_.seconds; }
  /// The used part of the budget, 0 ... 1. May be called while the render is going on.
  double progress(uint64_t units, double seconds) const;

  void save(ByteWriter& bytes) const;
  /// The saved budget, which load() takes if none was given.
  static Budget read(ByteReader& bytes);
  void load(ByteReader& bytes);

 private:
  uint64_t next_look(const Rendering& rendering, uint64_t units) const;

  const Scene* scene_;
  Budget budget_;
  std::function<double()> error_;
  bool default_ = true;  ///< No budget was asked for.
  std::atomic<uint64_t> unit_count_{0};
  std::atomic<double> seen_error_{0};  ///< The latest estimate, 0: none; and its units.
  std::atomic<uint64_t> seen_units_{0};
};

}  // namespace mlt
