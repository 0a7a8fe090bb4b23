// Names of parameters, in the two spellings that scenes use.
#include <gtest/gtest.h>

#include "base/schema.h"

namespace mlt {
namespace {

TEST(SnakeCase, TranslatesTheOlderSpelling) {
  EXPECT_EQ(snake_case("toWorld"), "to_world");
  EXPECT_EQ(snake_case("maxDepth"), "max_depth");
  EXPECT_EQ(snake_case("rrDepth"), "rr_depth");
  EXPECT_EQ(snake_case("intIOR"), "int_ior");
  EXPECT_EQ(snake_case("specularSamplingWeight"), "specular_sampling_weight");
  EXPECT_EQ(snake_case("fovAxis"), "fov_axis");
}

TEST(SnakeCase, LeavesTheNewerSpellingAlone) {
  for (const char* name : {"to_world", "alpha", "p_large", "", "filter_type", "_x"})
    EXPECT_EQ(snake_case(name), name);
}

TEST(SnakeCase, LowersWhatStandsAlone) {
  EXPECT_EQ(snake_case("B"), "b");
  EXPECT_EQ(snake_case("IOR"), "ior");
}

TEST(Schema, FindsParametersByName) {
  Schema schema;
  schema.parameters = {{"radius", ParamType::real, 1.0, "Radius."},
                       {"center", ParamType::point, {}, "Centre."}};
  ASSERT_NE(schema.find("center"), nullptr);
  EXPECT_EQ(schema.find("center")->type, ParamType::point);
  EXPECT_EQ(schema.find("centre"), nullptr);
  EXPECT_EQ(schema.parameter_names(), (std::vector<std::string>{"radius", "center"}));
}

TEST(Schema, NamesEveryType) {
  for (int type = 0; type <= static_cast<int>(ParamType::object); ++type)
    EXPECT_FALSE(to_string(static_cast<ParamType>(type)).empty()) << type;
}

}  // namespace
}  // namespace mlt
