// The tangents along u and v of every shape, and bump maps, which need them.
#include <gtest/gtest.h>

#include <fstream>

#include "base/rng.h"
#include "image/image_io.h"
#include "scene/bsdf/bsdf_at.h"
#include "scene/mesh/mesh.h"
#include "scenes.h"

namespace mlt {
namespace {

using namespace test;

const std::string view = camera(in_front, "0, 0, 0", 40, film(4, 3)) + sky;

Vec3 random_u(Rng& rng) {
  const double x = rng.next(), y = rng.next();
  return {x, y, rng.next()};
}

Vec3 random_direction(Rng& rng) {
  const double z = 2 * rng.next() - 1, phi = 2 * pi * rng.next(), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// An affine map that suits every shape: turned, moved, and larger.
const std::string moved = to_world(scale(1.5) + rotate("y", 30) + translate(0.3, -0.2, 0.1));

TEST(UvTangents, AreHowThePositionChanges) {
  TemporaryFile file("quad.obj");
  std::ofstream(file.path()) << "v 0 0 0\nv 2 0 0\nv 2 1 0\nvt 0.1 0.9\nvt 0.4 0.2\nvt 0.9 0.8\n"
                                "f 1/1 2/2 3/3\n";
  for (const std::string& shape :
       {"<shape type='sphere'>" + moved, "<shape type='cylinder'>" + moved,
        "<shape type='disk'>" + moved, "<shape type='rectangle'>" + moved,
        "<shape type='cube'>" + moved,
        "<shape type='obj'><string name='filename' value='" + file.path() + "'/>" + moved}) {
    SCOPED_TRACE(shape);
    const ScenePtr scene = load_scene(view + shape + area_light("1") + "</shape>");
    const Shape& s = *scene->shapes()[0];
    Rng rng(1, Purpose::test, 0);
    for (int i = 0; i < 100; ++i) {
      const double x = 0.05 + 0.9 * rng.next(), y = 0.05 + 0.9 * rng.next();
      const SurfacePoint a = s.sample_position({x, y}).at;
      for (const Vec2& step : {Vec2(1e-6, 0), Vec2(0, 1e-6)}) {
        const SurfacePoint b = s.sample_position(Vec2(x, y) + step).at;
        if (a.primitive != b.primitive) continue;
        const auto [du, dv] = s.uv_tangents(a);
        const Vec2 d = b.uv - a.uv;
        const double moved_by = length(b.p - a.p);
        EXPECT_LT(length(du * d.x + dv * d.y - (b.p - a.p)), 1e-3 * moved_by + 1e-9);
      }
    }
  }
}

/// Heights that rise by `a` and `b` along the sides of a rectangle of 3 x 3.
std::string slope(const std::string& path, double a, double b) {
  Image image(2, 2, 1);
  // From the centre of one texel to that of the next it is half a side.
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) image.at(x, y, 0) = static_cast<float>(1 + 0.5 * (a * x + b * y));
  write_image(path, image);
  return "<texture type='bitmap' name='any'><string name='filename' value='" + path +
         "'/></texture>";
}

TEST(BumpMap, BendsNormalsAsTheirImageWould) {
  const TemporaryFile file("slope.exr");
  const double a = 1.25, b = -0.5, k = 2;  // the scale of the bump map
  const Vec3 n = normalize(Vec3(-k * a / 3, -k * b / 3, 1));
  const Vec3 colour = 0.5 * (n + Vec3(1));
  const std::string rgb =
      std::to_string(colour.x) + " " + std::to_string(colour.y) + " " + std::to_string(colour.z);
  const std::string nested = "<bsdf type='plastic'/></bsdf>";
  const auto load = [&](const std::string& bsdf) {
    return load_scene(view + rectangle(scale(1.5) + rotate("x", 20), bsdf + nested));
  };
  const ScenePtr bumps =
      load("<bsdf type='bumpmap'><float name='scale' value='2'/>" + slope(file.path(), a, b));
  const ScenePtr normals =
      load("<bsdf type='normalmap'><rgb name='normalmap' value='" + rgb + "'/>");
  SurfacePoint at;
  ASSERT_TRUE(bumps->intersect({{0.1, 0.2, 5}, {0, 0, -1}, 0}, at));
  Rng rng(3, Purpose::test, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 wl = random_direction(rng), wc = random_direction(rng), u = random_u(rng);
    const Scattering x = bumps->bsdf(at).scattering(at, wl, wc, Lobe::smooth);
    const Scattering y = normals->bsdf(at).scattering(at, wl, wc, Lobe::smooth);
    EXPECT_LT(length((x.f - y.f).rgb()), 1e-4 * (1 + length(y.f.rgb())));
    EXPECT_NEAR(x.pdf_from_light, y.pdf_from_light, 1e-5);
    const auto s = bumps->bsdf(at).sample(at, wc, u), t = normals->bsdf(at).sample(at, wc, u);
    if (s && t) {
      EXPECT_LT(length(s->to - t->to), 1e-4);
    }
  }
  const Vec3 w = normalize(Vec3(0.1, 0.2, 1));
  EXPECT_LT(length(bumps->bsdf(at).delta_normal(at, w) - n), 1e-5);
  EXPECT_TRUE(bumps->bsdf(at).bends_normal());
}

/// The mirrored direction is sent back with the cosines against the bent normal (Veach 1997, sec.
/// 5.3), from both sides of a surface.
TEST(BumpMap, MirrorsAreThoseOfTheBentNormalOnEitherSide) {
  const std::string mirror_bent =
      "<bsdf type='twosided'><bsdf type='normalmap'><rgb name='normalmap' value='0.7 0.5 0.9'/>" +
      mirror + "</bsdf></bsdf>";
  const ScenePtr scene = load_scene(view + rectangle("", mirror_bent));
  SurfacePoint at;
  ASSERT_TRUE(scene->intersect({{0.1, 0.2, 5}, {0, 0, -1}, 0}, at));
  const Bsdf& bsdf = scene->bsdf(at);
  for (const double z : {0.9, -0.9}) {
    const Vec3 from = normalize(Vec3(0.1, 0.2, z));
    const auto s = bsdf.sample(at, from, Vec3(0.5));
    ASSERT_TRUE(s);
    const Vec3 n = bsdf.delta_normal(at, from);
    EXPECT_LT(length(reflect(from, n) - s->to), 1e-12);
    const WorldScattering w =
        BsdfAt(*scene, at)
            .scattering(at.shading.to_world(from), at.shading.to_world(s->to), Lobe::reflection);
    EXPECT_NEAR(std::abs(w.cos_l), std::abs(w.cos_c), 1e-12);
    EXPECT_NEAR(std::abs(w.cos_l), std::abs(dot(from, n)), 1e-12);
  }
}

TEST(BumpMap, RefusesTwoMirrorsAtOnePoint) {
  const std::string bent =
      "<bsdf type='normalmap'><rgb name='normalmap' value='0.7 0.5 0.9'/>" + mirror + "</bsdf>";
  for (const std::string& both : {"<bsdf type='blendbsdf'>" + bent + mirror + "</bsdf>",
                                  "<bsdf type='coating'>" + bent + "</bsdf>"})
    EXPECT_THROW(
        load_string("<scene>" + view + rectangle("", both) + "</scene>", "", plugins(), {}),
        SceneError);
}

TEST(MeshAttributes, AreTextures) {
  const TemporaryFile file("colours.ply");
  std::ofstream(file.path())
      << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
         "element face 1\nproperty list uchar int vertex_indices\nproperty float weight_0\n"
         "end_header\n-1 -1 0 255 0 0\n1 -1 0 0 255 0\n1 1 0 0 0 255\n-1 1 0 255 255 255\n"
         "4 0 1 2 3 0.25\n";
  const auto scene_with = [&](const std::string& name) {
    return load_string("<scene>" + view + "<shape type='ply'><string name='filename' value='" +
                           file.path() + "'/><bsdf type='diffuse'><texture type='mesh_attribute' " +
                           "name='reflectance'><string name='name' value='" + name +
                           "'/></texture></bsdf></shape></scene>",
                       "", plugins(), {})
        .scene;
  };
  const auto albedo = [&](const ScenePtr& scene, double x, double y) {
    SurfacePoint at;
    EXPECT_TRUE(scene->intersect({{x, y, 5}, {0, 0, -1}, 0}, at));
    return scene->bsdf(at).albedo(at).rgb();
  };
  const ScenePtr colours = scene_with("vertex_color"), weights = scene_with("face_weight");
  EXPECT_LT(length(albedo(colours, 0.5, -0.5) - Color(0.25, 0.5, 0.25)), 1e-6);
  EXPECT_LT(length(albedo(colours, -0.5, 0.5) - Color(0.75, 0.5, 0.75)), 1e-6);
  EXPECT_EQ(albedo(weights, 0.5, -0.5), Color(0.25));
  EXPECT_EQ(albedo(weights, -0.5, 0.5), Color(0.25));
  EXPECT_THROW(scene_with("vertex_colour"), SceneError);
  EXPECT_THROW(scene_with("colour"), SceneError);
}

}  // namespace
}  // namespace mlt
