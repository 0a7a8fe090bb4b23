// The elements that are values, in both dialects.
#include <gtest/gtest.h>

#include <cmath>

#include "io/load.h"
#include "io/values.h"
#include "scene_files.h"

namespace mlt {
namespace {

Value read(const std::string& element) {
  std::vector<std::string> warnings;
  const Node bsdf =
      read_xml_string("<bsdf type='diffuse'>\n" + element + "</bsdf>", "", {}, warnings);
  return bsdf.properties.at(0).value;
}

std::string error_of(const std::string& element) {
  return test::message_of([&] { read(element); });
}

TEST(Values, Scalars) {
  EXPECT_EQ(read("<float name='a' value='1e-005'/>"), Value(1e-5));
  EXPECT_EQ(read("<float name='a' value=' .5 '/>"), Value(0.5));
  EXPECT_EQ(read("<integer name='a' value='-1'/>"), Value(int64_t{-1}));
  EXPECT_EQ(read("<boolean name='a' value='True'/>"), Value(true));
  EXPECT_EQ(read("<string name='a' value=' two words '/>"), Value(std::string(" two words ")));
  EXPECT_EQ(read("<string name='a' value=''/>"), Value(std::string()));
}

TEST(Values, PointsAndVectors) {
  EXPECT_EQ(read("<point name='a' x='1' y='2' z='3'/>"), Value(Triple{1, 2, 3}));
  EXPECT_EQ(read("<vector name='a' z='3'/>"), Value(Triple{0, 0, 3}));
  EXPECT_EQ(read("<vector name='a' value='1,2 3'/>"), Value(Triple{1, 2, 3}));
}

TEST(Values, Colours) {
  EXPECT_EQ(read("<rgb name='a' value='.5'/>"), Value(Triple{0.5, 0.5, 0.5}));
  EXPECT_EQ(read("<rgb name='a' value='1, 2 ,3'/>"), Value(Triple{1, 2, 3}));
  EXPECT_EQ(read("<spectrum name='a' value='0.789000'/>"), Value(0.789));
  EXPECT_EQ(read("<spectrum name='a' value='1,2,3'/>"), Value(Triple{1, 2, 3}));
  EXPECT_EQ(read("<spectrum name='a' value='400:0, 500:8, 600:15.6'/>"),
            Value(WavelengthTable{{400, 0}, {500, 8}, {600, 15.6}}));
}

TEST(Values, ASpectrumOfOneNumberHoldsForAllWavelengthsSinceMitsuba2) {
  const auto in_scene = [](const std::string& version) {
    std::vector<std::string> warnings;
    const Node scene = read_xml_string("<scene" + version +
                                           "><bsdf type='diffuse'><spectrum name='a' value='2'/>"
                                           "<float name='b' value='2'/></bsdf></scene>",
                                       "", {}, warnings);
    const Node& bsdf = scene.children.at(0);
    EXPECT_EQ(bsdf.properties.at(1).value, Value(2.0));
    return bsdf.properties.at(0).value;
  };
  for (const char* old : {"", " version='0.5.0'", " version='0.6.0'", " version='1.9'"})
    EXPECT_EQ(in_scene(old), Value(2.0)) << old;
  for (const char* modern : {" version='2.0.0'", " version='2.1.0'", " version='3.0.0'"})
    EXPECT_EQ(in_scene(modern), Value(constant_spectrum(2))) << modern;
}

TEST(Values, CodesOfColoursAreSrgbAndBecomeLinear) {
  for (const char* element :
       {"<rgb name='a' value='#ff8000'/>", "<srgb name='a' value=' #FF8000 '/>",
        "<spectrum name='a' value='#ff8000'/>",
        "<srgb name='a' value='1, 0.501960784313725, 0'/>"}) {
    const Triple c = std::get<Triple>(read(element));
    EXPECT_EQ(c[0], 1);
    EXPECT_NEAR(c[1], std::pow((128 / 255.0 + 0.055) / 1.055, 2.4), 1e-12) << element;
    EXPECT_EQ(c[2], 0);
  }
}

TEST(Values, SayWhatIsWrong) {
  const std::string start = "<string>:2: ";
  EXPECT_EQ(error_of("<float name='fov' value='wide'/>"),
            start + "float 'fov' is 'wide', but should be a number such as 0.5");
  EXPECT_EQ(error_of("<float name='fov' value='nan'/>"),
            start + "float 'fov' is 'nan', but should be a number such as 0.5");
  EXPECT_EQ(error_of("<float name='fov' value=''/>"),
            start + "float 'fov' has an empty attribute 'value'");
  EXPECT_EQ(error_of("<float name='fov'/>"), start + "float 'fov' needs the attribute 'value'");
  EXPECT_EQ(error_of("<float value='1'/>"), start + "<float> needs the attribute 'name'");
  EXPECT_EQ(error_of("<float name='fov' valeu='1'/>"),
            start + "float 'fov' has no attribute 'valeu'; did you mean 'value'?");
  EXPECT_EQ(error_of("<integer name='n' value='8.5'/>"),
            start + "integer 'n' is '8.5', but should be a whole number such as 8");
  EXPECT_EQ(error_of("<boolean name='b' value='yes'/>"),
            start + "boolean 'b' is 'yes', but should be true or false");
  EXPECT_EQ(error_of("<rgb name='c' value='1,2'/>"),
            start + "rgb 'c' is '1,2', but should be one number, three, or #rrggbb");
  EXPECT_EQ(error_of("<rgb name='c' value='#12345'/>"),
            start + "rgb 'c' is '#12345', but should be one number, three, or #rrggbb");
  EXPECT_EQ(error_of("<rgb name='c' value='inf'/>"),
            start + "rgb 'c' is 'inf', but should be one number, three, or #rrggbb");
  EXPECT_EQ(error_of("<point name='p' value='1,2'/>"),
            start + "point 'p' is '1,2', but should be three numbers such as 0, 1, 2");
  const std::string spectrum =
      ", but should be one number, three (RGB), or pairs such as 400:0.1, 700:0.3 by wavelength";
  EXPECT_EQ(error_of("<spectrum name='s' value='1,2'/>"),
            start + "spectrum 's' is '1,2'" + spectrum);
  EXPECT_EQ(error_of("<spectrum name='s' value='500:1, 400:2'/>"),
            start + "spectrum 's' is '500:1, 400:2'" + spectrum);
  EXPECT_EQ(error_of("<spectrum name='s' value='500:1:2, 600:1'/>"),
            start + "spectrum 's' is '500:1:2, 600:1'" + spectrum);
  EXPECT_EQ(error_of("<float name='f' value='1'><float name='g' value='1'/></float>"),
            start + "float 'f' should be empty, but has something inside");
}

using SpectrumFile = test::SceneFiles;

TEST_F(SpectrumFile, IsATableOfWavelengths) {
  write("a.spd", "# measured\n400 0.1\n\n  500\t.2 # here\r\n600, 0.3");
  std::vector<std::string> warnings;
  const Node bsdf = read_xml_string(
      "<bsdf type='diffuse'><spectrum name='a' filename='a.spd'/></bsdf>", path(""), {}, warnings);
  EXPECT_EQ(bsdf.properties[0].value, Value(WavelengthTable{{400, 0.1}, {500, 0.2}, {600, 0.3}}));
}

TEST_F(SpectrumFile, MayHaveTheMarkAndLineEndsOfOtherSystems) {
  write("a.spd", "\xef\xbb\xbf# measured\r400 0.1\r500 0.2\r\n600 0.3\r");
  std::vector<std::string> warnings;
  const Node bsdf = read_xml_string(
      "<bsdf type='diffuse'><spectrum name='a' filename='a.spd'/></bsdf>", path(""), {}, warnings);
  EXPECT_EQ(bsdf.properties[0].value, Value(WavelengthTable{{400, 0.1}, {500, 0.2}, {600, 0.3}}));
}

TEST_F(SpectrumFile, NamesTheLineThatIsWrong) {
  write("a.spd", "400 0.1\n500 x\n");
  std::vector<std::string> warnings;
  EXPECT_EQ(test::message_of([&] {
              read_xml_string("<bsdf type='diffuse'><spectrum name='a' filename='a.spd'/></bsdf>",
                              path(""), {}, warnings);
            }),
            path("a.spd") + ":2: '500 x' should be a wavelength and a value");
}

TEST_F(SpectrumFile, MustNotBeEmpty) {
  write("a.spd", "# nothing\n\n");
  std::vector<std::string> warnings;
  EXPECT_EQ(test::message_of([&] {
              read_xml_string("<bsdf type='diffuse'><spectrum name='a' filename='a.spd'/></bsdf>",
                              path(""), {}, warnings);
            }),
            path("a.spd") + ": the file of a spectrum is empty");
}

Value from_command_line(const std::string& text, ParamType type) {
  return parse_value(text, {"max_depth", type, {}, ""});
}

TEST(CommandLineValue, FollowsTheTypeOfTheParameter) {
  EXPECT_EQ(from_command_line("8", ParamType::integer), Value(int64_t{8}));
  EXPECT_EQ(from_command_line("8", ParamType::real), Value(8.0));
  EXPECT_EQ(from_command_line("8", ParamType::text), Value(std::string("8")));
  EXPECT_EQ(from_command_line("TRUE", ParamType::boolean), Value(true));
  EXPECT_EQ(from_command_line("1 2,3", ParamType::point), Value(Triple{1, 2, 3}));
  EXPECT_EQ(from_command_line("0.5", ParamType::texture), Value(0.5));
  EXPECT_EQ(from_command_line("400:1 500:2", ParamType::radiance),
            Value(WavelengthTable{{400, 1}, {500, 2}}));
  EXPECT_EQ(from_command_line("1.5", ParamType::ior), Value(1.5));
  EXPECT_EQ(from_command_line("bk7", ParamType::ior), Value(std::string("bk7")));
}

TEST(CommandLineValue, SaysWhatWouldBeRight) {
  EXPECT_EQ(test::message_of([] { from_command_line("eight", ParamType::integer); }),
            "'max_depth' is 'eight', but should be a whole number such as 8");
  EXPECT_THROW(from_command_line("1 2", ParamType::point), UsageError);
  EXPECT_THROW(from_command_line("x", ParamType::object), UsageError);
  EXPECT_THROW(from_command_line("1", ParamType::transform), UsageError);
}

}  // namespace
}  // namespace mlt
