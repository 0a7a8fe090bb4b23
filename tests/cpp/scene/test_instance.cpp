#include "scene/accel/instance.h"

#include <fstream>

#include "scene/bsdf/bsdf_at.h"
#include "scene/same_points.h"

namespace mlt {
namespace {

using namespace test;
using shape_testing::error_of;
using shape_testing::expect_near;
using shape_testing::random_direction;
using shape_testing::random_point;
using testing::HasSubstr;

const std::string light =
    "<emitter type='point'><point name='position' x='0' y='3' z='3'/></emitter>";
const std::string lens = camera("0, 0, 6", "0, 0, 0", 40, film(32, 24));
const std::string tilt = "<rotate x='1' y='2' z='-1' angle='50'/>";
const std::string uneven = "<scale x='0.4' y='1.3' z='0.7'/>";
const std::string reversed = "<scale x='-1' y='1' z='1'/>";
const std::string shift = translate(0.3, -0.2, 0.4);
const std::string shiny = "<bsdf type='roughconductor'/>";

/// A sphere of vertex normals and texture coordinates, far from its own normals.
void write_textured_ball(const std::string& path) {
  std::ofstream out(path);
  constexpr int rows = 5, columns = 7;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const double u = 1.0 * i / columns, v = 1.0 * j / rows;
      const double theta = 0.2 + v * (pi - 0.4), phi = 2 * pi * u;
      const Vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta),
                   std::sin(theta) * std::sin(phi));
      out << "v " << n.x << " " << n.y << " " << n.z << "\nvt " << u << " " << v * v << "\nvn "
          << n.x << " " << n.y << " " << n.z << "\n";
    }
  const auto corner = [&](int i, int j) {
    const std::string index = std::to_string(j * (columns + 1) + i + 1);
    return " " + index + "/" + index + "/" + index;
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      out << "f" << corner(i, j) << corner(i + 1, j) << corner(i + 1, j + 1) << "\nf"
          << corner(i, j) << corner(i + 1, j + 1) << corner(i, j + 1) << "\n";
}

std::string obj(const std::string& path, const std::string& steps, const std::string& nested) {
  return "<shape type='obj'><string name='filename' value='" + path + "'/>" + to_world(steps) +
         nested + "</shape>\n";
}
std::string ball(const std::string& steps) {
  return "<shape type='sphere'>" + to_world(steps) + shiny + "</shape>\n";
}
std::string group(const std::string& shapes) {
  return "<shape type='shapegroup' id='group'>" + shapes + "</shape>\n";
}
std::string instance(const std::string& steps) {
  return "<shape type='instance'><ref id='group'/>" + to_world(steps) + "</shape>\n";
}

/// How what the same rays hit in two scenes scatters light.
void expect_same_scattering(const ScenePtr& a, const ScenePtr& b) {
  Rng rng(4, Purpose::test, 0);
  int hits = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 o = random_point(rng, 2);
    const Ray ray{o, normalize(0.3 * random_point(rng) - o)};
    SurfacePoint x, y;
    if (!a->intersect(ray, x) || !b->intersect(ray, y) || length(x.p - y.p) > 1e-4) continue;
    ++hits;
    const Vec3 wl = x.shading.to_world(normalize(Vec3(0.3, 0.2, 0.9))),
               wc = x.shading.to_world(normalize(Vec3(-0.1, -0.4, 0.8)));
    const auto value = [&](const Scene& scene, const SurfacePoint& at) {
      return BsdfAt(scene, at).scattering(wl, wc, Lobe::smooth).f.rgb();
    };
    expect_near(value(*a, x), value(*b, y), 1e-3);
  }
  EXPECT_GT(hits, 500);
}

TEST(Instance, HasTheBumpsOfTheShapeWrittenOut) {
  const TemporaryFile mesh("textured.obj");
  write_textured_ball(mesh.path());
  const std::string bumpy =
      "<bsdf type='bumpmap'><float name='scale' value='0.1'/><texture type='bitmap'><string "
      "name='filename' value='tests/scenes/waves.exr'/><boolean name='raw' value='true'/>"
      "</texture>" +
      white + "</bsdf>";
  for (const std::string& steps : {tilt + shift, scale(0.4) + tilt, uneven + tilt + shift})
    expect_same_scattering(
        load_scene(lens + light + group(obj(mesh.path(), "", bumpy)) + instance(steps)),
        load_scene(lens + light + obj(mesh.path(), steps, bumpy)));
}

TEST(Instance, HasTheAttributesOfTheMeshWrittenOut) {
  const TemporaryFile file("colours.ply");
  std::ofstream(file.path())
      << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
         "-1 -1 0 255 0 0\n1 -1 0.2 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n";
  const auto triangle = [&](const std::string& steps) {
    return "<shape type='ply'><string name='filename' value='" + file.path() + "'/>" +
           to_world(steps) +
           "<bsdf type='twosided'><bsdf type='diffuse'><texture type='mesh_attribute' "
           "name='reflectance'><string name='name' value='vertex_color'/></texture></bsdf></bsdf>"
           "</shape>\n";
  };
  for (const std::string& steps : {tilt + shift, uneven + tilt})
    expect_same_scattering(load_scene(lens + light + group(triangle("")) + instance(steps)),
                           load_scene(lens + light + triangle(steps)));
}

TEST(Instance, IsTheShapeWrittenOut) {
  const TemporaryFile file("textured.obj");
  write_textured_ball(file.path());
  for (const std::string& steps :
       {std::string(), tilt + shift, scale(0.3) + tilt, uneven + tilt + shift, tilt + uneven,
        reversed + tilt, uneven + reversed + shift, scale(1000) + tilt + scale(0.001) + shift})
    for (const std::string& material : {shiny, white}) {
      const std::string inner = translate(0.1, 0.2, 0);
      SCOPED_TRACE(steps + material);
      expect_same_points(
          load_scene(lens + light + group(obj(file.path(), inner, material)) + instance(steps)),
          load_scene(lens + light + obj(file.path(), inner + steps, material)));
      expect_same_points(load_scene(lens + light + group(cube(inner, material)) + instance(steps)),
                         load_scene(lens + light + cube(inner + steps, material)));
    }
}

TEST(Instance, OfAnalyticShapes) {
  for (const std::string& steps : {std::string(), tilt + shift, scale(0.3) + tilt + shift})
    for (const char* type : {"sphere", "disk", "cylinder"}) {
      SCOPED_TRACE(type + steps);
      const auto shape = [&](const std::string& all) {
        return "<shape type='" + std::string(type) + "'>" + to_world(all) + shiny + "</shape>\n";
      };
      expect_same_points(load_scene(lens + light + group(shape(tilt)) + instance(steps)),
                         load_scene(lens + light + shape(tilt + steps)));
    }
}

/// A sphere under an uneven transform is an ellipsoid, which no shape is.
TEST(Instance, MayMakeAnEllipsoidOfASphere) {
  const ScenePtr scene = load_scene(lens + light + group(ball("")) + instance(uneven));
  const Vec3 axes(0.4, 1.3, 0.7);
  Rng rng(4, Purpose::test, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 o = 3.0 * random_direction(rng);
    SurfacePoint at;
    ASSERT_TRUE(scene->intersect({o, normalize(0.2 * random_point(rng) - o)}, at));
    EXPECT_NEAR(length(at.p / axes), 1, 1e-14);
    expect_near(at.ng, normalize(at.p / (axes * axes)), 1e-14);
    EXPECT_NEAR(dot(at.shading.s, at.ng), 0, 1e-14);
  }
}

TEST(Instance, MayBeFarFromTheOriginOfItsGroup) {
  const std::string far = translate(2000, 0, 0), back = translate(-2000, 0, 0);
  const ScenePtr scene = load_scene(lens + light + group(cube(far, white)) + instance(back));
  Rng rng(5, Purpose::test, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 o = 5.0 * random_direction(rng);
    SurfacePoint at, next;
    ASSERT_TRUE(scene->intersect({o, normalize(0.2 * random_point(rng) - o)}, at));
    EXPECT_FALSE(scene->intersect(
        scene->spawn(at, normalize(at.ng + 0.9 * random_direction(rng)), 0), next));
  }
}

/// Whole scenes: the walls, the ball and the block in one group, twice.
struct Copies {
  std::string written_out, by_instances;
};
Copies two_rooms() {
  const std::string things = sphere(0.35, -0.6, 0.2, 0.4, white) + sphere(-0.4, 0, 0.1, 0.3, glass);
  const auto block = [](const std::string& steps) {
    return cube(scale(0.3) + rotate("y", 25) + translate(-0.4, -0.7, -0.3) + steps, red);
  };
  const std::string head = camera(in_front, "0, 0, 0", 40, film(32, 24)) + room() + ceiling_lamp();
  const std::string shrunk = scale(0.5) + translate(0.4, 0.4, 0.2), id;
  const std::string moved_things =
      "<shape type='sphere'><point name='center' x='0.35' y='-0.6' "
      "z='0.2'/><float name='radius' value='0.4'/>" +
      to_world(shrunk) + white + "</shape>" +
      "<shape type='sphere'><point name='center' x='-0.4' y='0' "
      "z='0.1'/><float name='radius' value='0.3'/>" +
      to_world(shrunk) + glass + "</shape>";
  return {head + things + block("") + moved_things + block(shrunk),
          head + group(things + block("")) + instance("") + instance(shrunk)};
}

TEST(Instance, GivesTheImageOfTheSceneWrittenOut) {
  const Copies copies = two_rooms();
  const ScenePtr a = load_scene(copies.written_out), b = load_scene(copies.by_instances);
  for (const char* name : {"path", "bdpt", "mlt"}) {
    Assignments settings{{"max_depth", "6"}};
    if (name == std::string("mlt"))
      for (const auto& [key, value] : Assignments{{"chains", "64"},
                                                  {"luminance_samples", "4000"},
                                                  {"adaptive", "false"},
                                                  {"independent_share", "0"},
                                                  {"two_stage", "false"}})
        settings.push_back({key, value});
    const Image x = rendered(a, integrator(name, settings), 1, 8)->image();
    const Image y = rendered(b, integrator(name, settings), 1, 8)->image();
    size_t same = 0;
    for (size_t i = 0; i < x.data.size(); ++i)
      same += std::abs(x.data[i] - y.data[i]) <= 1e-3f * (std::abs(x.data[i]) + 1e-3f);
    // One random decision among thousands may fall on the other side of a threshold.
    EXPECT_GT(same, 0.98 * static_cast<double>(x.data.size())) << name;
  }
}

TEST(Instance, KeepsOneCopyOfTheGroup) {
  const std::string torus = obj("tests/scenes/torus.obj", "", white);
  std::string many = lens + light + group(torus);
  for (int i = 0; i < 100; ++i) many += instance(translate(i, 0, 0));
  const ScenePtr one = load_scene(lens + light + torus);
  const ScenePtr hundred = load_scene(many);
  EXPECT_EQ(hundred->triangle_count(), one->triangle_count());
  EXPECT_EQ(hundred->bytes(), one->bytes());
}

TEST(Instance, AndGroupsRefuseWhatMakesNoSense) {
  const auto error = [](const std::string& content) {
    return error_of([&] { load_scene(lens + light + content); });
  };
  const std::string one = group(ball(""));
  EXPECT_THAT(error("<shape type='instance'/>"), HasSubstr("0 shape groups"));
  EXPECT_THAT(error(one + "<shape type='instance'><ref id='group'/><ref id='group'/></shape>"),
              HasSubstr("2 shape groups"));
  EXPECT_THAT(error(one + "<shape type='instance'><ref id='group'/>" + white + "</shape>"),
              HasSubstr("cannot have a bsdf"));
  EXPECT_THAT(
      error(one + "<shape type='instance'><ref id='group'/>" + area_light("1") + "</shape>"),
      HasSubstr("cannot have a emitter"));
  EXPECT_THAT(error(one + instance("<scale x='1' y='0' z='1'/>")), HasSubstr("singular"));
  EXPECT_THAT(error(group("")), HasSubstr("contains no shapes"));
  EXPECT_THAT(error(group(sphere(0, 0, 0, 1, area_light("1")))), HasSubstr("emits"));
  EXPECT_THAT(error(one + "<shape type='shapegroup'>" + instance("") + "</shape>"),
              HasSubstr("cannot be nested"));
  EXPECT_THAT(error("<shape type='shapegroup'>" + ball("") + group(ball("")) + "</shape>"),
              HasSubstr("cannot be nested"));
  EXPECT_THAT(error(one + "<shape type='shapegroup'><ref id='group'/></shape>"),
              HasSubstr("cannot be nested"));
}

}  // namespace
}  // namespace mlt
