// Stops work that does not check the time itself, or cannot end.
#pragma once

#include "base/abandon.h"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace mlt {

/// Watches over the work of the thread that made it, from a thread of its own.
class Watchdog {
 public:
  /// Seconds from the signal to stop until units that still run are abandoned. Units last about a
  /// second.
  static constexpr double patience = 5;

  /// `stopping` tells whether the work is to stop; it is called some times a second.
  explicit Watchdog(std::function<bool()> stopping, double patience = Watchdog::patience);
  ~Watchdog();

  /// The flag that is set when the work is to stop, for loops that can end between any two steps.
  const std::atomic<bool>& stop() const { return stop_; }

 private:
  void watch();

  std::function<bool()> stopping_;
  double patience_;
  std::atomic<bool> stop_{false}, abandon_{false};
  Abandonable abandonable_{&abandon_};
  std::mutex mutex_;
  std::condition_variable over_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace mlt
