// Path tracing along one ray, so that little but its techniques varies.
#pragma once

#include "harness/statistics.h"
#include "path/path_tracer.h"
#include "path/samplers.h"

namespace mlt::test {

/// The radiance of samples through the middle of a film of 8 x 6 pixels, a weighted sum of its
/// colours; `seed` is that of the random numbers.
inline Moments radiance_along_one_ray(const Scene& scene, const PathRules& rules, uint64_t seed,
                                      int samples) {
  Moments found;
  RayCounts rays;
  for (int i = 0; i < samples; ++i) {
    Rng rng(seed, Purpose::test, static_cast<uint64_t>(i));
    RandomSampler sampler(rng);
    const auto start = camera_ray(scene.camera(), Vec2(4, 3), sampler);
    const Color rgb = trace_path(scene, rules, start.ray, sampler, rays);
    found.add(rgb.x + 0.7 * rgb.y + 1.9 * rgb.z);
  }
  return found;
}

/// Expects the same mean with and without a technique, and less than this share of the variance.
inline void expect_same_mean(const Scene& scene, const PathRules& with, const PathRules& without,
                             int samples, double most_variance) {
  const Moments found = radiance_along_one_ray(scene, with, 1, samples),
                expected = radiance_along_one_ray(scene, without, 0, samples);
  EXPECT_GT(welch_t_test(found, expected).p_value, 1e-3)
      << found.mean() << " for " << expected.mean();
  EXPECT_LT(found.variance(), most_variance * expected.variance());
}

}  // namespace mlt::test
