// From a scene's text to a Scene: what is attached to what, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/load.h"
#include "io/pack.h"
#include "job/plugins.h"
#include "scene/texture/texture.h"
#include "scene_files.h"

namespace mlt {
namespace {

using test::message_of;

const std::string sensor = "<sensor type='perspective'/>";
const std::string point_light = "<emitter type='point'/>";

LoadedScene load(const std::string& content, const LoadOptions& options = {}) {
  return load_string("<scene>\n" + content + "</scene>", "", plugins(), options);
}

std::string error_of(const std::string& content, const LoadOptions& options = {}) {
  return message_of([&] { load(content, options); });
}

Color albedo(const LoadedScene& loaded, size_t shape) {
  return loaded.scene->shapes().at(shape)->bsdf().albedo({}).rgb();
}

// ---- the smallest scenes

TEST(Scene, NeedsASensorAndIsBlackWithoutALight) {
  EXPECT_EQ(error_of(point_light),
            "<string>:1: the scene has no sensor; add <sensor type=\"perspective\">");
  EXPECT_THAT(load(sensor).warnings,
              testing::ElementsAre(
                  "<string>:1: the scene has no emitter, so the image is black; add a light"));
  EXPECT_EQ(error_of(""), "<string>:1: the scene has no sensor; add <sensor type=\"perspective\">");
}

TEST(Scene, NeedsNoShapes) {
  const LoadedScene loaded = load(sensor + "<emitter type='constant'/>");
  EXPECT_TRUE(loaded.scene->shapes().empty());
  EXPECT_EQ(loaded.scene->infinite_emitters().size(), 1u);
  EXPECT_FALSE(loaded.integrator);
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(Scene, OneNumberIsAnEqualEnergySpectrumOfALightAndAGreySurface) {
  const auto colors = [](const std::string& version) {
    const LoadedScene loaded =
        load_string("<scene version='" + version + "'>" + sensor +
                        "<emitter type='constant'><spectrum name='radiance' value='2'/></emitter>"
                        "<shape type='sphere'><bsdf type='diffuse'>"
                        "<spectrum name='reflectance' value='0.5'/></bsdf></shape></scene>",
                    "", plugins(), {});
    EXPECT_EQ(albedo(loaded, 0), Color(0.5));
    const Emitter& sky = *loaded.scene->emitters().at(0);
    const SurfacePoint far = loaded.scene->point_at_infinity({{}, {0, 0, 1}});
    return sky.eval(far, {0, 0, -1}).rgb();
  };
  EXPECT_EQ(colors("0.6.0"), Color(2));
  // What Mitsuba 3.9.1 (scalar_rgb) shows of such a light; it integrates tables.
  const Color difference = colors("2.0.0") - Color(2.4095879, 1.8965818, 1.8178325);
  EXPECT_LT(length(difference), 1e-4);
}

/// The radiance of the sky, and the albedo of the ball.
std::pair<Color, Color> colors_of(const std::string& radiance, const std::string& reflectance) {
  const LoadedScene loaded =
      load(sensor + "<emitter type='constant'>" + radiance + "</emitter>" +
           "<shape type='sphere'><bsdf type='diffuse'>" + reflectance + "</bsdf></shape>");
  EXPECT_TRUE(loaded.warnings.empty());
  const Emitter& sky = *loaded.scene->emitters().at(0);
  const SurfacePoint far = loaded.scene->point_at_infinity({{}, {0, 0, 1}});
  return {sky.eval(far, {0, 0, -1}).rgb(), albedo(loaded, 0)};
}

TEST(Scene, TakesSpectraAsPlugins) {
  const auto both = [](const std::string& element) {
    const auto named = [&](const std::string& name) {
      return "<spectrum name='" + name + "' " + element;
    };
    return colors_of(named("radiance"), named("reflectance"));
  };
  EXPECT_EQ(both("type='irregular'><string name='wavelengths' value='400, 550, 700'/>"
                 "<string name='values' value='0.2, 0.5, 0.7'/></spectrum>"),
            both("value='400:0.2, 550:0.5, 700:0.7'/>"));
  EXPECT_EQ(both("type='srgb'><rgb name='color' value='.1 .2 .3'/></spectrum>").second,
            Color(.1, .2, .3));
}

TEST(Scene, TakesSpectraByReferenceAndAsTextures) {
  const std::string red = "<texture type='srgb' id='red'><rgb name='color' value='.7 .1 .1'/>";
  const LoadedScene loaded = load(sensor + point_light + red +
                                  "</texture><shape type='sphere'><bsdf type='diffuse'>"
                                  "<ref id='red' name='reflectance'/></bsdf></shape>");
  EXPECT_EQ(albedo(loaded, 0), Color(.7, .1, .1));
}

TEST(Scene, NamesTheLineOfASpectrumThatIsWrong) {
  const auto error = [](const std::string& spectrum) {
    return error_of(sensor + "\n<emitter type='point'>\n" + spectrum + "</emitter>");
  };
  EXPECT_EQ(error("<spectrum type='blackbody' name='intensity'>\n"
                  "<float name='temperature' value='-5'/></spectrum>"),
            "<string>:5: texture 'blackbody': 'temperature' is -5 K, but must be above 0");
  EXPECT_EQ(error("<spectrum type='blackbdy' name='intensity'/>"),
            "<string>:4: unknown texture 'blackbdy'; did you mean 'blackbody'?");
  EXPECT_EQ(error("<texture type='checkerboard' name='intensity'/>"),
            "<string>:4: emitter 'point': 'intensity' is a texture, but should be a radiance "
            "(number, rgb or spectrum) or animation");
}

TEST(Scene, MustBeTheRoot) {
  EXPECT_EQ(message_of([] { load_string("<bsdf type='diffuse'/>", "", plugins(), {}); }),
            "<string>:1: the root is a bsdf, but should be a scene");
}

// ---- film and camera

TEST(SceneFilm, HasMitsubasDefaults) {
  const LoadedScene loaded = load(sensor + point_light);
  const Raster& raster = loaded.scene->camera().raster();
  EXPECT_EQ(raster.full_size, Vec2i(768, 576));
  EXPECT_EQ(raster.size, Vec2i(768, 576));
  EXPECT_EQ(loaded.scene->film().filter->name(), "gaussian");
  EXPECT_EQ(raster.border, loaded.scene->film().filter->radius());
  EXPECT_EQ(loaded.scene->sample_count(), 0);
}

const std::string cropped = R"(<sensor type='perspective'>
  <film type='hdrfilm'><integer name='width' value='80'/><integer name='height' value='60'/>
    <integer name='cropOffsetX' value='10'/><integer name='cropOffsetY' value='20'/>
    <integer name='cropWidth' value='30'/><integer name='cropHeight' value='40'/>
    <rfilter type='tent'/></film>
  <sampler type='independent'><integer name='sampleCount' value='7'/></sampler></sensor>)";

TEST(SceneFilm, TellsTheCameraItsSizeAndCropWindow) {
  const LoadedScene loaded = load(cropped + point_light);
  const Raster& raster = loaded.scene->camera().raster();
  EXPECT_EQ(raster.full_size, Vec2i(80, 60));
  EXPECT_EQ(raster.crop_offset, Vec2i(10, 20));
  EXPECT_EQ(raster.size, Vec2i(30, 40));
  EXPECT_EQ(raster.border, 1);
  EXPECT_EQ(loaded.scene->sample_count(), 7);
}

TEST(SceneFilm, IsReplacedByAnotherSizeTogetherWithItsCropWindow) {
  LoadOptions options;
  options.size = Vec2i(20, 10);
  const Raster& raster = load(cropped + point_light, options).scene->camera().raster();
  EXPECT_EQ(raster.full_size, Vec2i(20, 10));
  EXPECT_EQ(raster.crop_offset, Vec2i(0, 0));
  EXPECT_EQ(raster.size, Vec2i(20, 10));
  for (const Vec2i size : {Vec2i(0, 10), Vec2i(10, -1), Vec2i(100'000, 1), Vec2i(30'000, 30'000)}) {
    options.size = size;
    EXPECT_THROW(load(sensor + point_light, options), UsageError);
  }
}

TEST(SceneFilm, TakesTheSampleCountOfForeignSamplers) {
  const LoadedScene loaded = load(
      "<sensor type='perspective'><sampler type='theirs'><float name='strange' value='1'/>"
      "<integer name='sampleCount' value='12'/></sampler></sensor>" +
      point_light);
  EXPECT_EQ(loaded.scene->sample_count(), 12);
  EXPECT_EQ(loaded.warnings,
            std::vector<std::string>{"<string>:2: sampler 'theirs' is not known here; "
                                     "only its sample_count is used"});
}

TEST(SceneFilm, UsesTheFirstOfSeveralSensors) {
  const LoadedScene loaded = load(cropped + "\n<sensor type='orthographic'/>" + point_light);
  EXPECT_EQ(loaded.scene->camera().raster().full_size, Vec2i(80, 60));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_EQ(loaded.warnings[0],
            "<string>:8: this scene has 2 sensors; the first one is used, since none was named");
}

TEST(SceneFilm, CanBeGivenOnce) {
  EXPECT_EQ(
      error_of("<sensor type='perspective'><film type='hdrfilm'/><film type='hdrfilm'/></sensor>" +
               point_light),
      "<string>:2: sensor 'perspective' has 2 nested elements <film>, but can have one");
}

// ---- materials

TEST(SceneBsdf, OfAShapeIsGreyUnlessGiven) {
  const LoadedScene loaded =
      load(sensor + point_light + R"(<shape type='cube'/><shape type='sphere'>
    <bsdf type='diffuse'><rgb name='diffuseReflectance' value='.1 .2 .3'/></bsdf></shape>)");
  EXPECT_EQ(albedo(loaded, 0), Color(0.5));
  EXPECT_EQ(albedo(loaded, 1), Color(0.1, 0.2, 0.3));
  EXPECT_EQ(loaded.scene->shapes()[1]->type, "sphere");
  EXPECT_EQ(loaded.scene->shapes()[1]->where.line, 2);
  EXPECT_EQ(loaded.scene->shapes()[1]->index(), 1u);
}

TEST(SceneBsdf, OfALightIsBlackUnlessGiven) {
  EXPECT_EQ(albedo(load(sensor + "<shape type='cube'><emitter type='area'/></shape>"), 0),
            Color(0));
}

TEST(SceneBsdf, IsSharedByReferencesWhereverItIsDefined) {
  const LoadedScene loaded = load(sensor + point_light + R"(
    <shape type='cube'><ref id='red'/></shape>
    <shape type='cube'><ref name='bsdf' id='red'/></shape>
    <shape type='cube'><bsdf type='twosided'><ref id='red'/></bsdf></shape>
    <shape type='cube'><ref id='rouge'/></shape>
    <shape type='cube'>
      <bsdf type='diffuse' id='red'><rgb name='reflectance' value='#ff0000'/></bsdf></shape>
    <alias id='red' as='rouge'/>)");
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(albedo(loaded, i), Color(1, 0, 0)) << i;
  const auto& shapes = loaded.scene->shapes();
  EXPECT_EQ(&shapes[0]->bsdf(), &shapes[1]->bsdf());
  EXPECT_EQ(&shapes[0]->bsdf(), &shapes[3]->bsdf());
  EXPECT_EQ(&shapes[0]->bsdf(), &shapes[4]->bsdf());
}

TEST(SceneBsdf, TakesTexturesByName) {
  const LoadedScene loaded = load(sensor + point_light + R"(
    <texture type='checkerboard' id='board'>
      <rgb name='color0' value='.2'/><rgb name='color1' value='.4'/></texture>
    <shape type='cube'><bsdf type='diffuse'><ref name='reflectance' id='board'/></bsdf></shape>)");
  const SurfacePoint at;
  EXPECT_GT(loaded.scene->shapes()[0]->bsdf().albedo(at).rgb().x, 0.1);
}

TEST(SceneBsdf, CanBeGivenOnce) {
  EXPECT_EQ(error_of(sensor + point_light +
                     "<shape type='cube'><bsdf type='diffuse'/><bsdf type='null'/></shape>"),
            "<string>:2: shape 'cube' has 2 nested elements <bsdf>, but can have one");
}

// ---- lights

TEST(SceneLight, OfAShapeKnowsItsShape) {
  const LoadedScene loaded = load(sensor + R"(<shape type='cube'/>
    <shape type='rectangle'><emitter type='area'/></shape>)");
  ASSERT_EQ(loaded.scene->emitters().size(), 1u);
  const Shape& shape = *loaded.scene->shapes()[1];
  EXPECT_EQ(shape.emitter(), loaded.scene->emitters()[0].get());
  EXPECT_EQ(shape.emitter()->shape(), &shape);
  const PositionSample sample = shape.emitter()->sample_position({0.5, 0.5}, 0);
  EXPECT_DOUBLE_EQ(sample.pdf, 0.25);
  EXPECT_EQ(sample.at.shape, 1u);
}

TEST(SceneLight, IsMadeAnewForEachShapeThatRefersToIt) {
  const LoadedScene loaded = load(sensor + R"(<emitter type='area' id='glow'/>
    <shape type='cube'><ref id='glow'/></shape><shape type='sphere'><ref id='glow'/></shape>)");
  ASSERT_EQ(loaded.scene->emitters().size(), 2u);
  EXPECT_EQ(loaded.scene->emitters()[0]->shape(), loaded.scene->shapes()[0].get());
  EXPECT_EQ(loaded.scene->emitters()[1]->shape(), loaded.scene->shapes()[1].get());
}

TEST(SceneLight, StandsWhereItBelongs) {
  EXPECT_EQ(error_of(sensor + "<emitter type='area'/>"),
            "<string>:2: emitter 'area' needs a shape; put it inside one");
  EXPECT_EQ(error_of(sensor + "<shape type='cube'>\n<emitter type='constant'/></shape>"),
            "<string>:3: emitter 'constant' cannot be attached to a shape; put it directly into "
            "the scene");
  EXPECT_EQ(
      error_of(sensor + "<shape type='cube'><emitter type='area'/><emitter type='area'/></shape>"),
      "<string>:2: shape 'cube' has 2 nested elements <emitter>, but can have one");
}

// ---- references

TEST(SceneReference, MustMeanSomething) {
  EXPECT_EQ(
      error_of(sensor + point_light +
               "<bsdf type='diffuse' id='wall'/>\n<shape type='cube'><ref id='wal'/></shape>"),
      "<string>:3: nothing has the id 'wal'; did you mean 'wall'?");
  EXPECT_EQ(error_of(sensor + point_light + "\n<ref id='x'/>"),
            "<string>:3: a <ref> at the top of a scene has no effect; put it inside a shape");
}

TEST(SceneReference, MayNotGoRound) {
  EXPECT_EQ(error_of(sensor + point_light +
                     "<bsdf type='twosided' id='a'><ref id='b'/></bsdf>\n"
                     "<bsdf type='twosided' id='b'><ref id='a'/></bsdf>"),
            "<string>:2: the bsdf 'a' contains itself");
}

TEST(SceneReference, MayNotBeNestedWithoutEnd) {
  std::string chain = "<bsdf type='diffuse' id='m0'/>";
  for (int i = 1; i < 5000; ++i)
    chain = "<bsdf type='twosided' id='m" + std::to_string(i) + "'><ref id='m" +
            std::to_string(i - 1) + "'/></bsdf>" + chain;
  EXPECT_EQ(error_of(sensor + point_light + chain),
            "<string>:2: references are nested more than 100 deep");
}

/// Levels of blends, each of which refers so often to the one before it.
std::string blends(int levels, bool twice) {
  std::string all = "<bsdf type='dielectric' id='m0'/>";
  for (int i = 1; i <= levels; ++i) {
    const std::string before = "<ref id='m" + std::to_string(i - 1) + "'/>";
    all += "\n<bsdf type='blendbsdf' id='m" + std::to_string(i) + "'>" + before +
           (twice ? before : "<bsdf type='diffuse'/>") + "</bsdf>";
  }
  return all + "\n<shape type='sphere'><ref id='m" + std::to_string(levels) + "'/></shape>";
}

TEST(SceneReference, MayNotBranchWithoutEnd) {
  EXPECT_EQ(error_of(sensor + point_light + blends(40, true)),
            "<string>:11: the bsdf is made of more than 1000 parts; what is referred to twice "
            "counts twice");
  load(sensor + point_light + blends(8, true));
}

TEST(SceneReference, LongChainsOfBlendsTakeNoLonger) {
  load(sensor + point_light + blends(90, false));
}

TEST(SceneReference, MustFitItsPlace) {
  EXPECT_EQ(error_of(sensor + point_light +
                     "<bsdf type='null' id='a'/><bsdf type='diffuse'>\n<ref name='reflectance' "
                     "id='a'/></bsdf>"),
            "<string>:3: bsdf 'diffuse': 'reflectance' is a bsdf, but should be a reflectance or "
            "texture");
  EXPECT_EQ(error_of(sensor + point_light + "<bsdf type='diffuse'>\n<bsdf type='null'/></bsdf>"),
            "<string>:3: bsdf 'diffuse' does not take a nested bsdf");
}

// ---- mistakes, each with its place

TEST(SceneMistake, InANameGetsASuggestion) {
  EXPECT_EQ(error_of(sensor + point_light + "<bsdf type='difuse'/>"),
            "<string>:2: unknown bsdf 'difuse'; did you mean 'diffuse'?");
  EXPECT_EQ(error_of(sensor + point_light +
                     "<shape type='sphere'>\n<float name='raduis' value='1'/></shape>"),
            "<string>:3: unknown parameter 'raduis' for shape 'sphere'; did you mean 'radius'?");
  EXPECT_EQ(
      error_of(sensor + point_light +
               "<bsdf type='diffuse'>\n<texture name='reflectanse' type='checkerboard'/></bsdf>"),
      "<string>:3: unknown parameter 'reflectanse' for bsdf 'diffuse'; did you mean "
      "'reflectance'?");
  EXPECT_EQ(error_of(sensor + point_light +
                     "<shape type='sphere'>\n<string name='radius' value='1'/></shape>"),
            "<string>:3: shape 'sphere': 'radius' is a string, but should be a float");
}

TEST(SceneMistake, InAnUnusedMaterialIsFoundToo) {
  EXPECT_EQ(
      error_of(sensor + point_light +
               "<bsdf type='diffuse' id='unused'>\n<float name='reflectance' value='-2'/></bsdf>")
          .substr(0, 10),
      "<string>:3");
}

TEST(SceneMistake, PluginsOfMitsubaAreRefusedByName) {
  for (const char* element :
       {"shape type='heightfield'", "shape type='animatedinstance'", "bsdf type='irawan'",
        "bsdf type='hapke'", "emitter type='collimated'", "texture type='wireframe'"}) {
    const std::string message = error_of(sensor + point_light + "<" + element + "/>");
    EXPECT_NE(message.find("is not supported: "), std::string::npos) << message;
    EXPECT_EQ(message.substr(0, 10), "<string>:2") << message;
  }
  EXPECT_NE(error_of("<sensor type='fluencemeter'/>" + point_light)
                .find("sensor 'fluencemeter' is not supported"),
            std::string::npos);
}

TEST(SceneMistake, AllThatIsMissingIsNamedAtOnce) {
  EXPECT_EQ(error_of(sensor + point_light + R"(
<shape type='hair'/>
<shape type='sphere'><bsdf type='hapke'/><float name='raduis' value='1'/></shape>
<shape type='sphere'><bsdf type='hapke'/></shape>
<phase type='sggx'/>)"),
            "<string>:3: shape 'hair' is not supported: hair and curves are not supported; "
            "line 4: unknown parameter 'raduis' for shape 'sphere'; did you mean 'radius'?; "
            "line 4: bsdf 'hapke' is not supported: layered and measured materials are not "
            "supported; "
            "line 6: phase 'sggx' is not supported: not implemented yet");
}

TEST(Sensors, AreChosenByNumber) {
  const auto of_size = [](int width, int height) {
    return fmt::format(
        "<sensor type='perspective'><film type='hdrfilm'><integer name='width' value='{}'/>"
        "<integer name='height' value='{}'/></film></sensor>",
        width, height);
  };
  const std::string wide = of_size(64, 16), tall = of_size(16, 64);
  const std::string three = sensor + wide + tall + point_light;
  EXPECT_EQ(load(three).warnings,
            std::vector<std::string>{"<string>:2: this scene has 3 sensors; the first one is used, "
                                     "since none was named"});
  LoadOptions options;
  options.sensor = 2;
  const LoadedScene third = load(three, options);
  EXPECT_TRUE(third.warnings.empty());
  EXPECT_EQ(third.scene->camera().raster().size, Vec2i(16, 64));
  const LoadedScene second = with_sensor(third, 1, plugins());
  EXPECT_EQ(second.scene->camera().raster().size, Vec2i(64, 16));
  EXPECT_EQ(second.source.options.sensor, 1);
  EXPECT_NE(second.hash, third.hash);
  EXPECT_EQ(unpack_scene(pack(second), plugins()).hash, second.hash);
  for (const int64_t wrong : {-1, 3}) {
    options.sensor = wrong;
    EXPECT_EQ(error_of(three, options),
              "there is no sensor " + std::to_string(wrong) + ": the scene's are 0 to 2");
  }
  EXPECT_EQ(error_of(sensor + point_light, options),
            "there is no sensor 3: the scene has one, number 0");
}

class SceneFileTest : public test::SceneFiles {};

TEST_F(SceneFileTest, ABrokenFileNamesTheSceneAndTheFile) {
  write("broken.png", "this is no picture");
  write("scene.xml",
        "<scene>" + sensor + point_light +
            "<bsdf type='diffuse'>\n<texture name='reflectance' "
            "type='bitmap'><string name='filename' value='broken.png'/></texture></bsdf></scene>");
  const std::string message = message_of([&] { load_file(path("scene.xml"), plugins(), {}); });
  EXPECT_EQ(message.find(path("scene.xml") + ":2: "), 0u) << message;
  EXPECT_NE(message.find("broken.png"), std::string::npos) << message;
}

// ---- integrators

TEST(SceneIntegrator, IsHandedOnAsItIsWritten) {
  const LoadedScene loaded =
      load(sensor + point_light +
           "<integrator type='bdpt'><integer name='maxDepth' value='3'/></integrator>");
  ASSERT_TRUE(loaded.integrator);
  EXPECT_EQ(loaded.integrator->type, "bdpt");
  EXPECT_EQ(loaded.integrator->properties.at(0).name, "maxDepth");
}

TEST(SceneIntegrator, IsTheOneInsideAStatisticsWrapper) {
  const LoadedScene loaded = load(
      sensor + point_light + "<integrator type='moment'><integrator type='path'/></integrator>");
  EXPECT_EQ(loaded.integrator->type, "path");
  EXPECT_EQ(loaded.warnings,
            std::vector<std::string>{
                "<string>:2: integrator 'moment' is not supported; the 'path' inside it is used"});
}

TEST(SceneIntegrator, IsOnlyOne) {
  EXPECT_EQ(
      error_of(sensor + point_light + "<integrator type='path'/>\n<integrator type='direct'/>"),
      "<string>:3: the scene has a second integrator; keep one");
}

TEST(SceneObject, CanBeMadeAlone) {
  std::vector<std::string> warnings;
  const Node node =
      read_xml_string("<bsdf type='diffuse' id='a'><float name='reflectance' value='.25'/></bsdf>",
                      "", {}, warnings);
  const auto bsdf = std::dynamic_pointer_cast<Bsdf>(build_object(node, plugins(), warnings));
  ASSERT_TRUE(bsdf);
  EXPECT_EQ(bsdf->albedo({}), Spectrum(0.25));
  EXPECT_EQ(bsdf->id, "a");
}

TEST(SceneObject, MayHaveAnyNameWhereItsFamilyTellsWhatItIsFor) {
  const LoadedScene loaded = load(R"(<sensor type='perspective' name='sensor'>
      <film type='hdrfilm' name='film'><rfilter type='box' name='rfilter'/></film></sensor>
    <shape type='cube' name='cube'><emitter type='area' name='light'/>
      <bsdf type='twosided' name='material'><bsdf type='diffuse' name='inside'/></bsdf></shape>)");
  EXPECT_EQ(loaded.scene->film().filter->name(), "box");
  EXPECT_EQ(loaded.scene->shapes()[0]->bsdf().type, "twosided");
  EXPECT_NE(loaded.scene->shapes()[0]->emitter(), nullptr);
}

TEST(Plugins, AreAllInTheTableOfTheManual) {
  std::ifstream file("docs/mitsuba.md");
  const std::string manual(std::istreambuf_iterator<char>(file), {});
  ASSERT_FALSE(manual.empty());
  for (const std::string& family : plugins().families()) {
    if (family == "sampler") continue;  // any of them will do
    for (const std::string& name : plugins().names(family))
      EXPECT_NE(manual.find("`" + name + "`"), std::string::npos) << family << " " << name;
  }
}

TEST(Plugins, HaveCompleteDescriptions) {
  for (const std::string& family : plugins().families()) {
    for (const std::string& name : plugins().names(family)) {
      const Schema& schema = plugins().find(family, name, {}).schema;
      EXPECT_EQ(schema.family, family) << name;
      EXPECT_FALSE(schema.doc.empty()) << family << " " << name;
      for (const Parameter& parameter : schema.parameters) {
        EXPECT_FALSE(parameter.doc.empty()) << family << " " << name << " " << parameter.name;
        EXPECT_EQ(parameter.name, snake_case(parameter.name)) << family << " " << name;
      }
    }
  }
}

// ---- the fingerprint

TEST_F(SceneFileTest, FingerprintsFollowTheContentAndNotThePlace) {
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string xml = "<scene>" + sensor + point_light +
                          "<shape type='obj'><string name='filename' "
                          "value='a.obj'/></shape></scene>";
  const auto hash = [&](const std::string& file, const LoadOptions& options = {}) {
    return load_file(path(file), plugins(), options).hash;
  };
  write("one/a.obj", mesh);
  write("one/scene.xml", xml);
  write("two/a.obj", mesh);
  write("two/other.xml", "<!-- moved -->\n" + xml);
  const uint64_t original = hash("one/scene.xml");
  EXPECT_EQ(hash("one/scene.xml"), original);
  EXPECT_EQ(hash("two/other.xml"), original);
  LoadOptions options;
  options.size = Vec2i(10, 10);
  EXPECT_NE(hash("one/scene.xml", options), original);
  write("two/a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  EXPECT_NE(hash("two/other.xml"), original);
}

}  // namespace
}  // namespace mlt
