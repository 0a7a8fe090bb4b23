#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "scene/shape_testing.h"

namespace mlt {

#define MLT_PLUGIN(family, name) Plugin family##_##name();
#include "scene/shape/list.inc"
#undef MLT_PLUGIN

namespace {

using namespace shape_testing;

using testing::HasSubstr;

const Plugin& plugin(const std::string& name) {
  static const Registry registry = [] {
    Registry made;
#define MLT_PLUGIN(family, name) made.add(family##_##name());
#include "scene/shape/list.inc"
#undef MLT_PLUGIN
    return made;
  }();
  return registry.find("shape", name, {});
}

std::shared_ptr<Shape> make(const std::string& name, const std::map<std::string, Value>& given) {
  return make_shape(plugin(name), given);
}

/// A file that exists as long as the object.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& content)
      : path(testing::TempDir() + std::to_string(::getpid()) + name) {
    std::ofstream(path, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }

  const std::string path;
};

const std::string bent_quad =
    "v -1 -1 0\nv 1 -1 0.25\nv 1 1 0\nv -1 1 0.5\n"
    "vt 0 0\nvt 1 0\nvt 1 0.5\nvt 0 0.75\nf 1/1 2/2 3/3 4/4\n";

/// Rotates, mirrors, scales by 1.5 and moves.
const Matrix mirroring{0, 0, -1.5, -0.5, 0.9, 1.2, 0, -0.25, -1.2, 0.9, 0, 0.125, 0, 0, 0, 1};

/// What Mitsuba 3.9.1 (scalar_rgb) finds along a ray from `from` to `to`.
struct Reference {
  const char* shape;
  bool mirrored;  ///< to_world = mirroring, flip_normals = true
  Vec3 from, to, p, n, s;
  Vec2 uv;
};

const std::vector<Reference>& references() {
  // clang-format off
  static const std::vector<Reference> list{
    {"rectangle", false, {-1.6, -2.65, -0.5}, {-0.39, -0.8, 0}, {-0.39, -0.8000001, 0}, {0, 0, 1}, {1, 0, 0}, {0.305, 0.09999997}},
    {"rectangle", false, {-1.11, -1.57, 1.5}, {0.9, 0.27, 0}, {0.8999999, 0.2699997, 0}, {0, 0, 1}, {1, 0, 0}, {0.9499999, 0.6349998}},
    {"rectangle", false, {-1.92, 3.2, 0.41}, {0.62, -0.19, 0}, {0.62, -0.1900001, 0}, {0, 0, 1}, {1, 0, 0}, {0.81, 0.405}},
    {"rectangle", true, {-1.26, -0.98, -1.43}, {-0.5, 0.2, 1.23}, {-0.5, 0.2, 1.23}, {1, 0, 0}, {0, 0.6000001, -0.8000001}, {0.2953332, 0.8410001}},
    {"rectangle", true, {0.82, 1.66, -3.29}, {-0.5, 1.19, -0.13}, {-0.5, 1.19, -0.1300004}, {1, 0, 0}, {0, 0.6000001, -0.8000001}, {0.8560001, 0.8329999}},
    {"rectangle", true, {-2.58, 0.04, -0.08}, {-0.5, -0.99, -0.22}, {-0.5, -0.9899999, -0.2199999}, {1, 0, 0}, {0, 0.6, -0.8000001}, {0.444, 0.2336667}},
    {"cube", false, {-2.18, -2.71, 0.45}, {0.36, -0.09, 0.48}, {-0.5222137, -0.9999999, 0.4695803}, {0, -1, 0}, {0, 0, 1}, {0.7347901, 0.2388931}},
    {"cube", false, {-4, 0.54, -2.2}, {0.01, 0.01, -0.43}, {-1, 0.1434913, -0.8758106}, {-1, 0, 0}, {0, 1, 0}, {0.5717456, 0.06209469}},
    {"cube", false, {-0.47, -0.51, 1.92}, {0.62, -0.24, 0.73}, {0.3726891, -0.3012605, 1}, {0, 0, 1}, {0, 1, 0}, {0.3493698, 0.6863445}},
    {"cube", true, {-0.66, -1.68, 2.9}, {-0.92, -0.15, 1.08}, {-0.8328223, -0.6630076, 1.690244}, {0, 0.6, -0.8000001}, {0, 0.8000001, 0.6}, {0.7029135, 0.6109408}},
    {"cube", true, {1.69, 1.68, -1.21}, {-0.97, -0.87, -0.82}, {0.6415964, 0.6749511, -1.056287}, {0, -0.6, 0.8000001}, {0, 0.8000001, 0.6}, {0.5103963, 0.8805321}},
    {"cube", true, {0.38, -0.04, 1.22}, {-1.22, -0.98, 0.61}, {-2, -1.43825, 0.3126249}, {1, 0, 0}, {0, 0.8000001, 0.6}, {0.2206583, 0.2123166}},
    {"sphere", false, {0.21, -1.73, 1.79}, {0.79, 0.89, 0.36}, {0.624634, 0.1430019, 0.7677127}, {0.624634, 0.1430019, 0.7677127}, {-0.2231635, 0.974781, 0}, {0.03581921, 0.2213948}},
    {"sphere", false, {1.93, -0.72, -1.94}, {0.63, -0.18, 0.09}, {0.8982673, -0.2914342, -0.3289101}, {0.8982673, -0.2914342, -0.3289101}, {0.3086046, 0.9511905, -6.60799e-09}, {0.950069, 0.6066813}},
    {"sphere", false, {-2.54, 1.23, -2.39}, {-0.18, -0.9, -0.13}, {-0.6592625, -0.4674451, -0.5889551}, {-0.6592625, -0.4674451, -0.5889551}, {0.5784024, -0.8157516, 1.382649e-08}, {0.5981618, 0.7004604}},
    {"sphere", true, {-0.7, 0.53, -0.93}, {-1.3, -0.17, 1.63}, {-1.249997, -0.111663, 1.416653}, {-0.4999978, 0.09222465, 0.861102}, {-1.095386e-08, -0.9943137, 0.1064917}, {0.3806027, 0.3333341}},
    {"sphere", true, {0.32, -0.76, 0.2}, {0.46, -0.15, 0.23}, {0.6543049, 0.696614, 0.2716368}, {0.7695366, 0.631076, 0.09775785}, {2.286277e-08, -0.1530809, 0.9882137}, {0.1720434, 0.7795128}},
    {"sphere", true, {-1.27, -1.99, 0.1}, {-0.91, -0.38, 0.09}, {-1.179845, -1.586807, 0.0974957}, {-0.4532301, -0.891205, -0.0183362}, {-6.431144e-09, 0.02057027, -0.9997884}, {0.6508577, 0.3502717}},
    {"obj", false, {3.75, -2.43, 0.52}, {-0.18, 0.17, 0}, {0.4003792, -0.213966, 0.07679314}, {0.004296821, -0.004296821, 0.9999816}, {0.9999907, 0.0005558591, -0.004294479}, {0.7001896, 0.8034915}},
    {"obj", false, {-0.03, 0.87, -1.06}, {-0.89, -0.83, 0}, {-0.9001574, -0.8500786, 0.01251971}, {0.06516314, -0.06516314, 0.9957447}, {0.9508098, 0.3068957, -0.04213878}, {0.04992129, 0.9562598}},
    {"obj", false, {1.74, 0.92, 0.98}, {-0.51, 0.18, 0}, {-0.2240884, 0.2740333, 0.1245304}, {0.1049403, -0.1049403, 0.9889262}, {0.9501317, 0.3042238, -0.06854079}, {0.3879558, 0.6192265}},
    {"obj", true, {1.42, -1.84, -0.68}, {-0.5, 0.66, 0.2}, {-0.5926429, 0.7806285, 0.2424613}, {-0.9931486, -0.01652626, -0.1156838}, {0.0536866, 0.8147677, -0.5772965}, {0.6748027, 0.5699558}},
    {"obj", true, {1.25, -1.85, -2.3}, {-0.5, -0.07, 0.17}, {-0.5543787, -0.01468877, 0.2467518}, {-0.9945719, -0.0147152, -0.1030063}, {0.04768996, 0.8153851, -0.5769514}, {0.5145951, 0.6883238}},
    {"obj", true, {-3.36, 3.9, 1.83}, {-0.5, -0.64, -0.75}, {-0.6360065, -0.4241016, -0.6273085}, {-0.9999641, 0.001197109, 0.008379765}, {-0.005989932, 0.5994195, -0.8004125}, {0.6657953, 0.8484444}},
  };
  // clang-format on
  return list;
}

TEST(ShapePlugins, AgreeWithMitsuba3) {
  const TemporaryFile file("bent.obj", bent_quad);
  for (const Reference& r : references()) {
    SCOPED_TRACE(std::string(r.shape) + (r.mirrored ? " mirrored" : ""));
    std::map<std::string, Value> given;
    if (r.shape == std::string("obj")) given["filename"] = file.path;
    if (r.mirrored) given.insert({{"to_world", mirroring}, {"flip_normals", true}});
    const auto shape = make(r.shape, given);
    const auto at = trace(*shape, {r.from, normalize(r.to - r.from)});
    ASSERT_TRUE(at.has_value());
    expect_near(at->p, r.p, 1e-5);  // Mitsuba computes in single precision.
    expect_near(at->shading.n, r.n, 1e-5);
    expect_near(at->shading.s, r.s, 1e-5);
    EXPECT_NEAR(at->uv.x, r.uv.x, 1e-5);
    EXPECT_NEAR(at->uv.y, r.uv.y, 1e-5);
    EXPECT_GT(dot(at->ng, at->shading.n), 0);
  }
}

TEST(ShapePlugins, CubeIsClosedAndFacesOutward) {
  const auto cube = make("cube", {{"to_world", mirroring}});
  Rng rng(1, Purpose::test, 0);
  const Vec3 center(-0.5, -0.25, 0.125);
  EXPECT_NEAR(cube->area(), 24 * 2.25, 1e-5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 d = random_direction(rng);
    const auto at = trace(*cube, {center, d});
    ASSERT_TRUE(at.has_value());
    EXPECT_GT(dot(at->ng, d), 0);
  }
}

std::string ply_header(const std::string& vertex_properties) {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\n" +
         vertex_properties + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
}

TEST(ShapePlugins, PlyAndObjAgree) {
  const TemporaryFile obj("quad.obj", bent_quad);
  const TemporaryFile ply("quad.ply", ply_header("property float u\nproperty float v\n") +
                                          "-1 -1 0 0 0\n1 -1 0.25 1 0\n1 1 0 1 0.5\n"
                                          "-1 1 0.5 0 0.75\n4 0 1 2 3\n");
  const Ray ray{{0.3, 0.4, 5}, {0, 0, -1}};
  const auto a = trace(*make("obj", {{"filename", obj.path}}), ray);
  const auto b = trace(*make("ply", {{"filename", ply.path}}), ray);
  const auto c = trace(*make("ply", {{"filename", ply.path}, {"flip_tex_coords", true}}), ray);
  expect_near(a->p, b->p, 0);
  expect_near(a->shading.n, b->shading.n, 0);
  EXPECT_EQ(a->uv.y, c->uv.y);  // OBJ turns textures upside down by default, PLY does not.
  EXPECT_NEAR(a->uv.y, 1 - b->uv.y, 1e-7);
}

TEST(ShapePlugins, FileNormalsAreUsedUnlessFaceNormalsIsSet) {
  const TemporaryFile ply(
      "n.ply", ply_header("property float nx\nproperty float ny\nproperty float nz\n") +
                   "-1 -1 0 1 0 1\n1 -1 0 1 0 1\n1 1 0 1 0 1\n-1 1 0 1 0 1\n4 0 1 2 3\n");
  const Ray ray{{0.3, 0.4, 5}, {0, 0, -1}};
  const auto smooth = trace(*make("ply", {{"filename", ply.path}}), ray);
  const auto flat = trace(*make("ply", {{"filename", ply.path}, {"face_normals", true}}), ray);
  expect_near(smooth->shading.n, normalize(Vec3(1, 0, 1)), 1e-7);
  expect_near(flat->shading.n, {0, 0, 1}, 0);
}

TEST(ShapePlugins, ErrorsNameTheFile) {
  const auto error = [](const std::string& type, const std::map<std::string, Value>& given) {
    return error_of([&] { make(type, given); });
  };
  EXPECT_EQ(error("obj", {{"filename", std::string("/nowhere/x.obj")}}),
            "scene.xml:7: /nowhere/x.obj: there is no such file");
  EXPECT_THAT(error("ply", {{"filename", testing::TempDir()}}), HasSubstr("cannot read"));
  const TemporaryFile empty("empty.obj", "");
  EXPECT_THAT(error("obj", {{"filename", empty.path}}), HasSubstr("the file has no faces"));
  EXPECT_THAT(error("obj", {}), HasSubstr("needs 'filename'"));
  EXPECT_THAT(error("obj", {{"filename", std::string("a.fbx")}}),
              HasSubstr("'filename' names a .fbx file, which is not read as a mesh"));
  const TemporaryFile nan("nan.obj", "v nan 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  EXPECT_EQ(error("obj", {{"filename", nan.path}}),
            nan.path +
                ":1: the position of a vertex that a face uses is not finite (in single "
                "precision)");
  const TemporaryFile good("good.obj", bent_quad);
  EXPECT_THAT(error("obj", {{"filename", good.path}, {"to_world", Matrix{}}}),
              HasSubstr("scene.xml:7: 'to_world' is singular"));
  EXPECT_THAT(error("rectangle", {{"to_world", Matrix{}}}), HasSubstr("singular"));
  EXPECT_THAT(error("obj", {{"filename", good.path}, {"smooth_angle", 30.0}}),
              HasSubstr("unknown parameter 'smooth_angle'"));
  EXPECT_THAT(
      error("obj", {{"filename", good.path}, {"max_smooth_angle", 30.0}, {"face_normals", true}}),
      HasSubstr("exclude each other"));
}

TEST(ShapePlugins, AllTakeAMaterialAndALight) {
  for (const char* name :
       {"cube", "cylinder", "disk", "obj", "ply", "rectangle", "serialized", "sphere"})
    for (const char* nested : {"bsdf", "emitter"}) {
      const Parameter* parameter = plugin(name).schema.find(nested);
      ASSERT_NE(parameter, nullptr) << name;
      EXPECT_EQ(parameter->type, ParamType::object);
    }
}

std::filesystem::path shared_scenes() {
  const char* given = std::getenv("PYMLT_SHARED");
  return std::filesystem::path(given ? given : "../shared") / "scenes";
}

TEST(ShapePlugins, ReadTheMeshesOfRealScenes) {
  if (!std::filesystem::is_directory(shared_scenes()))
    GTEST_SKIP() << "no scenes in " << shared_scenes() << "; set PYMLT_SHARED";
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_scenes())) {
    const std::string extension = entry.path().extension();
    if (extension != ".obj" && extension != ".ply" && extension != ".serialized") continue;
    SCOPED_TRACE(entry.path());
    const auto shape = make(extension.substr(1), {{"filename", entry.path().string()}});
    EXPECT_GT(shape->area(), 0);
    ++files;
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace mlt
