#include "job/stop_rule.h"

#include "job/error_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mlt {
namespace {

/// The error is first checked after this many samples per pixel, when at least eight groups have
/// had their turn, and then whenever the work has grown by this factor: frequent checks would stop
/// a render too early.
constexpr double first_look_spp = 64, look_growth = 1.3;

/// An upper bound of the error. An error that is carried by few pixels is itself uncertain, and
/// stopping when it happens to be small is too early: two of its standard errors are added to its
/// square, as if the terms of the pixels were independent and exponentially distributed.
double bound(const RelativeError& error) {
  return error.value * std::sqrt(1 + 2 / std::sqrt(error.carrying));
}

void check(const std::optional<double>& value, const char* name) {
  if (value && !(*value > 0 && std::isfinite(*value)))
    throw UsageError(std::string(name) + " must be a positive number");
}

}  // namespace

void StopRule::set(const Budget& budget) {
  check(budget.spp, "spp");
  if (budget.spp > max_spp)
    throw UsageError(
        fmt::format("spp is {:g}, but should be at most {:.0f}", *budget.spp, max_spp));
  check(budget.seconds, "time");
  check(budget.error, "error");
  budget_ = budget;
  default_ = budget.empty();
  if (default_)
    budget_.spp = scene_->sample_count() > 0 ? static_cast<double>(scene_->sample_count()) : 64.0;
}

void StopRule::begin(const Rendering& rendering) {
  unit_count_ = rendering.plan().unit_count(budget_.spp.value_or(max_spp));
  if (!budget_.error || budget_.spp || budget_.seconds) return;
  // Without further samples b stays as wrong as the bootstrap has left it.
  Stats stats;
  rendering.add_stats(stats);
  if (stats.independent_share > 0) return;
  if (const double least = stats.b_error / stats.b; stats.b > 0 && least >= *budget_.error)
    throw RenderError(fmt::format(
        "an error of {:g} cannot be reached, since the bootstrap leaves one of {:.2g}; give more "
        "luminance_samples, or a budget of spp or time as well",
        *budget_.error, least));
}

std::string StopRule::why_to_end(const Rendering& rendering, uint64_t units, double seconds) {
  if (budget_.error && units > 0 && units == next_look(rendering, units - 1)) {
    seen_error_ = error_ ? error_() : bound(estimate_error(rendering).relative);
    seen_units_ = units;
    if (seen_error_ <= *budget_.error) return "error";
  }
  if (units >= unit_count_) return "spp";
  return out_of_time(seconds) ? "time" : "";
}

uint64_t StopRule::next_pause(const Rendering& rendering, uint64_t units) const {
  const uint64_t end = unit_count_;
  return budget_.error ? std::min(end, next_look(rendering, units)) : end;
}

/// After how many units the error is checked next: when all groups have had as many turns, and
/// fixed for each render, so that a render that was interrupted ends where it would have ended.
uint64_t StopRule::next_look(const Rendering& rendering, uint64_t units) const {
  const uint64_t turn = rendering.plan().units_per_group_turn;
  uint64_t turns = (rendering.plan().unit_count(first_look_spp) + turn - 1) / turn;
  while (turns * turn <= units)
    turns = std::max(turns + 1,
                     static_cast<uint64_t>(std::ceil(look_growth * static_cast<double>(turns))));
  return turns * turn;
}

double StopRule::progress(uint64_t units, double seconds) const {
  const double done = static_cast<double>(units);
  double progress = 0;
  if (budget_.spp && unit_count_ > 0) progress = done / static_cast<double>(unit_count_);
  if (budget_.seconds) progress = std::max(progress, seconds / *budget_.seconds);
  // The squared error falls as 1 / n.
  if (const double seen = seen_error_; budget_.error && seen > 0)
    progress = std::max(
        progress, std::pow(*budget_.error / seen, 2) * done / static_cast<double>(seen_units_));
  return std::min(1.0, progress);
}

void StopRule::save(ByteWriter& bytes) const {
  for (const auto* limit : {&budget_.spp, &budget_.seconds, &budget_.error}) bytes.write(*limit);
}

Budget StopRule::read(ByteReader& bytes) {
  Budget saved;
  for (auto* limit : {&saved.spp, &saved.seconds, &saved.error}) bytes.read(*limit);
  return saved;
}

void StopRule::load(ByteReader& bytes) {
  const Budget saved = read(bytes);
  if (default_) set(saved);
}

}  // namespace mlt
