// Statistics of a render.
#pragma once

#include <cstdint>
#include <limits>
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
  /// Proposals given up since a manifold walk failed, or the walk back did.
  uint64_t failed_walks = 0, failed_returns = 0;
  double weight = 0;  ///< Its weight in the choice of mutations at this length.
  /// Largest move on the image, as a fraction of its diagonal; 0: not a perturbation.
  double step_size = 0;
};

struct StuckChain {
  uint64_t chain = 0;
  uint64_t rejections = 0;
  double x = 0, y = 0;  ///< Raster position.
  std::string signature;
};

/// A block of pixels where one independent group has found most of the light.
struct DisagreementStats {
  int x = 0, y = 0;  ///< Its upper left pixel.
  double share = 0;  ///< Share of the block's light that this group has found.
};

struct Stats {
  std::string version, integrator;
  uint64_t seed = 0;
  int width = 0, height = 0;
  double spp_done = 0;
  double seconds_load = 0, seconds_bootstrap = 0, seconds_render = 0;
  uint64_t rays_intersect = 0, rays_occluded = 0;
  std::string ended_by;  ///< "spp", "time", "error" or "cancel"; "" while it runs.
  int groups = 0;        ///< Independent groups that the error is estimated from.
  /// Estimated relative error of the image and of its 8 x 8 block means; NaN (null) if not known.
  double error = std::numeric_limits<double>::quiet_NaN();
  double block_error = std::numeric_limits<double>::quiet_NaN();
  /// How many pixels carry the error; see RelativeError.
  double pixels_carrying_error = std::numeric_limits<double>::quiet_NaN();
  std::vector<DisagreementStats> disagreements;  ///< The brightest blocks first, ten at the most.
  /// Mean of L* over the image and its standard error; Metropolis only.
  double b = 0, b_error = 0;
  /// Share of the time for samples that are independent of the chains. Metropolis only. Below: how
  /// many samples b was estimated from, and how many of the highest weight carry half of it.
  double independent_share = 0;
  std::string independent;  ///< Name of these samples in mlt: "bdpt" or "path".
  /// By how much, relatively, the brightness of the image may be wrong; NaN (null) if not known.
  double level_error = std::numeric_limits<double>::quiet_NaN();
  uint64_t independent_samples = 0, samples_carrying_half = 0;
  /// Tours that have ended, the mutations of the longest, and the share of the light that waiting
  /// tours have yet to bring, see StepsInPixels; mlt and erpt only.
  uint64_t tours = 0, longest_tour = 0;
  double tours_waiting = 0;
  uint64_t invalid_samples = 0;
  std::vector<std::string> light_groups;  ///< Layers of lamps, which add up to the image.
  std::vector<StuckChain> stuck;
  std::vector<MutationStats> mutations;
  std::vector<std::string> warnings;
};

}  // namespace mlt
