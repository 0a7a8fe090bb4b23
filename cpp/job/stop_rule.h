// When a render ends: at whichever of its budgets comes first.
#pragma once

#include "base/bytes.h"
#include "rendering/integrator.h"

#include <atomic>
#include <optional>
#include <string>

namespace mlt {

/// More samples per pixel no render takes; up to here no number of units overflows.
constexpr double max_spp = 2147483647;

/// With none, the scene's sample count, else 64. For a render that goes on after a break each
/// counts from its very beginning.
struct Budget {
  std::optional<double> spp;
  std::optional<double> seconds;  ///< Wall time, bootstrap included.
  std::optional<double> error;    ///< Relative; see ErrorEstimate::relative.

  bool empty() const { return !spp && !seconds && !error; }
};

class StopRule {
 public:
  /// Throws UsageError for a budget that makes no sense.
  StopRule(const Budget& budget, const Scene& scene) : scene_(&scene) { set(budget); }
  /// Not while the render is going on.
  void set(const Budget& budget);

  /// More than these will not be taken.
  double most_spp() const { return budget_.spp.value_or(max_spp); }

  /// Once the rendering is prepared. Throws RenderError for an error that it cannot reach.
  void begin(const Rendering& rendering);
  /// Why the render is to end after so many units: "spp", "time", "error", or "" if it is not.
  std::string why_to_end(const Rendering& rendering, uint64_t units, double seconds);
  /// The unit before which this is to be asked again.
  uint64_t next_pause(const Rendering& rendering, uint64_t units) const;
  const std::optional<double>& seconds() const { return budget_.seconds; }
  bool out_of_time(double seconds) const { return budget_.seconds && seconds >= *budget_.seconds; }
  /// 0 ... 1 of the budget. While the render is going on, too.
  double progress(uint64_t units, double seconds) const;

  void save(ByteWriter& bytes) const;
  /// The saved budget; load() takes it if none was given.
  static Budget read(ByteReader& bytes);
  void load(ByteReader& bytes);

 private:
  uint64_t next_look(const Rendering& rendering, uint64_t units) const;

  const Scene* scene_;
  Budget budget_;
  bool default_ = true;  ///< No budget was asked for.
  std::atomic<uint64_t> unit_count_{0};
  std::atomic<double> seen_error_{0};  ///< At the latest look, 0: none; and after how many units.
  std::atomic<uint64_t> seen_units_{0};
};

}  // namespace mlt
