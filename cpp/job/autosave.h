// Writing the state of a render now and then, while it goes on.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <string>

namespace mlt {

/// Where the state of a render (see Job::save) goes when the bootstrap is over, then every `every`
/// seconds, and when the render ends, even if it was cancelled.
struct AutosaveSettings {
  std::function<void(std::string state)> write;  ///< May throw; the render goes on.
  double every = 60;
};

class Autosave {
 public:
  using State = std::function<std::string()>;
  /// Throws UsageError.
  explicit Autosave(AutosaveSettings settings);

  /// Records that the state after `units` units is the one that was loaded.
  void begin_saved(uint64_t units);
  bool due() const { return settings_.write && Clock::now() >= next_; }
  /// Writes the state in the background, if it has changed and the one before has been written.
  void save(uint64_t units, const State& state);
  /// Waits for the writer at the end of a render, and writes the last state if it has not.
  void finish(uint64_t units, const State& state);
  /// Why the latest state could not be written, or "".
  std::string failure() const;

 private:
  using Clock = std::chrono::steady_clock;
  void postpone();
  void note(const std::string& failure);

  AutosaveSettings settings_;
  Clock::time_point next_{};  ///< The first save is due at once.
  std::optional<uint64_t> units_saved_;
  mutable std::mutex mutex_;
  std::string failure_;  ///< Guarded by mutex_.
  std::future<void> writer_;
};

}  // namespace mlt
