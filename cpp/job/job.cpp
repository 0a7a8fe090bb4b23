#include "job/job.h"

#include "base/parallel.h"
#include "base/watchdog.h"

#include <fmt/format.h>

#include <unistd.h>

namespace mlt {

void Executor::run(Job& job, uint64_t to) { job.run_units(to); }

Job::Job(ScenePtr scene, IntegratorPtr integrator, const RenderSettings& settings)
    : scene_(std::move(scene)),
      integrator_(std::move(integrator)),
      seed_(settings.seed),
      threads_(settings.threads == 0 ? hardware_threads() : settings.threads),
      executor_(std::make_unique<Executor>()),
      stop_rule_(settings.budget, *scene_),
      autosave_(settings.autosave),
      aovs_(settings.aovs),
      names_(settings.names),
      alpha_(settings.alpha || scene_->film().alpha),
      hide_emitters_(settings.hide_emitters) {
  if (threads_ < 0 || threads_ > max_threads)
    throw UsageError(fmt::format("threads must lie between 0 and {}; 0 means all", max_threads));
  try {
    rendering_ = integrator_->start(scene_, seed_);
  } catch (const std::bad_alloc&) {
    fail_for_memory();
  }
  check_layer_names();
}

void Job::check_layer_names() const {
  const LightLayers* light = rendering_->light_layers();
  if (!light) return;
  for (const Aov& aov : aovs_)
    for (const std::string& name : light->names())
      if (name == aov.name) throw UsageError("two layers are called '" + name + "'");
}

void Job::stop() {
  cancel();
  if (!thread_.joinable()) return;
  if (elsewhere())
    thread_.detach();
  else
    thread_.join();
}

bool Job::elsewhere() const { return process_ != 0 && process_ != ::getpid(); }

void Job::check_waiting() const {
  if (phase_ != Phase::waiting) throw UsageError("the render has been started already");
}

void Job::attach(std::unique_ptr<Executor> executor) {
  check_waiting();
  executor_ = std::move(executor);
}

void Job::start() {
  check_waiting();
  launch();
}

void Job::extend(const Budget& budget) {
  if (!ended()) throw UsageError("only a render that has ended can be extended");
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(failure_);
  if (!prepared_)
    throw UsageError("a render that was cancelled in its bootstrap cannot be extended");
  if (abandoned_) throw UsageError("a render that gave up a light path cannot be extended");
  stop_rule_.set(budget);
  cancel_ = false;
  seconds_before_ = total_seconds_;
  ended_by_.clear();
  final_error_ = nullptr;
  launch();
}

void Job::launch() {
  take_memory();
  phase_ = prepared_ ? Phase::rendering : Phase::bootstrap;
  started_ = Clock::now();
  process_ = ::getpid();
  try {
    thread_ = std::thread(&Job::lead, this);
  } catch (const std::system_error&) {
    throw RenderError("out of memory for a thread, or there are too many threads");
  }
}

// ---- memory -------------------------------------------------------------------------------------

namespace {

/// Bounds on the memory for developing the image, estimating its error and writing both, beside
/// the sums: bytes per pixel (float images of 3 channels have 12), and a constant.
/// Each layer of the first surface is kept once, and copied once to the caller; alpha has sums of
/// its own, and is written beside a copy of the image.
constexpr size_t end_per_pixel = 144, end_at_least = size_t{16} << 20, aov_per_pixel = 24,
                 matte_per_pixel = 32, alpha_per_pixel = 64;

size_t bytes_per_pixel(const Aov& aov) {
  return is_cryptomatte(aov.kind) ? matte_per_pixel * cryptomatte_layers(aov).size()
                                  : aov_per_pixel;
}

}  // namespace

size_t Job::bytes_for_the_end() const {
  const Vec2i size = scene_->camera().raster().size;
  size_t per_pixel = end_per_pixel + (alpha_ ? alpha_per_pixel : 0);
  for (const Aov& aov : aovs_) per_pixel += bytes_per_pixel(aov);
  // the light and its error
  if (rendering_ && rendering_->light_layers())
    per_pixel += 2 * aov_per_pixel * rendering_->light_layers()->count();
  return end_at_least + per_pixel * size.x * size.y;
}

size_t Job::bytes_needed() const {
  const Vec2i size = scene_->camera().raster().size;
  const size_t sums = rendering_ ? rendering_->memory(stop_rule_.most_spp()).bytes
                                 : size_t{24} * Rendering::group_count * size.x * size.y;
  return sums + bytes_for_the_end();
}

void Job::fail_for_memory() const {
  const Vec2i size = scene_->camera().raster().size;
  throw RenderError(
      fmt::format("an image of {} x {} pixels needs about {} of memory, more than is available; "
                  "choose a smaller size",
                  size.x, size.y, in_words(bytes_needed())));
}

void Job::take_memory() {
  const size_t to_come = rendering_->memory(stop_rule_.most_spp()).to_come;
  if (!reserve_.take(bytes_for_the_end(), to_come)) fail_for_memory();
}

// ---- the leading thread -----------------------------------------------------------------------

void Job::lead() {
  std::exception_ptr failure;
  try {
    if (!prepared_) prepare();
    if (prepared_) render();
  } catch (const Abandoned&) {
    abandoned_ = true;
  } catch (const std::bad_alloc&) {
    reserve_.release();  // The message takes memory, too.
    failure = std::make_exception_ptr(RenderError("out of memory; the render cannot go on"));
  } catch (...) {
    failure = std::current_exception();
  }
  reserve_.release();
  try {
    executor_->close();
    total_seconds_ = seconds_so_far();
    if (!failure && prepared_ && !abandoned_)
      autosave_.finish(units_done_, [this] { return state(); });
  } catch (...) {
    if (!failure) failure = std::current_exception();
  }
  if (ended_by_.empty()) ended_by_ = cancel_ ? "cancel" : "time";
  if (!failure && units_done_ == 0 && ended_by_ == "time")
    failure = std::make_exception_ptr(
        RenderError("the time was used up before the first sample; give more"));
  const std::lock_guard lock(mutex_);
  failure_ = failure;
  phase_ = Phase::ended;
  ended_.notify_all();
  pause_.notify_all();
}

/// Runs the bootstrap. It can be abandoned at once: no rendered unit is lost.
void Job::prepare() {
  constexpr double share = 0.05;  // of the time
  if (stop_rule_.seconds()) rendering_->limit_preparation(share * *stop_rule_.seconds());
  const Watchdog watchdog([this] { return stopping(); }, 0);
  rendering_->prepare(threads_, watchdog.stop());
  bootstrap_seconds_ = seconds_so_far();
  prepared_ = !watchdog.stop();
}

void Job::render() {
  const Watchdog watchdog([this] { return stopping(); });
  stop_rule_.begin(*rendering_);
  if (tasks_) units_done_ = tasks_->done();  // in an earlier run, tasks came to different ends
  tasks_.reset();
  if (const int wanted = executor_->wanted_tasks(); wanted > 0)
    tasks_.emplace(*rendering_, seed_, wanted, units_done_);
  phase_ = Phase::rendering;
  for (;;) {
    let_savers_in();
    if (autosave_.due()) autosave_.save(units_done_, [this] { return state(); });
    std::string why =
        cancel_ ? "cancel" : stop_rule_.why_to_end(*rendering_, units_done_, seconds_so_far());
    if (!why.empty()) {
      const std::lock_guard lock(mutex_);
      ended_by_ = std::move(why);
      return;
    }
    executor_->run(*this, stop_rule_.next_pause(*rendering_, units_done_));
  }
}

/// Every unit that was begun is finished, so in a pause the units before units_done_ are done.
void Job::run_units(uint64_t to) {
  mlt::run_units(
      *rendering_, {Strands(), units_done_, to}, threads_, [this] { return interrupted(); },
      units_done_);
}

void Job::merge(size_t task, const std::string& result) {
  const std::lock_guard lock(merging_);
  units_done_ += tasks_->merge(task, result);
}

// ---- saving -----------------------------------------------------------------------------------

void Job::let_savers_in() {
  if (savers_ == 0) return;
  std::unique_lock lock(mutex_);
  paused_ = true;
  pause_.notify_all();
  pause_.wait(lock, [this] { return savers_ == 0; });
  paused_ = false;
}

std::string Job::save() {
  check_here();
  std::unique_lock lock(mutex_);
  if (phase_ == Phase::waiting) throw UsageError("the render has not been started");
  struct Waiting {
    Job& job;
    explicit Waiting(Job& j) : job(j) { ++job.savers_; }
    ~Waiting() {
      --job.savers_;
      job.pause_.notify_all();
    }
  } waiting(*this);
  pause_.wait(lock, [this] { return paused_ || phase_ == Phase::ended; });
  if (!prepared_ || failure_)
    throw UsageError("the render ended before there was anything to save");
  if (abandoned_) throw UsageError("a render that gave up a light path cannot be saved");
  return state();
}

std::string Job::state() const {
  ByteWriter bytes;
  stop_rule_.save(bytes);
  bytes.write(tasks_ ? tasks_->done() : units_done_.load());
  bytes.write(bootstrap_seconds_.load());
  bytes.write(ended() ? total_seconds_.load() : seconds_so_far());
  bytes.write(rendering_->save());
  return bytes.take();
}

uint64_t Job::units_of(const std::string& state) {
  ByteReader bytes(state);
  StopRule::read(bytes);
  return bytes.read<uint64_t>();
}

void Job::load(const std::string& state) {
  check_waiting();
  ByteReader bytes(state);
  std::string rendering;
  stop_rule_.load(bytes);
  const auto units = bytes.read<uint64_t>();
  const auto bootstrap = bytes.read<double>(), total = bytes.read<double>();
  bytes.read(rendering);
  bytes.finish();
  rendering_->load(rendering);
  prepared_ = true;
  units_done_ = units;
  autosave_.begin_saved(units);
  bootstrap_seconds_ = bootstrap;
  total_seconds_ = seconds_before_ = total;
}

}  // namespace mlt
