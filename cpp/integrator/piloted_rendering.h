// A Metropolis render that begins with a pilot, which may find that independent samples alone are
// best: the render then is that of another integrator.
#pragma once

#include "integrator/metropolis_rendering.h"

#include <functional>

namespace mlt {

class PilotedRendering : public Rendering {
 public:
  /// What renders with independent samples alone.
  using Alone = std::function<std::unique_ptr<Rendering>()>;

  PilotedRendering(ScenePtr scene, uint64_t seed, const MetropolisSettings& settings,
                   std::unique_ptr<MetropolisAlgorithm> algorithm, Alone alone,
                   SeparateDirect direct = {});

  void prepare(int threads, const std::atomic<bool>& cancelled) override;
  void run_unit(uint64_t unit) override { chosen_->run_unit(unit); }
  Image image() const override { return chosen_->image(); }
  GroupImage group(int index) const override { return chosen_->group(index); }
  const Rendering* separate_direct() const override { return chosen_->separate_direct(); }
  std::vector<NamedImage> layers() const override { return chosen_->layers(); }
  void add_stats(Stats& stats) const override;
  Replay replay(const Vec2i& pixel, uint64_t sample) override;
  std::string save(const Task& task, Content content) const override;
  void load(const std::string& state) override;

 private:
  Allocation run_pilot(int threads, const std::atomic<bool>& cancelled);
  void choose(const Allocation& allocation);

  MetropolisSettings settings_;
  std::unique_ptr<MetropolisAlgorithm> algorithm_;
  Alone alone_;
  SeparateDirect direct_;
  Allocation allocation_;
  std::unique_ptr<Rendering> chosen_;
};

}  // namespace mlt
