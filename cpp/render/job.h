// Running a render: threads, progress, cancel, budgets, checkpoints. A render advances in stretches.
// Between two of them no unit is running: then its state may be saved, and its error looked at.
#pragma once

#include "image/image.h"
#include "integrator/integrator.h"
#include "render/division.h"
#include "render/error_estimate.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <thread>

namespace mlt {

/// When a render ends: at whichever comes first. With none, the scene's sample count, else 64. For a
/// render that goes on after a break each counts from its very beginning.
struct Budget {
  std::optional<double> spp;
  std::optional<double> seconds;  ///< Wall time, bootstrap included.
  std::optional<double> error;    ///< Relative; see ErrorEstimate::relative.

  bool empty() const { return !spp && !seconds && !error; }
};

/// Hands out the state of a render (see Job::save) when the bootstrap is over, then every so many
/// seconds, and when the render ends, also because it was cancelled.
struct Autosave {
  std::function<void(std::string state)> write;  ///< May throw; the render goes on.
  double every = 60;
};

struct RenderSettings {
  Budget budget;
  uint64_t seed = 0;
  int threads = 0;  ///< 0: as many as the machine has.
  Autosave autosave;
};

class Job;

/// Runs the units of a render elsewhere than on threads of this process. It is called by the thread
/// that leads the render.
class Crew {
 public:
  virtual ~Crew() = default;
  /// The render is cut into about so many parts.
  virtual int wanted_parts() = 0;
  /// Takes every part of the job's division from where it stands to the unit `to`. Returns early when
  /// the job is interrupted; it will be called again.
  virtual void advance(Job& job, uint64_t to) = 0;
  /// The render has ended.
  virtual void dismiss() = 0;
};

class Job {
 public:
  /// Throws UsageError for a budget that makes no sense, SceneError for a scene that does not suit.
  Job(ScenePtr scene, IntegratorPtr integrator, const RenderSettings& settings);
  ~Job() { stop(); }

  /// Before start(): units are run by this crew; the bootstrap is not.
  void hire(std::unique_ptr<Crew> crew);
  void start();
  /// Waits until the render has ended or `seconds` have passed; true if it has ended. Rethrows what
  /// went wrong inside the render.
  bool wait(double seconds);
  /// Ends the render soon; what has been rendered stays.
  void cancel() { cancel_ = true; }
  /// Cancels and waits.
  void stop();
  bool cancelled() const { return cancel_; }
  bool ended() const { return phase_ == Phase::ended; }

  /// The whole state as bytes: budget, units done, seconds spent, and Rendering::save. May be called at any
  /// time from any thread: it waits for the bootstrap, then for the units that are running, and the
  /// render goes on. Throws UsageError if the render has not been started, or ended in its bootstrap.
  std::string save();
  /// Before start(): goes on where a job with the same scene, integrator and seed was saved, to its
  /// budget if this job was given none. However often a render is taken up again, the same samples
  /// make the same pixels. Throws RenderError.
  void load(const std::string& state);
  /// After the end: goes on until a larger budget is used up. Throws UsageError.
  void extend(const Budget& budget);

  double progress() const;  ///< 0 ... 1 of the budget.
  double spp_done() const;  ///< Samples per pixel so far.
  Image image() const;      ///< So far: linear RGB, row 0 on top.
  /// Further images that the render was asked to keep, and its error, so far.
  std::vector<NamedImage> layers() const;
  /// How wrong the image is, so far; after the end it is worked out but once.
  std::shared_ptr<const ErrorEstimate> error() const;
  /// The independent groups behind it, so far.
  const Rendering& rendering() const { return *rendering_; }
  /// Repeats one sample of a pixel, whether or not the render has started. Throws UsageError.
  Replay replay(const Vec2i& pixel, uint64_t sample) { return rendering_->replay(pixel, sample); }
  /// After the end with the error of the image.
  Stats stats() const;

  // For a crew.
  Division& division() { return *division_; }
  /// Folds the outcome of an order of the division; see Division::fold.
  void fold(size_t part, const std::string& outcome);
  uint64_t units_done() const { return units_done_; }
  uint64_t units_per_step() const { return rendering_->units_per_step(); }
  /// Is the render to end now?
  bool stopping() const { return cancel_ || out_of_time(); }
  /// Or does somebody want to look at its state?
  bool interrupted() const { return stopping() || savers_ != 0 || autosave_due(); }

 private:
  using Clock = std::chrono::steady_clock;
  enum class Phase { waiting, bootstrap, rendering, ended };

  void launch();
  void run();
  void render();
  void check_goal() const;
  std::string why_to_end();
  void divide();
  void work();
  void open_gate();
  std::string state() const;
  bool autosave_due() const;
  void autosave();
  void autosave_at_end();
  void try_to_write(std::string state);
  uint64_t next_look(uint64_t units) const;
  void add_error(Stats& stats) const;
  double seconds_so_far() const;
  bool out_of_time() const;

  ScenePtr scene_;
  IntegratorPtr integrator_;
  RenderSettings settings_;
  bool default_budget_;  ///< None was asked for.
  std::unique_ptr<Rendering> rendering_;

  std::unique_ptr<Crew> crew_;
  std::optional<Division> division_;
  mutable std::mutex folding_;  ///< Nobody looks at the image while an outcome is folded in.

  std::atomic<bool> cancel_{false};
  std::atomic<Phase> phase_{Phase::waiting};
  std::atomic<uint64_t> next_unit_{0}, units_done_{0};
  std::atomic<uint64_t> unit_count_{0};
  uint64_t stop_at_ = 0;   ///< The unit before which this stretch ends.
  bool prepared_ = false;  ///< The bootstrap is over.
  Clock::time_point started_;
  double seconds_before_ = 0;  ///< Of earlier runs of this render.
  std::atomic<double> bootstrap_seconds_{0}, total_seconds_{0};

  std::thread thread_;
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  std::exception_ptr failure_;  ///< Guarded by mutex_ until the render has ended.
  std::string ended_by_;        ///< The same.

  std::atomic<int> savers_{0};  ///< Who waits for the gap between two stretches.
  bool between_stretches_ = false;
  std::condition_variable gate_;

  Clock::time_point next_autosave_;
  std::optional<uint64_t> units_autosaved_;
  std::future<void> writer_;
  std::string autosave_failure_;  ///< Guarded by mutex_.

  std::atomic<double> seen_error_{0};  ///< At the latest look, 0: none; and after how many units.
  std::atomic<uint64_t> seen_units_{0};
  mutable std::mutex error_mutex_;
  mutable std::shared_ptr<const ErrorEstimate> final_error_;
};

}  // namespace mlt
