#include "render/job.h"

#include "base/parallel.h"
#include "mlt_version.h"

#include <algorithm>
#include <cmath>

namespace mlt {
namespace {

/// A time budget alone still needs an end: more samples than any render will make.
constexpr double endless_spp = 1e9;

Budget with_default(Budget budget, const Scene& scene) {
  const auto check = [](const std::optional<double>& value, const char* name) {
    if (value && !(*value > 0 && std::isfinite(*value)))
      throw UsageError(std::string(name) + " must be a positive number");
  };
  check(budget.spp, "spp");
  check(budget.seconds, "time");
  if (!budget.spp && !budget.seconds)
    budget.spp = scene.sample_count() > 0 ? static_cast<double>(scene.sample_count()) : 64.0;
  return budget;
}

}  // namespace

Job::Job(ScenePtr scene, IntegratorPtr integrator, const RenderSettings& settings)
    : scene_(std::move(scene)), integrator_(std::move(integrator)), settings_(settings) {
  settings_.budget = with_default(settings.budget, *scene_);
  if (settings.threads < 0) throw UsageError("threads must not be negative; 0 means all");
  if (settings.threads == 0) settings_.threads = hardware_threads();
  rendering_ = integrator_->start(scene_, settings_.seed);
}

Job::~Job() {
  cancel();
  if (thread_.joinable()) thread_.join();
}

void Job::start() {
  if (phase_ != Phase::waiting) throw UsageError("the render has been started already");
  phase_ = Phase::bootstrap;
  started_ = Clock::now();
  thread_ = std::thread(&Job::run, this);
}

void Job::run() {
  std::exception_ptr failure;
  try {
    rendering_->prepare(settings_.threads, cancel_);
    bootstrap_seconds_ = seconds_since_start();
    if (!cancel_) {
      unit_count_ = rendering_->unit_count(settings_.budget.spp.value_or(endless_spp));
      phase_ = Phase::rendering;
      parallel_for(settings_.threads, settings_.threads, [this](uint64_t) { work(); });
    }
  } catch (...) {
    failure = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  failure_ = failure;
  total_seconds_ = seconds_since_start();
  phase_ = Phase::ended;
  ended_.notify_all();
}

void Job::work() {
  while (!cancel_ && !out_of_time()) {
    const uint64_t unit = next_unit_++;
    if (unit >= unit_count_) break;
    try {
      rendering_->run_unit(unit);
    } catch (...) {
      cancel();
      throw;
    }
    ++units_done_;
  }
}

bool Job::wait(double seconds) {
  std::unique_lock lock(mutex_);
  const auto has_ended = [this] { return phase_ == Phase::ended; };
  if (std::isfinite(seconds))
    ended_.wait_for(lock, std::chrono::duration<double>(seconds), has_ended);
  else
    ended_.wait(lock, has_ended);
  if (!has_ended()) return false;
  if (failure_) std::rethrow_exception(failure_);
  return true;
}

double Job::seconds_since_start() const {
  return std::chrono::duration<double>(Clock::now() - started_).count();
}

bool Job::out_of_time() const {
  return settings_.budget.seconds && seconds_since_start() >= *settings_.budget.seconds;
}

double Job::progress() const {
  if (phase_ == Phase::waiting) return 0;
  if (phase_ == Phase::ended) return 1;
  double done = 0;
  if (settings_.budget.spp && unit_count_ > 0)
    done = static_cast<double>(units_done_) / static_cast<double>(unit_count_);
  if (settings_.budget.seconds) done = std::max(done, seconds_since_start() / *settings_.budget.seconds);
  return std::min(1.0, done);
}

Image Job::image() const { return rendering_->image(); }

Stats Job::stats() const {
  Stats stats;
  stats.version = MLT_VERSION;
  stats.integrator = integrator_->name();
  stats.seed = settings_.seed;
  stats.width = scene_->camera().raster().size.x;
  stats.height = scene_->camera().raster().size.y;
  const Phase phase = phase_;
  if (phase == Phase::rendering || phase == Phase::ended) {
    stats.spp_done = rendering_->spp_done(units_done_);
    stats.seconds_bootstrap = bootstrap_seconds_;
    stats.seconds_render =
        (phase == Phase::ended ? total_seconds_.load() : seconds_since_start()) - bootstrap_seconds_;
    rendering_->add_stats(stats);
  }
  return stats;
}

}  // namespace mlt
