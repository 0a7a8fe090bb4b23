#include "integrator/piloted_rendering.h"

namespace mlt {

PilotedRendering::PilotedRendering(ScenePtr scene, uint64_t seed,
                                   const MetropolisSettings& settings,
                                   std::unique_ptr<MetropolisAlgorithm> algorithm, Alone alone,
                                   SeparateDirect direct)
    : Rendering(std::move(scene), seed),
      settings_(settings),
      algorithm_(std::move(algorithm)),
      alone_(std::move(alone)),
      direct_(std::move(direct)) {}

void PilotedRendering::prepare(int threads, const std::atomic<bool>& cancelled) {
  const Allocation allocation = run_pilot(threads, cancelled);
  if (cancelled) return;
  choose(allocation);
  chosen_->prepare(threads, cancelled);
  plan_ = chosen_->plan();
}

Allocation PilotedRendering::run_pilot(int threads, const std::atomic<bool>& cancelled) {
  const std::optional<double> wanted = settings_.independent_share;
  Allocation fixed;
  fixed.share = wanted.value_or(0);
  if (fixed.share == 1) return fixed;
  PilotSettings pilot;
  pilot.seed = seed_;
  pilot.threads = threads;
  pilot.coarse_samples = settings_.luminance_samples / 3;
  pilot.samples = settings_.luminance_samples / 6;
  const TargetMap coarse = coarse_image(*algorithm_, scene().camera().raster(), pilot, cancelled);
  algorithm_->prepare(coarse, seed_, threads, cancelled);
  return wanted == 0 ? fixed : allocate(*algorithm_, coarse, wanted, pilot, cancelled);
}

void PilotedRendering::choose(const Allocation& allocation) {
  allocation_ = allocation;
  if (allocation.share == 1)
    chosen_ = alone_();
  else
    chosen_ = std::make_unique<MetropolisRendering>(scene_, seed_, settings_, allocation,
                                                    std::move(algorithm_), std::move(direct_));
}

void PilotedRendering::add_stats(Stats& stats) const {
  stats.independent_share = allocation_.share;
  chosen_->add_stats(stats);
}

Replay PilotedRendering::replay(const Vec2i& pixel, uint64_t sample) {
  return chosen_ ? chosen_->replay(pixel, sample) : Rendering::replay(pixel, sample);
}

std::string PilotedRendering::save(const Task& task, Content content) const {
  ByteWriter bytes;
  bytes.write(allocation_);
  bytes.write(chosen_->save(task, content));
  return bytes.take();
}

void PilotedRendering::load(const std::string& state) {
  ByteReader bytes(state);
  const auto allocation = bytes.read<Allocation>();
  std::string chosen;
  bytes.read(chosen);
  bytes.finish();
  if (!chosen_) choose(allocation);
  chosen_->load(chosen);
  plan_ = chosen_->plan();
}

}  // namespace mlt
