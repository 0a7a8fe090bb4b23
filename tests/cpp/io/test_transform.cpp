// Every form of <transform>, against matrices worked out by hand. "Peer" values were printed once
// by Mitsuba 3.9 for the same XML, but with axes of length 1: it does not normalise them (0.6
// does).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/load.h"
#include "scene_files.h"

namespace mlt {
namespace {

Matrix read(const std::string& steps) {
  std::vector<std::string> warnings;
  const Node shape = read_xml_string(
      "<shape type='sphere'><transform name='toWorld'>" + steps + "</transform></shape>", "", {},
      warnings);
  return std::get<Matrix>(shape.properties.at(0).value);
}

void expect_near(const Matrix& actual, const Matrix& expected, double tolerance = 1e-14) {
  for (size_t i = 0; i < 16; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << "entry " << i;
}

std::string error_of(const std::string& steps) {
  return test::message_of([&] { read(steps); });
}

TEST(Transform, IsTheIdentityWithoutSteps) {
  EXPECT_EQ(read(""), (Matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
}

TEST(Transform, Translates) {
  const Matrix expected{1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1};
  EXPECT_EQ(read("<translate x='1' y='2' z='3'/>"), expected);
  EXPECT_EQ(read("<translate value='1, 2 3'/>"), expected);
  EXPECT_EQ(read("<translate y='2'/>"), (Matrix{1, 0, 0, 0, 0, 1, 0, 2, 0, 0, 1, 0, 0, 0, 0, 1}));
}

TEST(Transform, ScalesWithOneForWhatIsNotGiven) {
  EXPECT_EQ(read("<scale x='2' y='3'/>"), (Matrix{2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
  EXPECT_EQ(read("<scale value='2'/>"), (Matrix{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1}));
  EXPECT_EQ(read("<scale value='2 3 4'/>"),
            (Matrix{2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1}));
}

TEST(Transform, RotatesCounterClockwise) {
  const Matrix about_y{0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1};
  expect_near(read("<rotate y='1' angle='90'/>"), about_y);
  expect_near(read("<rotate y='5' angle='90'/>"), about_y);
  expect_near(read("<rotate value='0,1,0' angle='90'/>"), about_y);
  expect_near(read("<rotate y='1e-200' angle='90'/>"), about_y);
  const Matrix cycle{0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1};  // x -> y -> z -> x
  expect_near(read("<rotate x='1' y='1' z='1' angle='120'/>"), cycle);
}

TEST(Transform, LooksAlongPlusZWithXToTheLeft) {
  const Matrix expected{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 5, 0, 0, 0, 1};
  expect_near(read("<lookat origin='0,0,5' target='0 0 0' up='0,1,0'/>"), expected);
  expect_near(read("<lookAt origin='0,0,5' target='0 0 -1' up='0,7,2'/>"), expected);
}

TEST(Transform, LooksWithAFrameOfItsOwnWithoutUp) {
  const Matrix m = read("<lookat origin='1,2,3' target='4,6,3'/>");
  EXPECT_NEAR(m[2], 0.6, 1e-15);
  EXPECT_NEAR(m[6], 0.8, 1e-15);
  EXPECT_NEAR(m[10], 0, 1e-15);
  for (size_t a = 0; a < 3; ++a)
    for (size_t b = 0; b < 3; ++b)
      EXPECT_NEAR(m[a] * m[b] + m[a + 4] * m[b + 4] + m[a + 8] * m[b + 8], a == b, 1e-14);
}

TEST(Transform, TakesMatricesRowByRow) {
  const Matrix expected{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 0, 1};
  EXPECT_EQ(read("<matrix value='1 2 3 4, 5 6 7 8\n 9,10,11,12 0 0 0 1'/>"), expected);
  EXPECT_EQ(read("<matrix value='1 2 3 4 5 6 7 8 9'/>"),
            (Matrix{1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 0, 0, 0, 1}));
}

TEST(Transform, AppliesStepsInTheOrderOfTheFile) {
  EXPECT_EQ(read("<translate x='1'/><scale value='2'/>"),
            (Matrix{2, 0, 0, 2, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1}));
  EXPECT_EQ(read("<scale value='2'/><translate x='1'/>"),
            (Matrix{2, 0, 0, 1, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1}));
}

TEST(Transform, AgreesWithThePeer) {
  expect_near(
      read("<scale x='1' y='2' z='.5'/><rotate x='1' y='-2' z='.5' angle='37'/>"
           "<matrix value='1 0 0.25 0 0 1 0 0 0 .5 1 2 0 0 0 1'/>"
           "<lookat origin='1,2,3' target='-2,0.5,7' up='.1,1,.2'/>"
           "<translate value='0.5 -1 2'/>"),
      {0.46714839339256287, -1.0727421045303345, -0.3118981420993805, 0.3506084680557251,
       -0.29822003841400146, 1.4428123235702515, -0.2068471610546112, 0.42530423402786255,
       0.9847406148910522, 1.5644038915634155, 0.117683544754982, 6.532522201538086, 0, 0, 0, 1},
      1e-6);
}

TEST(Transform, SaysWhatIsWrong) {
  const std::string start = "<string>:1: ";
  EXPECT_EQ(error_of("<rotate angle='3' x='0'/>"),
            start + "<rotate> turns about the axis 0, 0, 0, which has no direction");
  EXPECT_EQ(error_of("<rotate y='1'/>"), start + "<rotate> needs the attribute 'angle'");
  EXPECT_EQ(error_of("<rotate y='1' angle='right'/>"),
            start + "<rotate> has the angle 'right', but it should be a number of degrees");
  EXPECT_EQ(error_of("<rotate y='one' angle='1'/>"),
            start + "<rotate> has y = 'one', but it should be a number such as 0.5");
  EXPECT_EQ(error_of("<scale/>"),
            start + "<scale> needs 'x', 'y' and 'z', or 'value' with three numbers");
  EXPECT_EQ(error_of("<translate value='1,2'/>"),
            start + "<translate> is '1,2', but should be three numbers such as 0, 1, 2");
  EXPECT_EQ(error_of("<translate value='1,2,3' x='1'/>"),
            start + "<translate> has both 'value' and 'x'");
  EXPECT_EQ(error_of("<translate u='1'/>"),
            start + "<translate> has no attribute 'u'; did you mean 'x'?");
  EXPECT_EQ(error_of("<matrix value='1 2 3'/>"),
            start + "<matrix> has 3 numbers, but should have 16 (or 9)");
  EXPECT_EQ(error_of("<lookat origin='1,1,1' target='1,1,1' up='0,1,0'/>"),
            start + "<lookat> has the same 'origin' and 'target', so it looks nowhere");
  EXPECT_EQ(error_of("<lookat origin='0,0,0' target='0,2,0' up='0,1,0'/>"),
            start + "<lookat> has an 'up' along the line of sight; turn it aside");
  EXPECT_EQ(error_of("<lookat origin='0,0,0' target='0,2'/>"),
            start + "<lookat> has target = '0,2', but it should be three numbers such as 0, 1, 2");
  EXPECT_EQ(error_of("<scal value='2'/>"),
            start + "<scal> does not belong in a <transform>; did you mean 'scale'?");
}

}  // namespace
}  // namespace mlt
