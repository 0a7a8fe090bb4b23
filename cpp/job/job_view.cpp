// Functions of Job that read a render: while it goes on, and when it has ended.
#include "base/watchdog.h"
#include "job/empty_image.h"
#include "job/fireflies.h"
#include "job/job.h"
#include "mlt_version.h"
#include "rendering/alpha.h"

#include <fmt/format.h>

#include <cmath>

namespace mlt {

/// Throws in a fork: the locks of a running render may be held by threads that the fork lacks.
void Job::check_here() const {
  if (!ended() && elsewhere())
    throw RenderError("the render goes on in the process that started it, not in this fork of it");
}

bool Job::wait(double seconds) {
  check_here();
  std::unique_lock lock(mutex_);
  if (std::isfinite(seconds))
    ended_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return ended(); });
  else
    ended_.wait(lock, [this] { return ended(); });
  if (!ended()) return false;
  if (failure_) std::rethrow_exception(failure_);
  return true;
}

double Job::seconds_so_far() const {
  return seconds_before_ + std::chrono::duration<double>(Clock::now() - started_).count();
}

double Job::progress() const {
  if (phase_ == Phase::waiting) return 0;
  return ended() ? 1 : stop_rule_.progress(units_done_, seconds_so_far());
}

Image Job::image() const {
  check_here();
  const std::lock_guard lock(merging_);
  return rendering_->image();
}

Image Job::image_without_fireflies() const {
  check_here();
  const std::lock_guard lock(merging_);
  return without_fireflies(*rendering_);
}

std::optional<Halves> Job::halves(int layer) const {
  check_here();
  const std::lock_guard lock(merging_);
  return mlt::halves(*rendering_, layer);
}

std::shared_ptr<const ErrorEstimate> Job::error() const {
  check_here();
  const std::lock_guard no_merging(merging_);
  if (!ended()) return std::make_shared<ErrorEstimate>(estimate_error(*rendering_));
  const std::lock_guard lock(error_mutex_);
  if (!final_error_) final_error_ = std::make_shared<ErrorEstimate>(estimate_error(*rendering_));
  return final_error_;
}

std::vector<NamedImage> Job::first_surface_layers() const {
  std::vector<NamedImage> layers = render_aovs(*scene_, aovs_, seed_, threads_);
  for (NamedImage& layer : render_cryptomattes(*scene_, aovs_, names_, seed_, threads_))
    layers.push_back(std::move(layer));
  if (alpha_) layers.push_back({"alpha", render_alpha(scene_, hide_emitters_, seed_, threads_)});
  return layers;
}

std::vector<NamedImage> Job::light() const {
  check_here();
  const LightLayers* light = rendering_->light_layers();
  std::vector<NamedImage> lamps;
  const std::lock_guard lock(merging_);
  for (int i = 0; light && i < light->group_count(); ++i)
    lamps.push_back({light->names()[i], rendering_->image(i)});
  return lamps;
}

std::vector<NamedImage> Job::light_layers() const {
  const LightLayers* light = rendering_->light_layers();
  if (!light) return {};
  std::vector<NamedImage> layers;
  for (int i = 0; i < light->count(); ++i)
    layers.push_back({light->names()[i], rendering_->image(i)});
  for (int i = 0; i < light->group_count(); ++i)
    if (Image error = estimate_error(*rendering_, i).pixels; !error.empty())
      layers.push_back({"error." + light->names()[i], std::move(error)});
  return layers;
}

std::vector<NamedImage> Job::layers() const {
  check_here();
  std::vector<NamedImage> layers;
  {
    const std::lock_guard lock(merging_);
    layers = rendering_->layers();
    for (NamedImage& layer : light_layers()) layers.push_back(std::move(layer));
  }
  {
    const std::lock_guard lock(aov_mutex_);
    if (aov_layers_.empty()) aov_layers_ = first_surface_layers();
    layers.insert(layers.end(), aov_layers_.begin(), aov_layers_.end());
  }
  for (NamedImage& layer : error_layers(*error())) layers.push_back(std::move(layer));
  return layers;
}

double Job::spp_done() const {
  // a resumed render counts its earlier units once it has begun
  const Phase phase = phase_;
  const bool begun = phase == Phase::rendering || phase == Phase::ended;
  return begun ? rendering_->plan().spp_done(units_done_) : 0.0;
}

Stats Job::stats() const {
  check_here();
  Stats stats;
  stats.version = MLT_VERSION;
  stats.integrator = integrator_->name();
  stats.seed = seed_;
  if (const LightLayers* light = rendering_->light_layers())
    stats.light_groups = {light->names().begin(), light->names().begin() + light->group_count()};
  stats.width = scene_->camera().raster().size.x;
  stats.height = scene_->camera().raster().size.y;
  if (const size_t needed = bytes_needed(); available_ > 0 && needed > available_)
    stats.warnings.push_back(fmt::format("the render needs about {} of memory, and {} are free",
                                         in_words(needed), in_words(available_)));
  const Phase phase = phase_;
  if (phase == Phase::rendering || phase == Phase::ended) {
    stats.spp_done = spp_done();
    stats.seconds_bootstrap = bootstrap_seconds_;
    stats.seconds_render =
        (phase == Phase::ended ? total_seconds_.load() : seconds_so_far()) - bootstrap_seconds_;
    // A bootstrap that failed has left no statistics.
    if (prepared_ || phase != Phase::ended || !failure_) rendering_->add_stats(stats);
  }
  const std::lock_guard lock(mutex_);
  if (const std::string failure = autosave_.failure(); !failure.empty())
    stats.warnings.push_back("the checkpoint could not be written: " + failure);
  if (phase != Phase::ended || failure_) return stats;
  stats.ended_by = ended_by_;
  if (abandoned_)
    stats.warnings.push_back(fmt::format(
        "a light path had not ended {:g} s after the render was to end, and was given up; with a "
        "max_depth, or a smaller rr_depth, paths end",
        Watchdog::patience));
  if (units_done_ == 0) return stats;
  const std::shared_ptr<const ErrorEstimate> estimate = error();
  add_error(*estimate, stats);
  const auto pixels = static_cast<size_t>(stats.width) * stats.height;
  if (estimate->lit_pixels <= pixels / 1000)
    stats.warnings.push_back(fmt::format("{} of {} pixels have any light: {}", estimate->lit_pixels,
                                         pixels, cause_of_darkness(*scene_)));
  if (estimate->negative_pixels > 0 && !scene_->film().filter->has_negative_lobes() &&
      !scene_->camera().spectral())
    stats.warnings.push_back(
        fmt::format("{} pixels are negative, which no light is; please report it with the scene",
                    estimate->negative_pixels));
  return stats;
}

}  // namespace mlt
