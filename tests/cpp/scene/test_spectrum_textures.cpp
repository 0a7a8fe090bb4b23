#include <gmock/gmock.h>

#include "math/colorimetry.h"
#include "plugin_testing.h"
#include "scene/texture/texture.h"

namespace mlt {

#define MLT_PLUGIN(family, name) Plugin family##_##name();
#include "scene/texture/list.inc"
#undef MLT_PLUGIN

namespace {

using test::error_in;
using test::expect_close;
using test::Given;
using test::make;
using testing::HasSubstr;

const Schema& uses() {
  static const Schema schema{"bsdf",
                             "test",
                             "",
                             {{"map", ParamType::texture, no_default, ""},
                              {"glow", ParamType::emission, no_default, ""},
                              {"power", ParamType::radiance, no_default, ""}}};
  return schema;
}

Params given_as(const std::string& name, const Value& value) {
  Params params(uses(), {"scene.xml", 3});
  params.set(name, value, {"scene.xml", 4});
  return params;
}

TexturePtr used_as(const std::string& name, const Value& value) {
  Params params = given_as(name, value);
  return unbounded_texture_param(params, name);
}

/// The values at the wavelengths of u; of negative u, in RGB.
Spectrum value_at(const Texture& texture, double u) {
  SurfacePoint at;
  at.uv = {0.3, 0.6};
  at.wavelength = u;
  return texture.eval(at);
}

void expect_equal(const Texture& a, const Texture& b) {
  EXPECT_EQ(a.mean(), b.mean());
  EXPECT_EQ(a.maximum(), b.maximum());
  EXPECT_EQ(value_at(a, -1), value_at(b, -1));
  for (double u : {0.0, 0.1, 0.37, 0.6, 0.93}) EXPECT_EQ(value_at(a, u), value_at(b, u)) << u;
}

Spectrum curve_at(const Curve& curve, double u) {
  return at_wavelengths(u, [&](double nm) { return curve.at(nm); });
}

const WavelengthTable ramp{{400, 0.2}, {550, 0.5}, {700, 0.7}};

Given ramp_as_text() {
  return {{"wavelengths", std::string("400, 550, 700")}, {"values", std::string("0.2 .5 .7")}};
}

TEST(SpectrumTextures, TablesAreTheValueOfTheSamePairsInEveryUse) {
  const ObjectPtr irregular = make<Texture>(texture_irregular(), ramp_as_text());
  const ObjectPtr regular =
      make<Texture>(texture_regular(), {{"wavelength_min", 400.0},
                                        {"wavelength_max", int64_t{700}},
                                        {"values", std::string("0.2, 0.5, 0.7")}});
  for (const char* name : {"map", "glow", "power"})
    for (const ObjectPtr& object : {irregular, regular})
      expect_equal(*used_as(name, object), *used_as(name, ramp));
  // Under D65 a reflectance is bluer than the same spectrum of a light.
  EXPECT_GT(used_as("map", irregular)->mean().z, used_as("glow", irregular)->mean().z);
}

TEST(SpectrumTextures, UniformIsTheSameAtAllWavelengthsAlsoAsLight) {
  const ObjectPtr uniform = make<Texture>(texture_uniform(), {{"value", 0.25}});
  for (const char* name : {"map", "glow", "power"}) {
    const TexturePtr texture = used_as(name, uniform);
    EXPECT_EQ(texture->mean(), Color(0.25));
    for (double u : {-1.0, 0.2, 0.8}) EXPECT_EQ(value_at(*texture, u), Spectrum(0.25)) << u;
  }
  const ObjectPtr part =
      make<Texture>(texture_uniform(), {{"value", 0.25}, {"wavelength_max", 600.0}});
  expect_equal(*used_as("glow", part), *used_as("glow", WavelengthTable{{360, .25}, {600, .25}}));
}

TEST(SpectrumTextures, BlackbodiesEmitPlancksLaw) {
  const ObjectPtr body =
      make<Texture>(texture_blackbody(), {{"temperature", 3000.0}, {"scale", 2.0}});
  const Curve curve = Curve::blackbody(3000).scaled(2);
  for (const char* name : {"glow", "power"}) {
    const TexturePtr light = used_as(name, body);
    for (double u : {0.1, 0.5, 0.9}) EXPECT_EQ(value_at(*light, u), curve_at(curve, u)) << u;
    expect_close(light->mean(), glm::max(curve_to_rgb(curve), Color(0)), 1e-9);
  }
}

TEST(SpectrumTextures, RedBlackbodiesAreOutOfGamut) {
  for (const auto& [kelvin, warnings] : {std::pair(1500.0, 1u), std::pair(3000.0, 0u)}) {
    Params params = given_as("glow", make<Object>(texture_blackbody(), {{"temperature", kelvin}}));
    texture_param(params, "glow");
    EXPECT_EQ(params.warnings().size(), warnings) << kelvin;
  }
  EXPECT_THAT(error_in(texture_blackbody(), {{"temperature", 1e300}, {"scale", 1e30}}),
              HasSubstr("too bright"));
}

TEST(SpectrumTextures, DaylightIsWhiteInRgb) {
  const TexturePtr light =
      used_as("glow", ObjectPtr(make<Texture>(texture_d65(), {{"scale", 3.0}})));
  EXPECT_EQ(light->mean(), Color(3));
  for (double u : {0.1, 0.5, 0.9}) EXPECT_EQ(value_at(*light, u), 3.0 * daylight(u)) << u;
  const Triple orange{1, 0.5, 0.1};
  const ObjectPtr coloured = make<Texture>(texture_d65(), {{"color", orange}});
  expect_equal(*used_as("glow", coloured), *used_as("glow", orange));
}

TEST(SpectrumTextures, ColoursAreWhatTheyAreAsValues) {
  const Triple orange{1, 0.5, 0.1};
  for (const ObjectPtr& object : {make<Object>(texture_srgb(), {{"color", orange}}),
                                  make<Object>(texture_rgb(), {{"value", orange}})})
    for (const char* name : {"map", "glow"})
      expect_equal(*used_as(name, object), *used_as(name, orange));
}

std::shared_ptr<Texture> scaled_by_two(const std::shared_ptr<Texture>& texture) {
  const Plugin plugin = texture_scale();
  Params params(plugin.schema, {"scene.xml", 7});
  params.set("scale", 2.0, {"scene.xml", 8});
  params.add("texture", texture, {"scene.xml", 9});
  return std::dynamic_pointer_cast<Texture>(make_object(plugin, params));
}

TEST(SpectrumTextures, AreNotPutUnderD65InsideOfOtherTextures) {
  const auto body = make<Texture>(texture_blackbody(), {{"temperature", 3000.0}, {"scale", 0.1}});
  const Curve curve = Curve::blackbody(3000).scaled(0.1);
  const TexturePtr scaled = used_as("glow", ObjectPtr(scaled_by_two(body)));
  const TexturePtr board = used_as(
      "glow", ObjectPtr(make<Texture>(texture_checkerboard(),
                                      {{"color0", ObjectPtr(body)}, {"color1", ObjectPtr(body)}})));
  for (double u : {0.1, 0.5, 0.9}) {
    EXPECT_EQ(value_at(*scaled, u), 2.0 * curve_at(curve, u)) << u;
    EXPECT_EQ(value_at(*board, u), curve_at(curve, u)) << u;
  }
}

TEST(SpectrumTextures, OtherTexturesEmitD65) {
  const auto board = make<Texture>(texture_checkerboard(), {{"color0", 0.5}, {"color1", 0.5}});
  const TexturePtr light = used_as("glow", ObjectPtr(board));
  const TexturePtr coloured =
      used_as("glow", ObjectPtr(make<Texture>(texture_d65(), {{"color", ObjectPtr(board)}})));
  for (double u : {0.1, 0.5, 0.9}) {
    EXPECT_EQ(value_at(*light, u), 0.5 * daylight(u)) << u;
    EXPECT_EQ(value_at(*coloured, u), value_at(*light, u)) << u;
  }
  EXPECT_EQ(value_at(*light, -1), Spectrum(0.5));
}

TEST(SpectrumTextures, AreBoundedAsReflectances) {
  const ObjectPtr bright = make<Texture>(texture_uniform(), {{"value", 1.5}});
  Params params = given_as("map", bright);
  try {
    texture_param(params, "map");
    ADD_FAILURE() << "no error";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("scene.xml:4: bsdf 'test': 'map' reaches 1.5"));
  }
}

std::string irregular_error(const std::string& wavelengths, const std::string& values) {
  return error_in(texture_irregular(), {{"wavelengths", wavelengths}, {"values", values}});
}

TEST(SpectrumTextures, NameWhatIsWrongAndWhere) {
  const std::string here = "scene.xml:8: texture 'irregular': 'values' ";
  EXPECT_EQ(irregular_error("400", "1"),
            here +
                "is no valid spectrum: a spectrum needs at least two wavelength:value pairs, "
                "this one has 1");
  EXPECT_EQ(irregular_error("500 400", "1 2"),
            here +
                "is no valid spectrum: the wavelengths of a spectrum must increase, but 400 "
                "comes after 500");
  EXPECT_EQ(irregular_error("400 500", "1 2 3"),
            here + "has 3 numbers, but there are 2 wavelengths");
  EXPECT_EQ(irregular_error("400 500", "1 x"), here + "contains 'x', which is not a finite number");
  EXPECT_EQ(irregular_error("400 500", "1 nan"),
            here + "contains 'nan', which is not a finite number");
  EXPECT_EQ(irregular_error("400 500", "1 -2"), here + "is -2 at 500 nm, but must not be negative");
  for (const char* wavelengths : {"100 359", "831 2000"})
    EXPECT_THAT(irregular_error(wavelengths, "1 1"), HasSubstr("none of which is visible"));
  EXPECT_EQ(irregular_error("100 2000", "1 1"), "");
}

TEST(SpectrumTextures, CheckTheirNumbers) {
  const std::string body = "scene.xml:8: texture 'blackbody': 'temperature' ";
  EXPECT_EQ(error_in(texture_blackbody(), {{"temperature", 0.0}}),
            body + "is 0 K, but must be above 0");
  EXPECT_EQ(error_in(texture_blackbody(), {{"temperature", infinity}}), body + "must be finite");
  EXPECT_THAT(error_in(texture_blackbody(), {{"temperature", 1.0}, {"scale", -1.0}}),
              HasSubstr("'scale' is -1"));
  EXPECT_THAT(error_in(texture_regular(), {{"values", std::string("1")}}),
              HasSubstr("'values' has 1 numbers, but needs two or more"));
  EXPECT_THAT(
      error_in(texture_regular(), {{"values", std::string("1 2")}, {"wavelength_max", 300.0}}),
      HasSubstr("'wavelength_max' is 300, but must be above 360"));
  EXPECT_THAT(error_in(texture_uniform(), {{"value", -1.0}}), HasSubstr("'value' is -1"));
  EXPECT_THAT(error_in(texture_srgb(), {{"color", Triple{2, 0, 0}}}), HasSubstr("'unbounded'"));
  EXPECT_EQ(error_in(texture_srgb(), {{"color", Triple{2, 0, 0}}, {"unbounded", true}}), "");
}

TEST(SpectrumValues, MustNotBeNegativeUnlessTheyAreOpticalConstants) {
  const WavelengthTable dips{{400, 0.2}, {500, -0.1}, {600, 0.5}};
  for (const char* name : {"map", "glow"}) try {
      used_as(name, dips);
      ADD_FAILURE() << name;
    } catch (const SceneError& error) {
      EXPECT_THAT(error.what(), HasSubstr("its value at 500 nm is -0.1"));
    }
  Params params = given_as("power", dips);
  EXPECT_NO_THROW(to_spectral(params, "power", SpectrumUse::unbounded));
}

TEST(SpectrumValues, WarnWhereTheyAreInvisible) {
  Params params = given_as("glow", WavelengthTable{{900, 1}, {1000, 1}});
  EXPECT_EQ(texture_param(params, "glow")->mean(), Color(0));
  ASSERT_EQ(params.warnings().size(), 1u);
  EXPECT_THAT(params.warnings()[0], HasSubstr("no wavelength from 360 to 830 nm"));
}

}  // namespace
}  // namespace mlt
