// Whether the same rays hit the same surfaces in two scenes.
#pragma once

#include "integrator_testing.h"
#include "scene/shape_testing.h"

namespace mlt::test {

/// What the same rays hit in two scenes, which hold the same surfaces; in the first one at a time.
inline void expect_same_points(const ScenePtr& a, const ScenePtr& b, double time = 0) {
  using shape_testing::expect_near;
  Rng rng(3, Purpose::test, 0);
  int hits = 0, differences = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 o = shape_testing::random_point(rng, 2);
    const Ray ray{o,
                  i % 2 ? shape_testing::random_direction(rng)
                        : normalize(0.3 * shape_testing::random_point(rng) - o),
                  time};
    SurfacePoint x, y;
    const bool hit_a = a->intersect(ray, x), hit_b = b->intersect(ray, y);
    if (hit_a != hit_b || (hit_a && length(x.p - y.p) > 1e-4)) {
      ++differences;  // at an edge
      continue;
    }
    if (!hit_a) continue;
    ++hits;
    EXPECT_EQ(x.time, time);
    expect_near(x.p, y.p, 4e-6);
    expect_near(x.ng, y.ng, 2e-6);
    expect_near(x.shading.n, y.shading.n, 2e-6);
    EXPECT_LE(length(x.uv - y.uv), 1e-5);
    // The axes turn as fast as the uvs where those are crowded.
    expect_near(x.shading.s, y.shading.s, 1e-4);
    expect_near(x.shading.t, y.shading.t, 1e-4);
    EXPECT_EQ(a->bsdf(x).type, b->bsdf(y).type);
    // Rays leave both sides of it.
    for (const double side : {1.0, -1.0}) {
      const Vec3 w = normalize(side * x.ng + 0.5 * shape_testing::random_direction(rng));
      SurfacePoint next;
      if (a->intersect(a->spawn(x, w, time), next)) {
        EXPECT_GT(length(next.p - x.p), 1e-5);
      }
    }
  }
  EXPECT_GT(hits, 500);
  EXPECT_LT(differences, 20);
}

}  // namespace mlt::test
