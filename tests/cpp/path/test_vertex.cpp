// The terms of one vertex by plain products.
#include "path/vertex.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace mlt {
namespace {

/// Veach 1997, sec. 5.3: a shading normal multiplies f by |wl.ns| / |wl.ng|, for the direction on
/// the light side whichever way a walk goes.
TEST(VertexTerms, HaveTheCosinesOfTheLightSide) {
  const ScenePtr scene = test::load_scene(
      test::camera("0, 0, 3", "0, 0, 0", 40, test::film(4, 4)) + test::point_lamp +
      "<shape type='rectangle'><bsdf type='roughconductor'><float name='alpha' value='0.5'/>"
      "</bsdf></shape>");
  SurfacePoint at;
  ASSERT_TRUE(scene->intersect({{0.1, 0.2, 2}, {0, 0, -1}, 0}, at));
  at.shading = Frame::around(normalize(Vec3(0.3, -0.1, 1)));
  const Vec3 wl = normalize(Vec3(0.8, 0.1, 1)), wc = normalize(Vec3(-0.2, -0.4, 1));
  const VertexTerms terms = inner_terms(*scene, at, Lobe::smooth, wl, wc, false);
  const Scattering s = scene->bsdf(at).scattering(at, at.shading.to_local(wl),
                                                  at.shading.to_local(wc), Lobe::smooth);
  const auto quotient = [&](const Vec3& w) { return dot(w, at.shading.n) / dot(w, at.ng); };
  ASSERT_GT(std::abs(quotient(wl) - quotient(wc)), 0.1);
  EXPECT_NEAR(terms.f[1], s.f[1] * quotient(wl), 1e-12 * s.f[1]);
  EXPECT_NEAR(terms.pdf_from_light, s.pdf_from_light / wc.z, 1e-12 * s.pdf_from_light);
  EXPECT_NEAR(terms.pdf_from_camera, s.pdf_from_camera / wl.z, 1e-12 * s.pdf_from_camera);
}

}  // namespace
}  // namespace mlt
