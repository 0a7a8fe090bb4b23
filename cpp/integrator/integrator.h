// A light transport algorithm: settings that are only stored, and a way to start rendering.
#pragma once

#include "base/object.h"
#include "image/image.h"
#include "mutation/extra_mutation.h"
#include "path/inspect.h"
#include "render/stats.h"
#include "scene/scene.h"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace mlt {

struct NamedImage {
  std::string name;
  Image image;
};

/// What one of the independent groups of a render has seen by itself: an unbiased image that owes
/// nothing to the other groups. Linear RGB.
struct GroupImage {
  Image image;
  /// Its weight in the mean that is the render's image: finished passes, or 1 for a group of chains;
  /// 0 as long as it has nothing to say.
  double weight = 0;
  /// Metropolis: its own estimate of the mean of L*, by which its image is scaled, and the standard
  /// error of that.
  double b = 0, b_error = 0;
};

/// Some of the shares of a render: first, ..., last - 1.
struct Part {
  uint64_t first = 0, last = 0;
};

/// The units from, ..., to - 1 of some shares.
struct Work {
  Part part;
  uint64_t from = 0, to = 0;
};

/// A render in progress, cut into units that are fixed by (scene, algorithm, seed) and independent of
/// threads. Units are numbered 0, 1, 2, ... and started in that order; run_unit may be called from
/// many threads at once.
class Rendering {
 public:
  virtual ~Rendering() = default;

  /// Work before the first unit (a bootstrap); may itself use `threads` threads. `cancelled` is
  /// looked at now and then. Throws RenderError.
  virtual void prepare(int threads, const std::atomic<bool>& cancelled) = 0;

  /// How many units `spp` samples per pixel take.
  virtual uint64_t unit_count(double spp) const = 0;
  /// After each multiple of so many units no group has an unfinished share of the work.
  virtual uint64_t units_per_share() const = 0;
  /// Does nothing if the unit has been done already.
  virtual void run_unit(uint64_t unit) = 0;
  /// Samples per pixel after `units` units.
  virtual double spp_done(uint64_t units) const = 0;

  /// The image after the units that have finished, linear RGB.
  virtual Image image() const = 0;
  virtual void add_stats(Stats& stats) const = 0;
  /// Further images that the render was asked to keep.
  virtual std::vector<NamedImage> layers() const { return {}; }

  /// The groups whose spread tells how wrong the image is: each has its own random numbers, and for
  /// Metropolis its own share of the bootstrap. The image is their weighted mean (while a share is
  /// unfinished, nearly so), plus the image of what is rendered aside.
  virtual int group_count() const = 0;
  virtual GroupImage group(int index) const = 0;
  /// Light that is rendered apart by other means, with groups of its own; usually nullptr.
  virtual const Rendering* aside() const { return nullptr; }

  /// Repeats one sample of a pixel (0, 1, 2, ...), as it was or will be taken, without a trace in the
  /// image. Throws UsageError if the algorithm does not sample pixel by pixel.
  virtual Replay replay(const Vec2i& pixel, uint64_t sample);

  /// The whole state as bytes, and back: films, chains, random streams, bootstrap and counters. No
  /// unit may be running; 0 ... n - 1 have run, and perhaps some others. `load` is for a rendering that
  /// the same build made from the same scene, settings and seed; it takes the place of `prepare`, and
  /// going on with unit n makes the same pixels as if the render had never stopped. Throws
  /// RenderError if the bytes do not fit; the rendering is then of no use.
  virtual std::string save() const = 0;
  virtual void load(const std::string& bytes) = 0;

  // A render can be divided: each unit belongs to a share (a chain, a group of samples, a tile of the
  // image), and what the units of one share do depends on no other share. A copy of the rendering
  // that has not been prepared borrows what a piece of work needs, runs the units of its shares in
  // their order, and gives back what came of it; the owner then has the same bits as if it had run
  // them itself.

  /// Known after `prepare`.
  virtual uint64_t share_count() const = 0;
  virtual uint64_t share_of(uint64_t unit) const = 0;
  /// In so many successive units, counted from 0, most shares have something to do.
  virtual uint64_t units_per_step() const = 0;
  /// All shares, cut into `wanted` parts or as near to it as is sensible.
  virtual std::vector<Part> parts(int wanted) const = 0;
  virtual std::string lend(const Work& work) const = 0;
  virtual void borrow(const Work& work, const std::string& lent) = 0;
  virtual std::string give_back(const Work& work) const = 0;
  virtual void take_back(const Work& work, const std::string& given_back) = 0;
};

class Integrator : public Object {
 public:
  /// Throws SceneError if the scene has something that this algorithm cannot serve.
  virtual std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const = 0;
  const std::string& name() const { return type; }
  /// The same with more mutations in its mixture. Throws UsageError if it has no mixture.
  virtual std::shared_ptr<const Integrator> with_mutations(
      const std::vector<ExtraMutation>& extra) const;
};

using IntegratorPtr = std::shared_ptr<const Integrator>;

}  // namespace mlt
