#include "render/job.h"

#include "base/bytes.h"
#include "base/parallel.h"
#include "mlt_version.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mlt {
namespace {

/// A budget of time or error alone still needs an end: more samples than any render will make.
constexpr double endless_spp = 1e9;

/// The error is first looked at after this many samples per pixel, when at least eight groups have had
/// their share, and then whenever the work has grown by this factor: who peeks often stops too early.
constexpr double first_look_spp = 64, look_growth = 1.3;

Budget with_default(Budget budget, const Scene& scene) {
  const auto check = [](const std::optional<double>& value, const char* name) {
    if (value && !(*value > 0 && std::isfinite(*value)))
      throw UsageError(std::string(name) + " must be a positive number");
  };
  check(budget.spp, "spp");
  check(budget.seconds, "time");
  check(budget.error, "error");
  if (budget.empty())
    budget.spp = scene.sample_count() > 0 ? static_cast<double>(scene.sample_count()) : 64.0;
  return budget;
}

}  // namespace

Job::Job(ScenePtr scene, IntegratorPtr integrator, const RenderSettings& settings)
    : scene_(std::move(scene)),
      integrator_(std::move(integrator)),
      settings_(settings),
      default_budget_(settings.budget.empty()) {
  settings_.budget = with_default(settings.budget, *scene_);
  if (settings.threads < 0) throw UsageError("threads must not be negative; 0 means all");
  if (settings.threads == 0) settings_.threads = hardware_threads();
  if (const double every = settings.autosave.every; !(every > 0 && std::isfinite(every)))
    throw UsageError("every must be a positive number of seconds");
  rendering_ = integrator_->start(scene_, settings_.seed);
}

void Job::stop() {
  cancel();
  if (thread_.joinable()) thread_.join();
}

void Job::hire(std::unique_ptr<Crew> crew) {
  if (phase_ != Phase::waiting) throw UsageError("the render has been started already");
  crew_ = std::move(crew);
}

void Job::start() {
  if (phase_ != Phase::waiting) throw UsageError("the render has been started already");
  launch();
}

void Job::extend(const Budget& budget) {
  if (!ended()) throw UsageError("only a render that has ended can be extended");
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(failure_);
  if (!prepared_)
    throw UsageError("a render that was cancelled in its bootstrap cannot be extended");
  settings_.budget = with_default(budget, *scene_);
  cancel_ = false;
  seconds_before_ = total_seconds_;
  ended_by_.clear();
  final_error_ = nullptr;
  launch();
}

void Job::launch() {
  phase_ = prepared_ ? Phase::rendering : Phase::bootstrap;
  started_ = Clock::now();
  thread_ = std::thread(&Job::run, this);
}

// ---- the thread that leads the others ---------------------------------------------------------

void Job::run() {
  std::exception_ptr failure;
  try {
    if (!prepared_) {
      rendering_->prepare(settings_.threads, cancel_);
      bootstrap_seconds_ = seconds_so_far();
      prepared_ = !cancel_;
      next_autosave_ = Clock::now();
    }
    if (prepared_) render();
  } catch (...) {
    failure = std::current_exception();
  }
  try {
    if (crew_) crew_->dismiss();
    total_seconds_ = seconds_so_far();
    if (!failure && prepared_) autosave_at_end();
  } catch (...) {
    if (!failure) failure = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  failure_ = failure;
  if (ended_by_.empty()) ended_by_ = "cancel";
  phase_ = Phase::ended;
  ended_.notify_all();
  gate_.notify_all();
}

/// However long the chains become, b stays as wrong as the bootstrap has left it.
void Job::check_goal() const {
  const Budget& budget = settings_.budget;
  if (!budget.error || budget.spp || budget.seconds) return;
  Stats stats;
  rendering_->add_stats(stats);
  if (const double least = stats.b_error / stats.b; stats.b > 0 && least >= *budget.error)
    throw RenderError(fmt::format(
        "an error of {:g} cannot be reached, since the bootstrap leaves one of {:.2g}; give more "
        "luminance_samples, or a budget of spp or time as well",
        *budget.error, least));
}

void Job::render() {
  check_goal();
  unit_count_ = rendering_->unit_count(settings_.budget.spp.value_or(endless_spp));
  if (crew_) divide();
  phase_ = Phase::rendering;
  for (;;) {
    open_gate();
    if (autosave_due()) autosave();
    if (std::string why = why_to_end(); !why.empty()) {
      const std::lock_guard lock(mutex_);
      ended_by_ = std::move(why);
      return;
    }
    next_unit_ = units_done_.load();
    stop_at_ = unit_count_;
    if (settings_.budget.error) stop_at_ = std::min(stop_at_, next_look(units_done_));
    if (crew_)
      crew_->advance(*this, stop_at_);
    else
      parallel_for(settings_.threads, settings_.threads, [this](uint64_t) { work(); });
  }
}

void Job::divide() {
  if (division_)
    units_done_ = division_->done();  // in an earlier run, parts came to different ends
  division_.emplace(*rendering_, settings_.seed, crew_->wanted_parts(), units_done_);
}

void Job::fold(size_t part, const std::string& outcome) {
  const std::lock_guard lock(folding_);
  units_done_ += division_->fold(part, outcome);
}

std::string Job::why_to_end() {
  if (cancel_) return "cancel";
  if (const auto& goal = settings_.budget.error; goal && units_done_ > 0) {
    const uint64_t units = units_done_;
    if (units == next_look(units - 1)) {
      seen_error_ = estimate_error(*rendering_).relative;
      seen_units_ = units;
      if (seen_error_ <= *goal) return "error";
    }
  }
  if (units_done_ >= unit_count_) return "spp";
  return out_of_time() ? "time" : "";
}

/// After how many units the error is looked at next: after whole shares of the groups, fixed for each
/// render, so that a render that was interrupted ends where it would have ended.
uint64_t Job::next_look(uint64_t units) const {
  const uint64_t share = std::max<uint64_t>(1, rendering_->units_per_share());
  uint64_t shares = (rendering_->unit_count(first_look_spp) + share - 1) / share;
  while (shares * share <= units)
    shares = std::max(shares + 1,
                      static_cast<uint64_t>(std::ceil(look_growth * static_cast<double>(shares))));
  return shares * share;
}

/// Units are started in order and each one that was started is finished, so a stretch always ends
/// with the units 0 ... units_done_ - 1 done and no other begun.
void Job::work() {
  while (!interrupted()) {
    const uint64_t unit = next_unit_++;
    if (unit >= stop_at_) break;
    try {
      rendering_->run_unit(unit);
    } catch (...) {
      cancel();
      throw;
    }
    ++units_done_;
  }
}

// ---- saving -----------------------------------------------------------------------------------

/// Lets those in who wait to save the state.
void Job::open_gate() {
  if (savers_ == 0) return;
  std::unique_lock lock(mutex_);
  between_stretches_ = true;
  gate_.notify_all();
  gate_.wait(lock, [this] { return savers_ == 0; });
  between_stretches_ = false;
}

std::string Job::save() {
  std::unique_lock lock(mutex_);
  if (phase_ == Phase::waiting) throw UsageError("the render has not been started");
  struct Waiting {
    Job& job;
    explicit Waiting(Job& j) : job(j) { ++job.savers_; }
    ~Waiting() {
      --job.savers_;
      job.gate_.notify_all();
    }
  } waiting(*this);
  gate_.wait(lock, [this] { return between_stretches_ || phase_ == Phase::ended; });
  if (!prepared_ || failure_)
    throw UsageError("the render ended before there was anything to save");
  return state();
}

std::string Job::state() const {
  ByteWriter bytes;
  const Budget& budget = settings_.budget;
  for (const auto* limit : {&budget.spp, &budget.seconds, &budget.error}) bytes.write(*limit);
  bytes.write(division_ ? division_->done() : units_done_.load());
  bytes.write(bootstrap_seconds_.load());
  bytes.write(phase_ == Phase::ended ? total_seconds_.load() : seconds_so_far());
  bytes.write(rendering_->save());
  return bytes.take();
}

void Job::load(const std::string& state) {
  if (phase_ != Phase::waiting) throw UsageError("the render has been started already");
  ByteReader bytes(state);
  std::string rendering;
  Budget budget;
  for (auto* limit : {&budget.spp, &budget.seconds, &budget.error}) bytes.read(*limit);
  const auto units = bytes.read<uint64_t>();
  const auto bootstrap = bytes.read<double>(), total = bytes.read<double>();
  bytes.read(rendering);
  bytes.finish();
  rendering_->load(rendering);
  if (default_budget_) settings_.budget = with_default(budget, *scene_);
  prepared_ = true;
  units_done_ = units;
  units_autosaved_ = units;
  bootstrap_seconds_ = bootstrap;
  total_seconds_ = seconds_before_ = total;
  next_autosave_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(settings_.autosave.every));
}

bool Job::autosave_due() const {
  return settings_.autosave.write && Clock::now() >= next_autosave_;
}

/// The state is taken now; it is written while the render goes on.
void Job::autosave() {
  next_autosave_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(settings_.autosave.every));
  const bool still_writing =
      writer_.valid() && writer_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
  if (still_writing || units_autosaved_ == units_done_) return;
  units_autosaved_ = units_done_;
  writer_ = std::async(std::launch::async,
                       [this, bytes = state()]() mutable { try_to_write(std::move(bytes)); });
}

void Job::autosave_at_end() {
  if (!settings_.autosave.write) return;
  if (writer_.valid()) writer_.wait();
  const bool failed = !autosave_failure_.empty();
  if (failed || units_autosaved_ != units_done_) try_to_write(state());
  units_autosaved_ = units_done_;
}

void Job::try_to_write(std::string state) {
  std::string failure;
  try {
    settings_.autosave.write(std::move(state));
  } catch (const std::exception& error) {
    failure = error.what();
  }
  const std::lock_guard lock(mutex_);
  autosave_failure_ = failure;
}

// ---- looking at it ----------------------------------------------------------------------------

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

double Job::seconds_so_far() const {
  return seconds_before_ + std::chrono::duration<double>(Clock::now() - started_).count();
}

bool Job::out_of_time() const {
  return settings_.budget.seconds && seconds_so_far() >= *settings_.budget.seconds;
}

double Job::progress() const {
  if (phase_ == Phase::waiting) return 0;
  if (phase_ == Phase::ended) return 1;
  double done = 0;
  const Budget& budget = settings_.budget;
  if (budget.spp && unit_count_ > 0)
    done = static_cast<double>(units_done_) / static_cast<double>(unit_count_);
  if (budget.seconds) done = std::max(done, seconds_so_far() / *budget.seconds);
  // The squared error falls as 1 / n.
  if (const double seen = seen_error_; budget.error && seen > 0)
    done = std::max(done, std::pow(*budget.error / seen, 2) * static_cast<double>(units_done_) /
                              static_cast<double>(seen_units_));
  return std::min(1.0, done);
}

Image Job::image() const {
  const std::lock_guard lock(folding_);
  return rendering_->image();
}

std::shared_ptr<const ErrorEstimate> Job::error() const {
  const std::lock_guard no_folding(folding_);
  if (!ended()) return std::make_shared<ErrorEstimate>(estimate_error(*rendering_));
  const std::lock_guard lock(error_mutex_);
  if (!final_error_) final_error_ = std::make_shared<ErrorEstimate>(estimate_error(*rendering_));
  return final_error_;
}

std::vector<NamedImage> Job::layers() const {
  std::vector<NamedImage> layers;
  {
    const std::lock_guard lock(folding_);
    layers = rendering_->layers();
  }
  for (NamedImage& layer : error_layers(*error())) layers.push_back(std::move(layer));
  return layers;
}

double Job::spp_done() const {
  // A render that is taken up again counts what it has once it has begun.
  const Phase phase = phase_;
  const bool begun = phase == Phase::rendering || phase == Phase::ended;
  return begun ? rendering_->spp_done(units_done_) : 0.0;
}

Stats Job::stats() const {
  Stats stats;
  stats.version = MLT_VERSION;
  stats.integrator = integrator_->name();
  stats.seed = settings_.seed;
  stats.width = scene_->camera().raster().size.x;
  stats.height = scene_->camera().raster().size.y;
  const Phase phase = phase_;
  if (phase == Phase::rendering || phase == Phase::ended) {
    stats.spp_done = spp_done();
    stats.seconds_bootstrap = bootstrap_seconds_;
    stats.seconds_render =
        (phase == Phase::ended ? total_seconds_.load() : seconds_so_far()) - bootstrap_seconds_;
    rendering_->add_stats(stats);
  }
  const std::lock_guard lock(mutex_);
  if (!autosave_failure_.empty())
    stats.warnings.push_back("the checkpoint could not be written: " + autosave_failure_);
  if (phase == Phase::ended && !failure_) {
    stats.ended_by = ended_by_;
    add_error(stats);
  }
  return stats;
}

void Job::add_error(Stats& stats) const {
  if (units_done_ == 0) {
    if (stats.ended_by == "time") stats.warnings.push_back("the time was used up by the bootstrap");
    return;
  }
  constexpr size_t most = 10;
  const std::shared_ptr<const ErrorEstimate> estimate = error();
  stats.groups = estimate->groups;
  stats.error = estimate->relative;
  stats.block_error = estimate->relative_blocks;
  const std::vector<Disagreement>& disagreements = estimate->disagreements;
  if (disagreements.empty()) return;
  for (const Disagreement& d : disagreements)
    if (stats.disagreements.size() < most)
      stats.disagreements.push_back({d.pixel.x, d.pixel.y, d.share});
  const Disagreement& first = disagreements.front();
  stats.warnings.push_back(fmt::format(
      "in {} of {} blocks of 8 x 8 pixels one of {} independent groups has found most of the "
      "light, the "
      "brightest at pixel ({}, {}); there neither the image nor its error is to be believed yet",
      disagreements.size(), estimate->block_count(), estimate->groups, first.pixel.x,
      first.pixel.y));
}

}  // namespace mlt
