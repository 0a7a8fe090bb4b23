// Materials that scatter light at many points together do it as they do at each of them.
#include <gtest/gtest.h>

#include "bsdf_testing.h"

namespace mlt {
namespace {

using namespace test;

/// Not a multiple of eight.
constexpr int points = 61;

struct Asked {
  std::vector<SurfacePoint> at = std::vector<SurfacePoint>(points, point());
  std::vector<Vec3> u;
  ScatteringLanes lanes;
};

/// None, any direction, or one in a narrow lobe about the mirrored one.
Vec3f light_direction(int i, const Vec3& wc, Rng& rng) {
  if (i % 5 == 0) return Vec3f(0);
  const Vec3 w = random_direction(rng);
  return Vec3f(i % 5 < 3 ? w : normalize(reflect(wc) + 0.03 * w));
}

Asked ask(uint64_t seed) {
  Asked asked;
  Rng rng(seed, Purpose::test, 0);
  asked.lanes.count = points;
  for (int i = 0; i < points; ++i) {
    const Vec3 u = random_u(rng);
    asked.u.push_back(u);
    asked.at[i].uv = {rng.next(), rng.next()};
    asked.lanes.at[i] = &asked.at[i];
    asked.lanes.wc.set(i, Vec3f(random_direction(rng)));
    asked.lanes.wl.set(i, light_direction(i, Vec3(asked.lanes.wc[i]), rng));
    asked.lanes.u_lobe[i] = static_cast<float>(u.x);
    asked.lanes.u_x[i] = static_cast<float>(u.y);
    asked.lanes.u_y[i] = static_cast<float>(u.z);
  }
  return asked;
}

void expect_close(double lane, double alone, const char* what) {
  EXPECT_NEAR(lane, alone, 2e-3 * std::abs(alone) + 1e-6) << what;
}
void expect_close(const Spectrum& lane, const Spectrum& alone, const char* what) {
  for (int k = 0; k < Spectrum::lanes; ++k) expect_close(lane[k], alone[k], what);
}

TEST(BsdfLanes, ScatterAsSinglePointsDo) {
  int served = 0;
  for (const Case& c : cases()) {
    if (!c.bsdf->supports_lanes()) continue;
    ++served;
    SCOPED_TRACE(c.label);
    const Bsdf& bsdf = *c.bsdf;
    EXPECT_FALSE(bsdf.has_delta() || bsdf.has_transmission() || bsdf.has_passage());
    int lit = 0, sampled = 0;
    for (uint64_t seed = 0; seed < 16; ++seed) {
      Asked asked = ask(seed);
      const ScatteringLanes before = asked.lanes;
      bsdf.scatter(asked.lanes);
      for (int i = 0; i < points; ++i) {
        const ScatteringLanes& x = asked.lanes;
        const Vec3 wc(before.wc[i]), wl(before.wl[i]), to(x.to[i]);
        const Scattering light = bsdf.scattering(asked.at[i], wl, wc, Lobe::smooth);
        expect_close(x.pdf_light[i], light.pdf_from_camera, "density of the light");
        expect_close(x.f_light[i], light.f, "light");
        lit += light.pdf_from_camera > 0;
        const auto alone = bsdf.sample(asked.at[i], wc, asked.u[i]);
        if (!alone || !(x.pdf[i] > 0)) {
          EXPECT_TRUE(!alone || alone->to.z * wc.z < 1e-3) << "only one of them has a direction";
          EXPECT_TRUE(!(x.pdf[i] > 0) || to.z * wc.z < 1e-3) << "only one of them has a direction";
          continue;
        }
        ++sampled;
        EXPECT_LT(length(to - alone->to), 2e-3);
        const Scattering next = bsdf.scattering(asked.at[i], to, wc, Lobe::smooth);
        expect_close(x.pdf[i], next.pdf_from_camera, "density of the sample");
        expect_close(x.f[i], next.f, "sample");
      }
    }
    EXPECT_GT(lit, 100);
    EXPECT_GT(sampled, 100);
  }
  EXPECT_GE(served, 18);
}

}  // namespace
}  // namespace mlt
