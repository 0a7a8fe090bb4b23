// Samples whose light knows the layers that it belongs to.
#pragma once

#include "path/found_light.h"
#include "path/inspect.h"
#include "path/light_layers.h"

#include <utility>
#include <vector>

namespace mlt {

/// Takes samples with estimators that record paths (estimators.h); keeps its buffers.
class LayeredSample {
 public:
  /// Takes one, and calls found(FoundLight) for each of its paths, with the layers of that.
  template <class Estimator, class Sampler, class Found>
  void operator()(Estimator& estimator, const Vec2& raster, Sampler& sampler, RayCounts& rays,
                  LightLayers::Finder& finder, Found&& found) {
    found_.clear();
    paths_.clear();
    estimator.paths = &paths_;
    // A path is recorded after its light, unless that is black.
    estimator(raster, sampler, rays,
              [&](const FoundLight& light) { found_.push_back({light, paths_.size()}); });
    for (auto& [light, path] : found_) {
      if (path < paths_.size()) light.layers = finder.of(paths_[path].path);
      found(light);
    }
  }

 private:
  std::vector<std::pair<FoundLight, size_t>> found_;  ///< Light, and the place of its path.
  std::vector<FoundPath> paths_;
};

}  // namespace mlt
