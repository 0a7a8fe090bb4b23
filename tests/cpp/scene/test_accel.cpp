#include "scene/accel/accel.h"

#include "scene/bsdf/bsdf_testing.h"
#include "scene/shape/cylinder.h"
#include "scene/shape/disk.h"
#include "scene/shape/sphere.h"
#include "scene/shape_testing.h"

namespace mlt {
namespace {

using namespace shape_testing;

const Location here{"scene.xml", 3};

/// Spheres, cylinders and disks of sizes from 0.01 to 1, every other one along the axes.
std::vector<ShapePtr> random_shapes(int count, Rng& rng) {
  std::vector<ShapePtr> shapes;
  for (int i = 0; i < count; ++i) {
    const Vec3 p = random_point(rng, 2);
    const double size = std::pow(10.0, -2 * rng.next());
    const Frame f = Frame::around(i % 2 ? random_direction(rng) : Vec3(0, 0, 1));
    const Mat4 m(Vec4(f.s * size, 0), Vec4(f.t * size, 0), Vec4(f.n * size, 0), Vec4(p, 1));
    if (i % 3 == 0) shapes.push_back(std::make_shared<Sphere>(Vec3(0), 1, m, false, here));
    if (i % 3 == 1) shapes.push_back(std::make_shared<Disk>(m, false, here));
    if (i % 3 == 2) shapes.push_back(std::make_shared<Cylinder>(p, f, size, 0.5 * size, false));
  }
  return shapes;
}

TEST(Accel, FindsAnalyticShapesAsTheirEquationsDo) {
  Rng rng(1, Purpose::test, 0);
  const std::vector<ShapePtr> shapes = random_shapes(60, rng);
  const Accel accel(shapes);
  int hits = 0, differences = 0;
  constexpr int rays = 20000;
  for (int i = 0; i < rays; ++i) {
    const Ray ray{random_point(rng, 3), random_direction(rng)};
    std::optional<Hit> nearest;
    for (uint32_t s = 0; s < shapes.size(); ++s)
      if (const auto t = shapes[s]->as_analytic()->intersect(ray.o, ray.d, 0, infinity))
        if (!nearest || *t < nearest->t) nearest = Hit{*t, s, 0, 0, 0};
    Hit hit;
    const bool found = accel.intersect(ray, hit);
    hits += nearest.has_value();
    const bool same = found == nearest.has_value() &&
                      (!found || (hit.shape == nearest->shape &&
                                  hit.t == static_cast<double>(static_cast<float>(nearest->t))));
    differences += !same;
    EXPECT_EQ(accel.occluded(ray).blocked, found);
    if (found) {
      EXPECT_FALSE(accel.occluded({ray.o, ray.d, 0, 0.999 * hit.t}).blocked);
    }
  }
  EXPECT_GT(hits, rays / 20);
  // The accelerator's boxes are in single precision: rays that touch their edges may slip through.
  EXPECT_LE(differences, 2);
}

TEST(Accel, KnowsWhatRaysPass) {
  Rng rng(3, Purpose::test, 0);
  const std::vector<ShapePtr> shapes = random_shapes(60, rng);
  for (size_t s = 0; s < shapes.size(); ++s)
    shapes[s]->set_bsdf(test::make_bsdf(s % 2 == 0 ? "diffuse" : "null"));
  const Accel accel(shapes);
  int blocked = 0, passed = 0;
  for (int i = 0; i < 5000; ++i) {
    const Ray ray{random_point(rng, 3), random_direction(rng)};
    bool meets[2] = {};
    for (size_t s = 0; s < shapes.size(); ++s)
      meets[s % 2] |= shapes[s]->as_analytic()->intersect(ray.o, ray.d, 0, infinity).has_value();
    RayPacket packet;
    packet.add(ray);
    packet.add(ray);
    const Occlusion one = accel.occluded(ray), two = accel.occluded(packet);
    EXPECT_EQ(one.blocked, meets[0]);
    EXPECT_EQ(two.blocked, meets[0] ? 3u : 0u);
    if (!meets[0]) {
      EXPECT_EQ(one.passed, meets[1]);
      EXPECT_EQ(two.passed, meets[1] ? 3u : 0u);
    }
    blocked += meets[0];
    passed += meets[1] && !meets[0];
  }
  EXPECT_GT(blocked, 100);
  EXPECT_GT(passed, 100);
}

TEST(Accel, FindsTheSameInPackets) {
  Rng rng(2, Purpose::test, 0);
  const std::vector<ShapePtr> shapes = random_shapes(60, rng);
  const Accel accel(shapes);
  int hits = 0;
  for (int n = 0; n < 2000; ++n) {
    std::vector<Ray> rays;
    RayPacket packet;
    for (int i = 0; i < 1 + n % RayPacket::size; ++i) {
      rays.push_back({random_point(rng, 3), random_direction(rng), 0, 5});
      packet.add(rays.back());
    }
    std::vector<const Ray*> pointers;
    for (const Ray& ray : rays) pointers.push_back(&ray);
    PacketHits found;
    accel.intersect(packet, pointers.data(), n % 2 == 0, found);
    const unsigned blocked = accel.occluded(packet).blocked;
    for (size_t i = 0; i < rays.size(); ++i) {
      Hit hit;
      const bool one = accel.intersect(rays[i], hit);
      hits += one;
      ASSERT_EQ(found.shape[i], one ? hit.shape : SurfacePoint::no_shape);
      if (one) {
        EXPECT_NEAR(found.t[i], hit.t, 1e-5 * hit.t);
      }
      EXPECT_EQ(blocked >> i & 1, unsigned{one});
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(Accel, TakesNoRayThatWouldEndTheProcess) {
  Rng rng(3, Purpose::test, 0);
  const Accel accel(random_shapes(60, rng));
  const double nan = std::nan("");
  for (const double x : {nan, infinity, 1e19, -1e30}) {
    const Ray spoilt[] = {{Vec3(0, x, 0), Vec3(0, 0, 1)},
                          {Vec3(0, 0, 0), Vec3(0, x, 1)},
                          {Vec3(0, 0, 0), Vec3(0, 0, 1), 0, nan}};
    for (const Ray& ray : spoilt) {
      Hit hit;
      EXPECT_FALSE(accel.intersect(ray, hit));
      EXPECT_EQ(accel.occluded(ray).blocked, 1u);
      RayPacket packet;
      packet.add(ray);
      packet.add(ray);
      const Ray* exact[] = {&ray, &ray};
      PacketHits found;
      accel.intersect(packet, exact, false, found);
      EXPECT_EQ(found.shape[1], SurfacePoint::no_shape);
      EXPECT_EQ(accel.occluded(packet).blocked, 3u);
    }
  }
}

}  // namespace
}  // namespace mlt
