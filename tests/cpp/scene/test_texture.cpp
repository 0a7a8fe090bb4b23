#include "scene/texture/texture.h"

#include <gmock/gmock.h>

#include "base/rng.h"
#include "image/srgb.h"
#include "scene/plugin_testing.h"
#include "scene/transform/transform_params.h"

namespace mlt {

Plugin texture_bitmap();
Plugin texture_checkerboard();
Plugin texture_mix();
Plugin texture_scale();

namespace {

using test::error_in;
using test::expect_close;
using test::Given;
using test::make;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Color look_up(const Texture& texture, double u, double v) {
  SurfacePoint at;
  at.uv = {u, v};
  return texture.eval(at).rgb();
}

/// 4 x 3 texels whose values are all different.
Image twelve_texels() {
  Image image(4, 3, 3);
  for (size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = static_cast<float>(i * 29 % 32) / 32;
  return image;
}

Given bitmap_of(const std::string& name, const Image& image, Given more = {}) {
  more["filename"] = test::temporary_image(name, image);
  return more;
}

struct Sample {
  Vec2 uv;
  Color color;
};

/// Values of Mitsuba 3.9.1 (scalar_rgb, raw, format "variant") for the same texels.
struct MitsubaCase {
  std::string name;
  Given given;
  std::vector<Sample> samples;
};

std::vector<MitsubaCase> mitsuba_cases() {
  const Value nearest = std::string("nearest"), mirror = std::string("mirror");
  const double c = std::sqrt(3.0) / 2;
  const Matrix turned = {2 * c, -1, 0, 0.2, 1.5, 3 * c, 0, 0.6, 0, 0, 1, 0, 0, 0, 0, 1};
  return {{"bilinear",
           {},
           {{{0.125, 1. / 6}, {0, 0.90625, 0.8125}},
            {{0.4, 0.6}, {0.528125, 0.434375, 0.340625}},
            {{0.03, 0.98}, {0.47937497, 0.65842503, 0.731875}},
            {{1.3, -0.2}, {0.5656251, 0.47187504, 0.37812504}},
            {{-2.4, 3.7}, {0.26562506, 0.17187506, 0.07812506}},
            {{0.5, 0.5}, {0.453125, 0.359375, 0.265625}}}},
          {"nearest",
           {{"filter_type", nearest}},
           {{{0.125, 1. / 6}, {0.0, 0.90625, 0.8125}},
            {{0.4, 0.6}, {0.59375, 0.5, 0.40625}},
            {{0.03, 0.98}, {0.75, 0.65625, 0.5625}},
            {{1.3, -0.2}, {0.46875, 0.375, 0.28125}},
            {{-2.4, 3.7}, {0.1875, 0.09375, 0.0}},
            {{0.5, 0.5}, {0.3125, 0.21875, 0.125}}}},
          {"mirror",
           {{"wrap_mode", mirror}},
           {{{0.4, 0.6}, {0.528125, 0.434375, 0.340625}},
            {{0.03, 0.98}, {0.75, 0.65625, 0.5625}},
            {{1.3, -0.2}, {0.34062496, 0.27687496, 0.45312512}},
            {{-2.4, 3.7}, {0.64062494, 0.54687494, 0.45312494}}}},
          {"clamp",
           {{"wrap_mode", std::string("clamp")}},
           {{{0.03, 0.98}, {0.75, 0.65625, 0.5625}},
            {{1.3, -0.2}, {0.15625, 0.0625, 0.96875}},
            {{-2.4, 3.7}, {0.75, 0.65625, 0.5625}}}},
          {"nearest mirror",
           {{"filter_type", nearest}, {"wrap_mode", mirror}},
           {{{1.3, -0.2}, {0.4375, 0.34375, 0.25}}, {{-2.4, 3.7}, {0.71875, 0.625, 0.53125}}}},
          {"to_uv",
           {{"to_uv", turned}},
           {{{0.125, 1. / 6}, {0.41959447, 0.7456131, 0.65186304}},
            {{0.4, 0.6}, {0.589135, 0.49538502, 0.40163502}},
            {{0.03, 0.98}, {0.4435754, 0.73175025, 0.6380003}},
            {{1.3, -0.2}, {0.34889838, 0.25514838, 0.22445306}},
            {{-2.4, 3.7}, {0.5873319, 0.4935819, 0.3998319}}}}};
}

TEST(Bitmap, AgreesWithMitsuba) {
  for (const MitsubaCase& c : mitsuba_cases()) {
    const auto texture =
        make<Texture>(texture_bitmap(), bitmap_of("twelve.exr", twelve_texels(), c.given));
    // Single precision of the peer: coordinates of up to 12 texels, slopes of up to 1 per texel.
    for (const Sample& s : c.samples)
      expect_close(look_up(*texture, s.uv.x, s.uv.y), s.color, 4e-6, c.name);
  }
}

TEST(Bitmap, KnowsItsMeanAndMaximum) {
  const Image image = twelve_texels();
  const auto texture = make<Texture>(texture_bitmap(), bitmap_of("twelve.exr", image));
  Color sum(0);
  Color largest(0);
  for (size_t i = 0; i < image.data.size(); ++i) {
    sum[static_cast<int>(i % 3)] += image.data[i];
    double& most = largest[static_cast<int>(i % 3)];
    most = std::max(most, double{image.data[i]});
  }
  expect_close(texture->mean(), sum / 12.0, 1e-14);
  EXPECT_EQ(texture->maximum(), largest);
  const auto framed = make<Texture>(
      texture_bitmap(), bitmap_of("twelve.exr", image, {{"wrap_mode", std::string("one")}}));
  EXPECT_EQ(framed->maximum(), Color(1));
}

TEST(Bitmap, DecodesIntegersAsSrgbUnlessToldOtherwise) {
  const Image image = test::image_of(2, 1, 3, {0.2, 0.5, 0.9, 0.2, 0.5, 0.9});
  const auto stored = [](double v) { return std::round(255 * linear_to_srgb(v)) / 255; };
  const Color code(stored(0.2), stored(0.5), stored(0.9));
  const auto value = [&](Given given) {
    return look_up(*make<Texture>(texture_bitmap(), bitmap_of("encoded.png", image, given)), 0.3,
                   0.5);
  };
  const Color linear(srgb_to_linear(code.x), srgb_to_linear(code.y), srgb_to_linear(code.z));
  expect_close(value({}), linear, 1e-6);
  expect_close(value({{"gamma", -1.0}}), linear, 1e-6);
  expect_close(value({{"raw", true}}), code, 1e-6);
  expect_close(value({{"gamma", 1.0}}), code, 1e-6);
  expect_close(value({{"gamma", 2.0}}), code * code, 1e-6);
}

TEST(Bitmap, TakesRadianceFormatsAsTheyAre) {
  const Image image = test::image_of(1, 1, 1, {3.5});
  const auto texture = make<Texture>(texture_bitmap(), bitmap_of("grey.exr", image));
  expect_close(look_up(*texture, 0.7, 0.1), Color(3.5), 1e-7);
  EXPECT_EQ(texture->maximum(), Color(3.5));
}

TEST(Bitmap, DropsAlpha) {
  const Image image = test::image_of(1, 1, 4, {0.1, 0.2, 0.3, 0.4});
  const auto texture = make<Texture>(texture_bitmap(), bitmap_of("alpha.exr", image));
  expect_close(look_up(*texture, 0, 0), {0.1, 0.2, 0.3}, 1e-7);
}

TEST(Bitmap, WrapsEachAxisInItsOwnWay) {
  const Image image = test::image_of(2, 2, 1, {0.1, 0.2, 0.3, 0.4});
  const auto texture =
      make<Texture>(texture_bitmap(), bitmap_of("four.exr", image,
                                                {{"wrap_mode_u", std::string("zero")},
                                                 {"wrap_mode_v", std::string("white")},
                                                 {"filter_type", std::string("nearest")}}));
  EXPECT_NEAR(look_up(*texture, 0.25, 0.25).x, 0.1, 1e-7);
  EXPECT_EQ(look_up(*texture, 1.25, 0.25).x, 0);
  EXPECT_EQ(look_up(*texture, -1e30, 0.25).x, 0);
  EXPECT_EQ(look_up(*texture, 0.25, -0.1).x, 1);
  EXPECT_EQ(look_up(*texture, 0.25, 1e300).x, 1);
}

TEST(Bitmap, SurvivesCoordinatesThatAreNoNumbers) {
  for (const char* wrap : {"repeat", "mirror", "clamp", "zero"}) {
    const auto texture =
        make<Texture>(texture_bitmap(),
                      bitmap_of("twelve.exr", twelve_texels(), {{"wrap_mode", std::string(wrap)}}));
    for (double u : {std::nan(""), infinity, -infinity, 1e308, -1e18, 5e-324})
      EXPECT_TRUE(is_finite(look_up(*texture, u, -u))) << u;
  }
}

TEST(Bitmap, TakesTheOlderUvParameters) {
  const Image image = twelve_texels();
  const auto plain = make<Texture>(texture_bitmap(), bitmap_of("twelve.exr", image));
  const auto scaled = make<Texture>(
      texture_bitmap(), bitmap_of("twelve.exr", image, {{"uvscale", 2.0}, {"uoffset", 0.3}}));
  const auto mixed = make<Texture>(
      texture_bitmap(), bitmap_of("twelve.exr", image, {{"uscale", 3.0}, {"voffset", -0.2}}));
  Rng rng(1, Purpose::test, 0);
  for (int i = 0; i < 100; ++i) {
    const double u = rng.next(), v = rng.next();
    expect_close(look_up(*scaled, u, v), look_up(*plain, 2 * u + 0.3, 2 * v), 1e-13);
    expect_close(look_up(*mixed, u, v), look_up(*plain, 3 * u, v - 0.2), 1e-13);
  }
}

TEST(Bitmap, SaysWhatItDoesDifferently) {
  std::vector<std::string> warnings;
  make<Texture>(texture_bitmap(),
                bitmap_of("twelve.exr", twelve_texels(), {{"filter_type", std::string("ewa")}}),
                &warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("read as 'bilinear'")));
  const Image negative = test::image_of(2, 1, 1, {-1, 0.5});
  const auto texture =
      make<Texture>(texture_bitmap(), bitmap_of("negative.exr", negative), &warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("negative values were set to 0")));
  EXPECT_EQ(look_up(*texture, 0.25, 0.5).x, 0);
  const auto raw = make<Texture>(texture_bitmap(),
                                 bitmap_of("negative.exr", negative, {{"raw", true}}), &warnings);
  EXPECT_THAT(warnings, IsEmpty());
  EXPECT_EQ(look_up(*raw, 0.25, 0.5).x, -1);
}

TEST(Bitmap, RefusesWhatItCannotUse) {
  EXPECT_THAT(error_in(texture_bitmap(), {}), HasSubstr("needs 'filename'"));
  const std::string missing =
      error_in(texture_bitmap(), {{"filename", std::string("/no/such.png")}});
  EXPECT_THAT(missing, HasSubstr("scene.xml:7"));
  EXPECT_THAT(missing, HasSubstr("/no/such.png"));
  const Image bad = test::image_of(1, 1, 1, {std::nan("")});
  EXPECT_THAT(error_in(texture_bitmap(), bitmap_of("nan.exr", bad)), HasSubstr("NaN"));
  EXPECT_THAT(error_in(texture_bitmap(), {{"wrap_mode", std::string("mirrored")}}),
              HasSubstr("did you mean 'mirror'"));
  for (double gamma : {0.0, -2.0})
    EXPECT_THAT(
        error_in(texture_bitmap(), bitmap_of("twelve.exr", twelve_texels(), {{"gamma", gamma}})),
        HasSubstr("gamma"));
}

TEST(Checkerboard, AgreesWithMitsuba) {
  const auto board = make<Texture>(texture_checkerboard(), {{"color0", 0.2}, {"color1", 0.8}});
  const double expected[] = {0.2, 0.8, 0.8, 0.2, 0.8, 0.2, 0.2, 0.2};
  const Vec2 uv[] = {{.25, .25},  {.75, .25},  {.25, .75}, {.75, .75},
                     {-.25, .25}, {1.25, .25}, {.5, .1},   {0, .1}};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(look_up(*board, uv[i].x, uv[i].y).x, expected[i]) << i;
  EXPECT_EQ(board->mean().y, 0.5);
  EXPECT_EQ(board->maximum(), Color(0.8));
  const auto standard = make<Texture>(texture_checkerboard());
  EXPECT_EQ(look_up(*standard, 0.1, 0.1).x, 0.4);
  EXPECT_EQ(look_up(*standard, 0.6, 0.1).x, 0.2);
}

TEST(Checkerboard, MayBeNested) {
  const ObjectPtr inner = make<Texture>(texture_checkerboard(), {{"uvscale", 2.0}});
  const auto board = make<Texture>(texture_checkerboard(), {{"color0", inner}, {"color1", 1.0}});
  EXPECT_EQ(look_up(*board, 0.1, 0.1).x, 0.4);
  EXPECT_EQ(look_up(*board, 0.3, 0.1).x, 0.2);
  EXPECT_EQ(look_up(*board, 0.6, 0.1).x, 1);
}

// The helpers through which every plug-in reads its colours.

const Schema& colour_schema() {
  static const Schema schema{"bsdf",
                             "test",
                             "",
                             {{"albedo", ParamType::reflectance, {}, ""},
                              {"power", ParamType::radiance, {}, ""},
                              {"map", ParamType::texture, {}, ""},
                              {"glow", ParamType::emission, {}, ""},
                              {"place", ParamType::transform, {}, ""}}};
  return schema;
}

Params given(const std::string& name, const Value& value) {
  Params params(colour_schema(), {"scene.xml", 3});
  params.set(name, value, {"scene.xml", 4});
  return params;
}

std::string colour_error(const std::string& name, const Value& value) {
  Params params = given(name, value);
  try {
    texture_param(params, name);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

Color colour(const std::string& name, const Value& value) {
  Params params = given(name, value);
  return texture_param(params, name)->mean();
}

TEST(ColourParameters, TakeNumbersTriplesAndSpectra) {
  EXPECT_EQ(colour("albedo", 0.25), Color(0.25));
  EXPECT_EQ(colour("power", int64_t{7}), Color(7));
  EXPECT_EQ(colour("glow", (Triple{1, 2, 3})), Color(1, 2, 3));
  // Mitsuba 3.9.1, scalar_rgb, for the same reflectance.
  const WavelengthTable ramp{{400, 0.2}, {550, 0.5}, {700, 0.7}};
  expect_close(colour("map", ramp), {0.626819, 0.483389, 0.28201}, 2e-3);
  // ... and for <spectrum name="radiance" value="2"/>.
  expect_close(colour("glow", WavelengthTable{{0, 2}}), {2.40959, 1.89658, 1.81783}, 1e-3);
  EXPECT_EQ(colour("map", WavelengthTable{{0, 0.5}}), Color(0.5));
}

TEST(Bitmap, GradientIsThatOfTheLuminance) {
  const Matrix turned{1.5, 0.4, 0, 0.1, -0.3, 2, 0, 0.2, 0, 0, 1, 0, 0, 0, 0, 1};
  for (const char* wrap : {"repeat", "mirror", "clamp"}) {
    const auto texture = make<Texture>(
        texture_bitmap(), bitmap_of("gradient.exr", twelve_texels(),
                                    {{"wrap_mode", std::string(wrap)}, {"to_uv", turned}}));
    Rng rng(1, Purpose::test, 0);
    int compared = 0;
    for (int i = 0; i < 200; ++i) {
      SurfacePoint at;
      at.uv = {4 * rng.next() - 2, 4 * rng.next() - 2};
      const Vec2 gradient = texture->gradient(at);
      const double h = 1e-6, u = at.uv.x, v = at.uv.y;
      const auto value = [&](double a, double b) { return luminance(look_up(*texture, a, b)); };
      const Vec2 slope((value(u + h, v) - value(u - h, v)) / (2 * h),
                       (value(u, v + h) - value(u, v - h)) / (2 * h));
      compared += glm::length(gradient - slope) < 1e-6;
    }
    EXPECT_GE(compared, 199) << wrap;  // The slope may change on the way.
  }
}

TEST(ScaleTexture, MultipliesWhatIsNested) {
  const Plugin plugin = texture_scale();
  Params params(plugin.schema, {"scene.xml", 7});
  params.set("scale", -2.0, {"scene.xml", 8});
  const auto inner = make<Texture>(texture_bitmap(), bitmap_of("scaled.exr", twelve_texels()));
  params.add("texture", inner, {"scene.xml", 9});
  const auto scaled = std::dynamic_pointer_cast<Texture>(make_object(plugin, params));
  SurfacePoint at;
  at.uv = {0.3, 0.6};
  EXPECT_EQ(scaled->eval(at), -2.0 * inner->eval(at));
  EXPECT_EQ(scaled->gradient(at), -2.0 * inner->gradient(at));
  EXPECT_EQ(scaled->mean(), -2.0 * inner->mean());
}

TEST(MixTexture, IsLinearInItsAmount) {
  const auto image = make<Texture>(texture_bitmap(), bitmap_of("mixed.exr", twelve_texels()));
  const auto amount =
      make<Texture>(texture_bitmap(), bitmap_of("amount.exr", twelve_texels(), {{"uoffset", 0.3}}));
  const Triple green = {0.1, 0.8, 0.2};
  const auto mix =
      make<Texture>(texture_mix(), {{"first", image}, {"second", green}, {"amount", amount}});
  SurfacePoint at;
  Rng rng(3, Purpose::test, 0);
  for (int i = 0; i < 100; ++i) {
    at.uv = {rng.next(), rng.next()};
    const Color share = amount->eval(at).rgb(), first = image->eval(at).rgb();
    for (int c = 0; c < 3; ++c) {
      const double expected = (1 - share[c]) * first[c] + share[c] * green[size_t(c)];
      EXPECT_NEAR(mix->eval(at).rgb()[c], std::max(expected, 0.0), 1e-14);
      EXPECT_LE(expected, mix->maximum()[c]);
    }
  }
}

TEST(MixTexture, HasTheGradientOfItsValues) {
  const auto grey = [](const std::string& name, double offset) {
    Image image(4, 3, 1);
    for (size_t i = 0; i < image.data.size(); ++i)
      image.data[i] = static_cast<float>(i * 5 % 12) / 12;
    return make<Texture>(texture_bitmap(), bitmap_of(name, image, {{"uoffset", offset}}));
  };
  const auto mix = make<Texture>(texture_mix(), {{"first", grey("a.exr", 0)},
                                                 {"second", grey("b.exr", 0.2)},
                                                 {"amount", grey("c.exr", 0.6)}});
  const double u = 0.31, v = 0.43, h = 1e-5;
  const auto value = [&](double u_, double v_) {
    SurfacePoint at;
    at.uv = {u_, v_};
    return luminance(mix->eval(at).rgb());
  };
  SurfacePoint at;
  at.uv = {u, v};
  const Vec2 slope((value(u + h, v) - value(u - h, v)) / (2 * h),
                   (value(u, v + h) - value(u, v - h)) / (2 * h));
  EXPECT_LT(glm::length(mix->gradient(at) - slope), 1e-6);
}

TEST(ColourParameters, AreBounded) {
  for (const char* name : {"albedo", "map"}) {
    EXPECT_THAT(colour_error(name, 1.5), HasSubstr("scene.xml:4"));
    EXPECT_THAT(colour_error(name, (Triple{0, 1.01, 0})), HasSubstr("between 0 and 1"));
    EXPECT_EQ(colour_error(name, 1.0), "");
  }
  for (const char* name : {"albedo", "map", "power", "glow"})
    EXPECT_THAT(colour_error(name, (Triple{1, 1, -0.1})), HasSubstr("negative"));
  EXPECT_EQ(colour_error("power", 1e6), "");
  EXPECT_THAT(colour_error("map", std::make_shared<Object>()), HasSubstr("not a texture"));
  EXPECT_THAT(colour_error("glow", (WavelengthTable{{500, 1}, {400, 1}})), HasSubstr("spectrum"));
}

TEST(MatrixParameter, IsReadRowByRowAndMayBeMissing) {
  Params params(colour_schema(), {});
  EXPECT_EQ(matrix_param(params, "place"), Mat4(1));
  Matrix rows = test::identity_rows;
  rows[3] = 5;
  rows[7] = 6;
  params.set("place", rows, {});
  EXPECT_EQ(transform_point(matrix_param(params, "place"), Vec3(1, 1, 1)), Vec3(6, 7, 1));
}

/// A roughness does not depend on the wavelength, whatever colour a scene gives for it.
TEST(Texture, ScalarsAreTheSameAtAllWavelengths) {
  const auto board = make<Texture>(texture_checkerboard(), {{"color0", Triple{0.1, 0.5, 0.9}}});
  const auto image = make<Texture>(
      texture_bitmap(), {{"filename", test::temporary_image("twelve.exr", twelve_texels())}});
  for (const TexturePtr& texture : {TexturePtr(board), TexturePtr(image)}) {
    SurfacePoint at;
    at.uv = {0.2, 0.3};
    const double in_rgb = texture->eval_scalar(at);
    at.wavelength = 0.7;
    EXPECT_EQ(texture->eval_scalar(at), in_rgb);
  }
}

TEST(Texture, ScalarIsTheMeanOfTheChannels) {
  EXPECT_DOUBLE_EQ(constant_texture({Color(1, 2, 6), RgbMeaning::coefficient})->eval_scalar({}), 3);
}

}  // namespace
}  // namespace mlt
