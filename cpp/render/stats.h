// What a render tells about itself (the schema of stats.json).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mlt {

struct MutationStats {
  std::string name;
  int length = 0;  ///< Path length in edges, or 0 where mutations do not know it.
  uint64_t proposed = 0, generated = 0, accepted = 0;
  double mean_acceptance = 0;
  double image_distance = 0;  ///< Mean move on the image per proposal, in pixels.
  uint64_t rays = 0;
  double weight = 0;     ///< With which it takes part in the choice at this length.
  double step_size = 0;  ///< Largest move on the image, as a share of its diagonal; 0: not a perturbation.
};

struct StuckChain {
  uint64_t chain = 0;
  uint64_t rejections = 0;
  double x = 0, y = 0;  ///< Raster position.
  std::string signature;
};

struct Stats {
  std::string version, integrator;
  uint64_t seed = 0;
  int width = 0, height = 0;
  double spp_done = 0;
  double seconds_load = 0, seconds_bootstrap = 0, seconds_render = 0;
  uint64_t rays_intersect = 0, rays_occluded = 0;
  double b = 0, b_error = 0;  ///< Mean of L* over the image and its standard error; Metropolis only.
  uint64_t invalid_samples = 0;
  std::vector<StuckChain> stuck;
  std::vector<MutationStats> mutations;
  std::vector<std::string> warnings;
};

std::string to_json(const Stats& stats);

}  // namespace mlt
