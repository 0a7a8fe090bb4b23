// A light transport algorithm: settings that are only stored, and a way to start rendering.
#pragma once

#include "base/object.h"
#include "base/schema.h"
#include "image/image.h"
#include "mutation/extra_mutation.h"
#include "path/inspect.h"
#include "path/light_layers.h"
#include "rendering/plan.h"
#include "rendering/stats.h"
#include "scene/scene.h"

#include <atomic>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace mlt {

struct NamedImage {
  std::string name;
  Image image;
};

/// One of the independent groups of a render.
struct GroupImage {
  /// What the mean owes to this group: from its spread over the groups the error follows. Linear
  /// RGB; where groups borrow light from each other (GroupEstimator) it may be negative.
  Image image;
  /// Its weight in the mean that is the render's image: finished passes, or 1 for a group of
  /// chains; 0 as long as it has no samples.
  double weight = 0;
  /// Metropolis: its own estimate of the mean of L*, by which its image is scaled, and the standard
  /// error of that.
  double b = 0, b_error = 0;
};

/// A render in progress, cut into units that are fixed by (scene, algorithm, seed) and independent
/// of threads. run_unit may be called from many threads at once.
class Rendering {
 public:
  /// The groups whose spread measures the error of the image: each has its own samples, and for
  /// Metropolis its own bootstrap. The image is their weighted mean (nearly so, while some are
  /// behind others), plus the images of the parts.
  static constexpr int group_count = 16;

  Rendering(ScenePtr scene, uint64_t seed) : scene_(std::move(scene)), seed_(seed) {}
  virtual ~Rendering() = default;

  /// Sets how many seconds prepare() should take, and at most four times as many; to be called
  /// before it.
  void limit_preparation(double seconds) { preparation_seconds_ = seconds; }
  /// Does the work before the first unit (a bootstrap), on up to `threads` threads. `cancelled` is
  /// checked now and then. Throws RenderError.
  virtual void prepare(int /*threads*/, const std::atomic<bool>& /*cancelled*/) {}
  /// The plan of the units, known after `prepare` or `load`.
  const Plan& plan() const { return plan_; }
  /// Memory for the sums of a render.
  struct Memory {
    size_t bytes = 0, to_come = 0;  ///< All of it, and the part that is not yet allocated.
  };
  virtual Memory memory(double spp) const = 0;
  /// Renders one unit; does nothing if the unit has been done already.
  virtual void run_unit(uint64_t unit) = 0;

  /// The layers of light that it keeps, or nullptr.
  const LightLayers* light_layers() const { return light_layers_.get(); }
  static constexpr int all_light = -1;

  /// The image after the units that have finished, linear RGB, or one of its layers of light. Where
  /// there are layers of lamps, the image is their sum.
  virtual Image image(int layer = all_light) const = 0;
  virtual GroupImage group(int index, int layer = all_light) const = 0;
  /// Whether the groups are blocks of one sequence in each pixel, and not independent.
  virtual bool groups_share_sequence() const { return false; }
  /// Renderings with groups of their own, whose images are parts of the image of this one.
  virtual std::vector<const Rendering*> parts() const { return {}; }
  /// The standard error that is common to all groups, which their spread does not include; may be
  /// empty.
  virtual Image common_error(int /*layer*/ = all_light) const { return {}; }
  /// Further images that the render was asked to keep.
  virtual std::vector<NamedImage> layers() const { return {}; }
  virtual void add_stats(Stats& stats) const = 0;
  /// Repeats one sample of a pixel (0, 1, 2, ...), as it was or will be taken, without adding it to
  /// the image. Throws UsageError if the algorithm does not sample pixel by pixel.
  virtual Replay replay(const Vec2i& pixel, uint64_t sample);

  /// Which content is saved. `task`: what the strands need to go on. `result`: the new state of the
  /// strands, and the sums over all copies of the rendering (counters, sums in fixed point).
  enum class Content : uint32_t { task, result, everything };
  /// The state of some strands as bytes. No unit of these may be running. A checkpoint has
  /// everything of all strands. A copy of the rendering that was not prepared can load what a task
  /// needs, run its units in their order, and save the result; the rendering that loads this has
  /// the same bits as if it had run the units itself.
  virtual std::string save(const Task& task = {}, Content content = Content::everything) const = 0;
  /// Replaces the state of the saved strands and adds the sums. Only for bytes that the same build
  /// has saved of a rendering of the same scene, settings and seed; for one that was just started
  /// it takes the place of `prepare`. Throws RenderError if the bytes do not fit.
  virtual void load(const std::string& state) = 0;

 protected:
  const Scene& scene() const { return *scene_; }
  /// A film's image in linear sRGB.
  Image shown(Image recorded) const;
  void keep_light_layers(const LightLayerSettings& settings);
  /// Whether this image is the sum of the layers of lamps.
  bool is_sum(int layer) const {
    return layer == all_light && light_layers_ && light_layers_->group_count() > 0;
  }
  Image sum_of_lamps() const;

  ScenePtr scene_;
  uint64_t seed_;
  Plan plan_;
  double preparation_seconds_ = std::numeric_limits<double>::infinity();
  std::unique_ptr<const LightLayers> light_layers_;
};

class Integrator : public Object {
 public:
  /// Starts a rendering. Throws SceneError if the algorithm does not support the scene.
  virtual std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const = 0;
  const std::string& name() const { return type; }
  /// A copy with more mutations in its mixture. Throws UsageError if it has no mixture.
  virtual std::shared_ptr<const Integrator> with_mutations(
      const std::vector<ExtraMutation>& extra) const;
};

using IntegratorPtr = std::shared_ptr<const Integrator>;

/// The schema of an integrator whose parameters come from several lists.
Schema integrator_schema(const std::string& name, const std::string& doc,
                         const std::vector<std::vector<Parameter>>& parameters);

}  // namespace mlt
