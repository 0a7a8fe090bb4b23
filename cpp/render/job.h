// Running a render: threads, progress, cancel, budgets.
#pragma once

#include "image/image.h"
#include "integrator/integrator.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

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
  void cancel();

  bool ended() const;
  bool cancelled() const { return cancel_; }
  double progress() const;  ///< 0 ... 1 of the budget.
  Image image() const;      ///< So far: linear RGB, row 0 on top.
  Stats stats() const;

 private:
  void run();
  void work();

  ScenePtr scene_;
  IntegratorPtr integrator_;
  RenderSettings settings_;
  std::unique_ptr<Rendering> rendering_;
  // The rest belongs to job.cpp.
  struct State;
  std::unique_ptr<State> state_;
  std::atomic<bool> cancel_{false};
};

}  // namespace mlt
