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

/// Who gets the state of a render (see Job::save) when the bootstrap is over, then every so many
/// seconds, and when the render ends, also because it was cancelled.
struct AutosaveSettings {
  std::function<void(std::string state)> write;  ///< May throw; the render goes on.
  double every = 60;
};

class Autosave {
 public:
  using State = std::function<std::string()>;
  /// Throws UsageError.
  explicit Autosave(AutosaveSettings settings);

  /// The state after so many units is the one that was loaded.
  void begin_saved(uint64_t units);
  bool due() const { return settings_.write && Clock::now() >= next_; }
  /// Takes the state, if it has changed and the one before is written; writes it in the background.
  void save(uint64_t units, const State& state);
  /// At the end: waits for the background, and writes what is not yet written.
  void finish(uint64_t units, const State& state);
  /// Why the latest state could not be written, or "".
  std::string failure() const;

 private:
  using Clock = std::chrono::steady_clock;
  void postpone();
  void note(const std::string& failure);

  AutosaveSettings settings_;
  Clock::time_point next_{};  ///< At once.
  std::optional<uint64_t> units_saved_;
  mutable std::mutex mutex_;
  std::string failure_;  ///< Guarded by mutex_.
  std::future<void> writer_;
};

}  // namespace mlt
