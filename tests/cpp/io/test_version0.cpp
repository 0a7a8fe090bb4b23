// What files of Mitsuba 0.6 leave out has the value that it has there, and that of Mitsuba 3 in
// files of Mitsuba 3.
#include "io/version0.h"

#include "io/load.h"
#include "job/plugins.h"
#include "math/wavelengths.h"
#include "scene/mesh/mesh.h"
#include "scene_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace mlt {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

LoadedScene load(const std::string& version, const std::string& content,
                 const std::string& directory = "") {
  return load_string("<scene version='" + version +
                         "'>\n<sensor type='perspective'/><emitter type='constant'/>\n" + content +
                         "</scene>",
                     directory, plugins(), {});
}
LoadedScene load_06(const std::string& content) { return load("0.6.0", content); }
LoadedScene load_3(const std::string& content) { return load("3.0.0", content); }

Color rgb(const Spectrum& found) { return recorded(found, rgb_lanes); }

std::string sphere(const std::string& content) {
  return "<shape type='sphere'>" + content + "</shape>";
}
const Shape& first_shape(const LoadedScene& loaded) { return *loaded.scene->shapes().at(0); }
Color albedo(const LoadedScene& loaded) {
  return rgb(first_shape(loaded).bsdf().albedo(SurfacePoint()));
}
MediumCoefficients medium(const LoadedScene& loaded) {
  return first_shape(loaded).media().interior->at(Vec3(0.5), -1);
}

void expect_near(const Color& found, const Color& wanted, double error = 1e-3) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], wanted[i], error * (1 + wanted[i])) << i;
}
void expect_medium(const LoadedScene& loaded, const Color& scattering, const Color& absorption) {
  const MediumCoefficients found = medium(loaded);
  expect_near(rgb(found.scattering), scattering);
  expect_near(rgb(found.extinction), scattering + absorption);
}

TEST(Version0, ConductorsAreOfCopper) {
  for (const std::string type : {"conductor", "roughconductor"}) {
    const std::string content = sphere("<bsdf type='" + type + "'/>");
    const std::string of_copper =
        sphere("<bsdf type='" + type + "'><string name='material' value='Cu'/></bsdf>");
    expect_near(albedo(load_06(content)), albedo(load_3(of_copper)), 1e-12);
    expect_near(albedo(load_3(content)), Color(1));
    expect_near(albedo(load_06(sphere("<bsdf type='" + type +
                                      "'><string name='material' value='none'/></bsdf>"))),
                Color(1));
  }
}

TEST(Version0, BoundariesOfMediaAreInvisible) {
  const std::string by_value = "<medium type='homogeneous' name='interior'/>";
  const std::string by_reference = "<ref id='fog' name='exterior'/>";
  const std::string fog = "<medium type='homogeneous' id='fog'/>";
  EXPECT_EQ(first_shape(load_06(sphere(by_value))).bsdf().type, "null");
  EXPECT_EQ(first_shape(load_06(sphere(by_reference) + fog)).bsdf().type, "null");
  EXPECT_EQ(first_shape(load_3(sphere(by_value))).bsdf().type, "diffuse");
  EXPECT_EQ(first_shape(load_06(sphere(by_value + "<bsdf type='dielectric'/>"))).bsdf().type,
            "dielectric");
  EXPECT_EQ(first_shape(load_06(sphere(by_value + "<ref id='glass'/>") +
                                "<bsdf type='dielectric' id='glass'/>"))
                .bsdf()
                .type,
            "dielectric");
  EXPECT_EQ(first_shape(load_06(sphere(by_value + "<emitter type='area'/>"))).bsdf().type,
            "diffuse");
  EXPECT_EQ(first_shape(load_06(sphere(""))).bsdf().type, "diffuse");
}

std::string homogeneous(const std::string& content) {
  return sphere("<bsdf type='null'/><medium type='homogeneous' name='interior'>" + content +
                "</medium>");
}

TEST(Version0, PresetsOfMediaAreTimesAHundred) {
  expect_medium(load_06(homogeneous("")), {74, 88, 101}, {3.2, 17, 48});
  expect_medium(load_06(homogeneous("<float name='scale' value='0.5'/>")), {37, 44, 50.5},
                {1.6, 8.5, 24});
  // sigma_s (1 - g), by hand.
  const std::string milk = homogeneous("<string name='material' value='Regular Milk'/>");
  expect_medium(load_06(milk), {455.13, 582.94236, 713.59662}, {0.153, 0.46, 1.993});
  const std::string in_3 = homogeneous("<string name='material' value='regular milk'/>");
  expect_medium(load_3(in_3), {4.5513, 5.8294236, 7.1359662}, {0.00153, 0.0046, 0.01993});
  expect_medium(load_3(homogeneous("")), Color(0.75), Color(0.25));
}

TEST(Version0, CoefficientsThatAreMissingAreThoseOfSkin) {
  expect_medium(load_06(homogeneous("<rgb name='sigmaS' value='1'/>")), Color(1), {3.2, 17, 48});
  expect_medium(load_06(homogeneous("<rgb name='sigmaA' value='1'/>")), {74, 88, 101}, Color(1));
  expect_medium(load_06(homogeneous("<rgb name='albedo' value='0'/>")), Color(0), {77.2, 105, 149});
  expect_medium(load_06(homogeneous("<rgb name='sigmaT' value='1'/>")),
                {74 / 77.2, 88. / 105, 101. / 149}, {3.2 / 77.2, 17. / 105, 48. / 149});
  expect_medium(
      load_06(homogeneous("<rgb name='sigmaT' value='2'/><rgb name='albedo' value='.5'/>")),
      Color(1), Color(1));
}

TEST(Version0, TheGridOfAMediumIsItsDensity) {
  const std::string volumes =
      "<volume name='density' type='volcache'><volume type='constvolume'><float name='value' "
      "value='3'/></volume></volume><volume name='albedo' type='constvolume'><float name='value' "
      "value='0.25'/></volume>";
  const LoadedScene loaded =
      load_06(sphere("<bsdf type='null'/><medium type='heterogeneous' name='interior'><string "
                     "name='method' value='woodcock'/><float name='scale' value='2'/>" +
                     volumes + "</medium>"));
  EXPECT_THAT(loaded.warnings, IsEmpty());
  expect_medium(loaded, Color(1.5), Color(4.5));
}

TEST(Version0, ReflectancesAboveOneAreScaled) {
  const LoadedScene one =
      load_06(sphere("<bsdf type='diffuse'><rgb name='reflectance' value='2 1 0'/></bsdf>"));
  expect_near(albedo(one), {0.99, 0.495, 0});
  EXPECT_THAT(one.warnings, ElementsAre(HasSubstr("'reflectance' reaches 2")));
  const LoadedScene sum =
      load_06(sphere("<bsdf type='phong'><rgb name='diffuseReflectance' value='.75'/><rgb "
                     "name='specularReflectance' value='.75'/></bsdf>"));
  expect_near(albedo(sum), Color(0.99));
  EXPECT_THROW(
      load_3(sphere("<bsdf type='diffuse'><rgb name='reflectance' value='2 1 0'/></bsdf>")),
      SceneError);
}

TEST(Version0, ABlackbodyIsAnElement) {
  const auto radiance = [](const LoadedScene& loaded) {
    SurfacePoint at;
    at.ng = at.shading.n = Vec3(0, 0, 1);
    return rgb(first_shape(loaded).emitter()->eval(at, Vec3(0, 0, 1)));
  };
  const std::string kelvin = "<blackbody name='radiance' temperature='5000K' scale='2'/>";
  const std::string plugin =
      "<spectrum name='radiance' type='blackbody'><float name='temperature' value='5000'/><float "
      "name='scale' value='2'/></spectrum>";
  const Color found = radiance(load_06(sphere("<emitter type='area'>" + kelvin + "</emitter>")));
  expect_near(found, radiance(load_3(sphere("<emitter type='area'>" + plugin + "</emitter>"))),
              1e-12);
  EXPECT_GT(found.x, found.z);
  EXPECT_THAT(
      test::message_of([&] { load_3(sphere("<emitter type='area'>" + kelvin + "</emitter>")); }),
      HasSubstr("write <spectrum type=\"blackbody\"> with a temperature"));
}

TEST(Version0, OldDistributionsBecomeBeckmann) {
  const LoadedScene loaded = load_06(
      sphere("<bsdf type='roughconductor'><string name='distribution' value='phong'/></bsdf>"));
  EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("'phong' is taken as 'beckmann'")));
}

TEST(Version0, TheIntentOfAColourIsPassedOver) {
  expect_near(albedo(load_06(sphere("<bsdf type='diffuse'><spectrum name='reflectance' "
                                    "intent='reflectance' value='0.3'/></bsdf>"))),
              Color(0.3));
}

/// Three triangles of three materials, and a library that knows two of them.
class ObjMaterials : public test::SceneFiles {
 protected:
  void SetUp() override {
    SceneFiles::SetUp();
    write("a.mtl",
          "newmtl red\nKd 1 0 0\nillum 1\nnewmtl my glass\nillum 4\nnewmtl shiny\nKd .5 .5 .5\nKs "
          "1 1 1\nNs 10\nillum 2\nd 0.5\nbump none.png\n");
    write("a.obj",
          "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl red\nf 1 2 3\nf 1 3 2\nusemtl "
          "my glass\nf 1 2 3\nusemtl shiny\nf 1 2 3\n");
  }
  LoadedScene load_obj(const std::string& version, const std::string& content = "") const {
    return load(
        version,
        "<shape type='obj' id='it'><string name='filename' value='a.obj'/>" + content + "</shape>",
        path(""));
  }
  static std::vector<std::string> types(const LoadedScene& loaded) {
    std::vector<std::string> found;
    for (const ShapePtr& shape : loaded.scene->shapes()) found.push_back(shape->bsdf().type);
    return found;
  }
};

TEST_F(ObjMaterials, AreThoseOfTheLibrary) {
  const LoadedScene loaded = load_obj("0.6.0");
  EXPECT_THAT(types(loaded), ElementsAre("diffuse", "diffuse", "dielectric", "mask"));
  const auto& shapes = loaded.scene->shapes();
  expect_near(rgb(shapes[0]->bsdf().albedo({})), Color(0.5));
  expect_near(rgb(shapes[1]->bsdf().albedo({})), {1, 0, 0});
  EXPECT_NEAR(shapes[1]->area(), 1, 1e-6);
  EXPECT_NEAR(shapes[2]->area(), 0.5, 1e-6);
  EXPECT_THAT(loaded.warnings, testing::Contains(HasSubstr("none.png")));
}

TEST_F(ObjMaterials, AreThoseOfTheSceneWhereTheyHaveItsNames) {
  const std::string named = "<bsdf type='conductor' name='red'/>";
  EXPECT_THAT(types(load_obj("0.6.0", named)),
              ElementsAre("diffuse", "conductor", "dielectric", "mask"));
  const std::string unnamed = "<bsdf type='plastic' id='p'/>";
  EXPECT_THAT(types(load_obj("0.6.0", unnamed)), ElementsAre("plastic"));
  EXPECT_THAT(types(load_obj("0.6.0", named + unnamed)),
              ElementsAre("plastic", "conductor", "plastic", "plastic"));
  EXPECT_THAT(load_obj("0.6.0", "<bsdf type='conductor' name='blue'/>").warnings,
              testing::Contains(HasSubstr("no faces of the material 'blue'")));
}

TEST_F(ObjMaterials, AreNotReadWhereTheSceneDoesNotWantThem) {
  EXPECT_THAT(types(load_obj("0.6.0", "<boolean name='loadMaterials' value='false'/>")),
              ElementsAre("diffuse", "diffuse", "diffuse", "diffuse"));
  EXPECT_THAT(types(load_obj("3.0.0")), ElementsAre("diffuse"));
  std::filesystem::remove(path("a.mtl"));
  EXPECT_THAT(load_obj("0.6.0").warnings, ElementsAre(HasSubstr("its materials are left out")));
}

}  // namespace
}  // namespace mlt
