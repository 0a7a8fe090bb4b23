// Running a render: threads, progress, cancel, budgets.
#pragma once

#include "image/image.h"
#include "integrator/integrator.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace mlt {

/// When a render ends: at whichever comes first. With neither, the scene's sample count, else 64.
struct Budget {
  std::optional<double> spp;
  std::optional<double> seconds;  ///< Wall time, bootstrap included.
};

struct RenderSettings {
  Budget budget;
  uint64_t seed = 0;
  int threads = 0;  ///< 0: as many as the machine has.
};

class Job {
 public:
  /// Throws UsageError for a budget that makes no sense, SceneError for a scene that does not suit.
  Job(ScenePtr scene, IntegratorPtr integrator, const RenderSettings& settings);
  ~Job();  ///< Cancels and waits.

  void start();
  /// Waits until the render has ended or `seconds` have passed; true if it has ended. Rethrows what
  /// went wrong inside the render.
  bool wait(double seconds);
  /// Ends the render soon; what has been rendered stays.
  void cancel() { cancel_ = true; }
  bool cancelled() const { return cancel_; }
  bool ended() const { return phase_ == Phase::ended; }

  double progress() const;  ///< 0 ... 1 of the budget.
  Image image() const;      ///< So far: linear RGB, row 0 on top.
  /// Further images that the render was asked to keep, so far.
  std::vector<NamedImage> layers() const { return rendering_->layers(); }
  /// Repeats one sample of a pixel, whether or not the render has started. Throws UsageError.
  Replay replay(const Vec2i& pixel, uint64_t sample) { return rendering_->replay(pixel, sample); }
  Stats stats() const;

 private:
  using Clock = std::chrono::steady_clock;
  enum class Phase { waiting, bootstrap, rendering, ended };

  void run();
  void work();
  double seconds_since_start() const;
  bool out_of_time() const;

  ScenePtr scene_;
  IntegratorPtr integrator_;
  RenderSettings settings_;
  std::unique_ptr<Rendering> rendering_;

  std::atomic<bool> cancel_{false};
  std::atomic<Phase> phase_{Phase::waiting};
  std::atomic<uint64_t> next_unit_{0}, units_done_{0};
  std::atomic<uint64_t> unit_count_{0};
  Clock::time_point started_;
  std::atomic<double> bootstrap_seconds_{0}, total_seconds_{0};

  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::exception_ptr failure_;  ///< Guarded by mutex_ until the render has ended.
};

}  // namespace mlt
