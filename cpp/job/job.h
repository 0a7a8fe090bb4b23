// A render that runs on a thread of its own: progress, cancel, budgets, checkpoints. Now and then
// it pauses: no unit is running then, so its state may be saved, and its error estimated.
#pragma once

#include "job/autosave.h"
#include "job/error_estimate.h"
#include "job/executor.h"
#include "job/halves.h"
#include "job/memory_reserve.h"
#include "job/stop_rule.h"
#include "rendering/cryptomatte.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <thread>

#include <sys/types.h>

namespace mlt {

constexpr int max_threads = 4096;

struct RenderSettings {
  Budget budget;
  uint64_t seed = 0;
  int threads = 0;  ///< 0: as many as the machine has.
  AutosaveSettings autosave;
  std::vector<Aov> aovs;  ///< Layers to be rendered beside the image.
  SurfaceNames names;     ///< Needed for Cryptomattes among these.
  bool alpha = false;     ///< Whether there is a layer "alpha", too; the film may also ask for it.
  bool hide_emitters = false;  ///< Whether the background is left out, which else hides all.
};

class Job {
 public:
  /// Throws UsageError for invalid settings, SceneError for a scene that the integrator does not
  /// support, RenderError for an image that is too large for the memory.
  Job(ScenePtr scene, IntegratorPtr integrator, const RenderSettings& settings);
  ~Job() { stop(); }

  /// Before start(): sets the executor of the units, in place of the threads of this process.
  void attach(std::unique_ptr<Executor> executor);
  /// Before start(): see StopRule. The leading thread calls `error` while no unit is running.
  void judge_by(std::function<double()> error) { stop_rule_.judge_by(std::move(error)); }
  void start();  ///< Throws RenderError if memory is short.
  /// Waits until the render has ended or `seconds` have passed; true if it has ended. Rethrows the
  /// exception that ended it.
  bool wait(double seconds);
  /// Ends the render soon; what has been rendered stays.
  void cancel() { cancel_ = true; }
  /// Cancels and waits.
  void stop();
  bool cancelled() const { return cancel_; }
  bool ended() const { return phase_ == Phase::ended; }
  /// Whether it was started by another process, of which this one is a fork.
  bool elsewhere() const;

  /// The whole state as bytes: budget, units done, seconds spent, and Rendering::save. May be
  /// called at any time from any thread: it waits for the bootstrap, then for the units that are
  /// running, and the render goes on. Throws UsageError if the render has not been started, or
  /// ended in its bootstrap.
  std::string save();
  /// After how many units a state was saved. Throws RenderError.
  static uint64_t units_of(const std::string& state);
  /// Before start(): loads the state that a job with the same scene, integrator and seed has saved,
  /// and its budget if this job was given none. However often a render is resumed, the same samples
  /// make the same pixels. Throws RenderError.
  void load(const std::string& state);
  /// After the end: renders on until a larger budget is used up. Throws UsageError.
  void extend(const Budget& budget);

  // Until the render has ended, all functions that return an image or statistics, and wait() and
  // save(), throw RenderError in a process that was forked from the one that renders.

  double progress() const;  ///< 0 ... 1 of the budget.
  double spp_done() const;  ///< Samples per pixel so far.
  Image image() const;      ///< The image so far: linear RGB, row 0 on top.
  /// The image so far, without fireflies (see without_fireflies).
  Image image_without_fireflies() const;
  /// Two halves of the image so far, or of one of its layers of light (see halves.h), or nothing.
  std::optional<Halves> halves(int layer = Rendering::all_light) const;
  /// Further images that the render was asked to keep, layers of light with the errors of those of
  /// lamps, layers of the first surface (see aov.h), alpha, and the error of the image, so far.
  std::vector<NamedImage> layers() const;
  /// The light of each lamp so far, if it is kept (see light_layers.h): it adds up to the image.
  std::vector<NamedImage> light() const;
  bool has_alpha() const { return alpha_; }
  /// The error of the image so far; after the end it is estimated only once.
  std::shared_ptr<const ErrorEstimate> error() const;
  /// The rendering with its independent groups, so far.
  const Rendering& rendering() const {
    check_here();
    return *rendering_;
  }
  /// Repeats one sample of a pixel, whether or not the render has started. Throws UsageError.
  Replay replay(const Vec2i& pixel, uint64_t sample) { return rendering_->replay(pixel, sample); }
  /// Statistics; after the end with the error of the image.
  Stats stats() const;

  // Functions for an executor:
  uint64_t units_done() const { return units_done_; }
  /// Whether the render shall end now.
  bool stopping() const { return cancel_ || stop_rule_.out_of_time(seconds_so_far()); }
  /// Whether units shall pause: the render shall end, or its state is to be saved.
  bool interrupted() const { return stopping() || savers_ != 0 || autosave_.due(); }
  /// Runs the units before `to` on threads of this process, until interrupted.
  void run_units(uint64_t to);
  /// The tasks, if the executor has asked for them.
  TaskList& tasks() { return *tasks_; }
  /// Merges the result of a task; see TaskList::merge.
  void merge(size_t task, const std::string& result);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Phase { waiting, bootstrap, rendering, ended };

  void check_here() const;
  void check_waiting() const;
  void take_memory();
  size_t bytes_needed() const;
  size_t bytes_for_the_end() const;
  [[noreturn]] void fail_for_memory() const;
  void launch();
  void lead();
  void prepare();
  void render();
  void let_savers_in();
  std::string state() const;
  std::vector<NamedImage> first_surface_layers() const;
  std::vector<NamedImage> light_layers() const;
  void check_layer_names() const;
  double seconds_so_far() const;

  ScenePtr scene_;
  IntegratorPtr integrator_;
  uint64_t seed_;
  int threads_;
  std::unique_ptr<Rendering> rendering_;
  std::unique_ptr<Executor> executor_;
  std::optional<TaskList> tasks_;
  mutable std::mutex merging_;  ///< Locked while a result is merged or the image is read.
  StopRule stop_rule_;
  Autosave autosave_;
  size_t available_ = available_memory();
  MemoryReserve reserve_;  ///< Memory for the work after the last unit; held while units run.

  std::atomic<bool> cancel_{false};
  std::atomic<Phase> phase_{Phase::waiting};
  std::atomic<uint64_t> units_done_{0};
  bool prepared_ = false;   ///< The bootstrap is over.
  bool abandoned_ = false;  ///< A unit was abandoned, so the render cannot be extended.
  Clock::time_point started_;
  double seconds_before_ = 0;  ///< Time of earlier runs of this render.
  std::atomic<double> bootstrap_seconds_{0}, total_seconds_{0};

  std::thread thread_;
  pid_t process_ = 0;  ///< The process that renders; its forks do not have the thread.
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  std::exception_ptr failure_;  ///< Guarded by mutex_ until the render has ended.
  std::string ended_by_;        ///< Guarded by mutex_ until the render has ended.

  std::atomic<int> savers_{0};  ///< Threads that wait for a pause.
  bool paused_ = false;
  std::condition_variable pause_;

  std::vector<Aov> aovs_;
  SurfaceNames names_;
  bool alpha_, hide_emitters_;
  mutable std::mutex aov_mutex_;
  mutable std::vector<NamedImage> aov_layers_;  ///< Empty until they are first asked for.

  mutable std::mutex error_mutex_;
  mutable std::shared_ptr<const ErrorEstimate> final_error_;
};

}  // namespace mlt
