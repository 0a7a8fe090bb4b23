#include "base/watchdog.h"

#include <chrono>
#include <system_error>

namespace mlt {

Watchdog::Watchdog(std::function<bool()> stopping, double patience)
    : stopping_(std::move(stopping)), patience_(patience) {
  try {
    thread_ = std::thread(&Watchdog::watch, this);
  } catch (
      const std::system_error&) {  // Without another thread, work ends by itself or not at all.
  }
}

Watchdog::~Watchdog() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  over_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Watchdog::watch() {
  using Clock = std::chrono::steady_clock;
  constexpr auto pause = std::chrono::milliseconds(20);
  Clock::time_point going_on = Clock::now();
  std::unique_lock lock(mutex_);
  while (!over_.wait_for(lock, pause, [this] { return is_over_; })) {
    stop_ = stop_ || stopping_();
    if (!stop_)
      going_on = Clock::now();
    else
      abandon_ = std::chrono::duration<double>(Clock::now() - going_on).count() > patience_;
  }
}

}  // namespace mlt
