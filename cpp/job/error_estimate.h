// The error of an image, estimated from the spread of the groups that it is the mean of: with
// weights w_g, the standard error of the mean m is sqrt(sum_g w_g (x_g - m)^2 / ((G - 1) sum_g
// w_g)). Chains of one group are correlated with each other and with themselves; groups are not, so
// this holds for Metropolis as it does for path tracing.
#pragma once

#include "math/vec.h"
#include "rendering/integrator.h"

#include <limits>
#include <optional>
#include <vector>

namespace mlt {

/// A block of the image whose light one group alone has found, or nearly so: neither the image
/// nor its error estimate is reliable there.
struct Disagreement {
  Vec2i pixel{0};    ///< Upper left pixel of the block.
  double share = 0;  ///< Share of the block's light that one group has found, the largest such.
};

/// The error sqrt(mean over pixels of s^2 / (L^2 + 0.01 M^2)), with a pixel's standard error s, its
/// brightness L as far as the groups agree about it (known_brightness), and the mean M of the
/// brightness over the image. It is an estimate of the square root of relMSE; 0.01 M^2 keeps black
/// pixels from deciding it.
struct RelativeError {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN if nothing is known.
  /// How many pixels carry it: (sum of their terms)^2 / (sum of the terms' squares). With few,
  /// rarely found light decides it, and as long as that is not found the error seems too small.
  double carrying = std::numeric_limits<double>::quiet_NaN();
};

struct ErrorEstimate {
  static constexpr int block_size = 8;

  int groups = 0;  ///< Groups that have an image; with fewer than two nothing is known.
  Image pixels;    ///< Standard error of each pixel, RGB; empty if nothing is known.
  Image blocks;    ///< Standard error of the means of blocks of 8 x 8 pixels, a pixel for each.
  RelativeError relative, relative_blocks;  ///< Errors of pixels, and of block means.
  size_t negative_pixels = 0;               ///< Pixels with a channel below zero.
  size_t lit_pixels = 0;                    ///< Pixels with a channel above zero.
  std::vector<Disagreement> disagreements;  ///< In order of brightness, the brightest first.
  int block_count() const { return blocks.width * blocks.height; }
};

/// Estimates the error of the image, or of one of its layers of light, group by group; costs about
/// as much as developing the image once for each.
ErrorEstimate estimate_error(const Rendering& rendering, int layer = Rendering::all_light);

/// An image of a rendering: that of all its light, or of one of its layers.
struct ImageOf {
  const Rendering* rendering;
  int layer = Rendering::all_light;
  float factor = 1;  ///< By which the image before a change is multiplied.
};

/// The error of the change from one image, times its factor, to another of the same size, relative
/// to the second one, by renderings with the same algorithm: from group to group, so that what both
/// have in common by their random numbers counts for nothing. The errors that are common to all
/// groups count as if they were independent.
RelativeError error_of_change(const ImageOf& before, const ImageOf& after);

/// The estimate as layers of the image: "error" for pixels and "error_block", where each pixel has
/// the error of its block. None if nothing is known.
std::vector<NamedImage> error_layers(const ErrorEstimate& estimate);

/// Adds the estimate to the statistics, with a warning of disagreements.
void add_error(const ErrorEstimate& estimate, Stats& stats);

}  // namespace mlt
