// Light that is left to the independent samples: where most samples of a cell see a light
// directly, in a mirror or through glass, they have hardly any noise. Chains would go there often,
// since lights are bright, and some groups of chains more often than others.
#pragma once

#include "mutation/raster_cells.h"
#include "path/path_rules.h"
#include "scene/scene.h"

#include <atomic>
#include <limits>
#include <vector>

namespace mlt {

class CertainLight {
 public:
  /// Value of most_certain() where no path is left to the samples.
  static constexpr double no_bound = std::numeric_limits<double>::infinity();

  /// Traces about `walks` walks from the camera, four through each cell of the image. The result is
  /// the same for any number of threads.
  CertainLight(const Scene& scene, const PathRules& rules, uint64_t walks, uint64_t seed,
               int threads, const std::atomic<bool>& cancelled);
  /// Restores one made with `walks` from its cells(). Throws RenderError if their number differs.
  CertainLight(const Raster& raster, uint64_t walks, std::vector<uint8_t> cells);

  /// The certainty above which paths are left to the samples at this raster position.
  double most_certain(const Vec2& raster) const { return lit_[cells_.at(raster)] ? 0.5 : no_bound; }

  const std::vector<uint8_t>& cells() const { return lit_; }

 private:
  CertainLight(const Raster& raster, uint64_t walks);

  RasterCells cells_;
  /// Whether at least half of the walks through the cell or a neighbour saw a light.
  std::vector<uint8_t> lit_;
};

}  // namespace mlt
