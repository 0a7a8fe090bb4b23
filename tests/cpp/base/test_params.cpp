// Parameters are checked as they are given and tracked as they are read; every mistake has a
// message of its own, which names the place, the plug-in and the parameter.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "base/params.h"

namespace mlt {
namespace {

struct Lamp : Object {};
struct Stone : Object {};

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinite = std::numeric_limits<double>::infinity();

Schema example_schema() {
  Schema schema;
  schema.family = "integrator";
  schema.name = "demo";
  schema.parameters = {{"max_depth", ParamType::integer, int64_t{-1}, "Longest path."},
                       {"strict", ParamType::boolean, false, "Strict normals."},
                       {"radius", ParamType::real, 1.5, "A radius."},
                       {"needed", ParamType::real, {}, "What cannot be guessed."},
                       {"mode", ParamType::text, std::string("fast"), "How.", {"fast", "slow"}},
                       {"title", ParamType::text, std::string("none"), "Any text."},
                       {"origin", ParamType::point, Triple{0, 0, 0}, "Where."},
                       {"to_world", ParamType::transform, {}, "A transform."},
                       {"albedo", ParamType::reflectance, 0.5, "How white."},
                       {"power", ParamType::radiance, 1.0, "How bright."},
                       {"pattern", ParamType::texture, 0.5, "How coloured."},
                       {"glow", ParamType::emission, 1.0, "How shining."},
                       {"int_ior", ParamType::ior, 1.5, "Index."},
                       {"lamp", ParamType::object, {}, "A lamp."}};
  schema.ignored = {"banner", "near_clip"};
  return schema;
}

/// The message of the SceneError that `action` throws, or "no error".
std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

class ParamsTest : public testing::Test {
 protected:
  std::string error_of_set(const std::string& name, Value value) {
    return message_of([&] { params.set(name, std::move(value), {"s.xml", 7}); });
  }
  void set(const std::string& name, Value value) {
    params.set(name, std::move(value), {"s.xml", 7});
  }

  Schema schema = example_schema();
  Params params{schema, {"s.xml", 3}, "it"};
};

const std::string here = "s.xml:7: integrator 'demo': ";

TEST_F(ParamsTest, UnknownNamesAreRefusedWithTheNameThatWasMeant) {
  EXPECT_EQ(
      error_of_set("max_dpeth", int64_t{3}),
      "s.xml:7: unknown parameter 'max_dpeth' for integrator 'demo'; did you mean 'max_depth'?");
  EXPECT_EQ(
      error_of_set("maxDpeth", int64_t{3}),
      "s.xml:7: unknown parameter 'maxDpeth' for integrator 'demo'; did you mean 'max_depth'?");
}

TEST_F(ParamsTest, UnknownNamesThatAreNearNothingGetTheWholeList) {
  const std::string message = error_of_set("xyzzy_plugh", 1.0);
  EXPECT_EQ(
      message.find("s.xml:7: unknown parameter 'xyzzy_plugh' for integrator 'demo'; valid are: "
                   "max_depth, strict, radius,"),
      0u)
      << message;
}

TEST_F(ParamsTest, TheOlderSpellingIsAccepted) {
  set("maxDepth", int64_t{5});
  set("intIOR", 1.3);
  EXPECT_EQ(params.integer("max_depth"), 5);
  EXPECT_EQ(params.real("int_ior"), 1.3);
}

TEST_F(ParamsTest, AWrongTypeNamesBothTypes) {
  EXPECT_EQ(error_of_set("max_depth", 1.5),
            here + "'max_depth' is a float, but should be an integer");
  EXPECT_EQ(error_of_set("radius", std::string("big")),
            here + "'radius' is a string, but should be a float");
  EXPECT_EQ(error_of_set("strict", int64_t{1}),
            here + "'strict' is an integer, but should be a boolean");
  EXPECT_EQ(error_of_set("title", true), here + "'title' is a boolean, but should be a string");
  EXPECT_EQ(error_of_set("origin", Matrix{}),
            here + "'origin' is a matrix, but should be a point or vector");
  EXPECT_EQ(error_of_set("to_world", Triple{}),
            here + "'to_world' is a triple, but should be a transform");
  EXPECT_EQ(error_of_set("lamp", WavelengthTable{}),
            here + "'lamp' is a spectrum, but should be a nested object");
  EXPECT_EQ(error_of_set("albedo", std::string("red")),
            here + "'albedo' is a string, but should be a reflectance (number, rgb or spectrum)");
  EXPECT_EQ(error_of_set("radius", Value()), here + "'radius' is nothing, but should be a float");
}

TEST_F(ParamsTest, EachTypeTakesWhatItSays) {
  const ObjectPtr object = std::make_shared<Lamp>();
  const std::vector<Value> values{true,
                                  int64_t{1},
                                  1.0,
                                  std::string("fast"),
                                  Triple{1, 1, 1},
                                  Matrix{},
                                  WavelengthTable{{500, 1}},
                                  object};
  const std::string kinds = "bifstmSo";  // of the values above
  const std::map<std::string, std::string> accepted{
      {"strict", "b"},      {"max_depth", "i"}, {"radius", "if"},    {"title", "s"},
      {"origin", "t"},      {"to_world", "m"},  {"albedo", "iftSo"}, {"power", "iftSo"},
      {"pattern", "iftSo"}, {"glow", "iftSo"},  {"int_ior", "ifsS"}, {"lamp", "o"}};
  for (const auto& [name, takes] : accepted)
    for (size_t i = 0; i < values.size(); ++i) {
      Params fresh(schema, {});
      const bool ok = message_of([&, n = name] { fresh.set(n, values[i], {}); }) == "no error";
      EXPECT_EQ(ok, takes.find(kinds[i]) != std::string::npos) << name << " " << kinds[i];
    }
}

TEST_F(ParamsTest, NumbersMustBeFinite) {
  EXPECT_EQ(error_of_set("radius", infinite), here + "'radius' must be finite");
  EXPECT_EQ(error_of_set("radius", not_a_number), here + "'radius' must be finite");
  EXPECT_EQ(error_of_set("origin", Triple{0, infinite, 0}), here + "'origin' must be finite");
  Matrix matrix{};
  matrix[15] = not_a_number;
  EXPECT_EQ(error_of_set("to_world", matrix), here + "'to_world' must be finite");
  EXPECT_EQ(error_of_set("power", WavelengthTable{{400, 1}, {500, infinite}}),
            here + "'power' must be finite");
  EXPECT_EQ(error_of_set("power", WavelengthTable{{not_a_number, 1}}),
            here + "'power' must be finite");
}

TEST_F(ParamsTest, TextIsOneOfTheChoices) {
  EXPECT_EQ(error_of_set("mode", std::string("fats")),
            here + "'mode' cannot be 'fats'; did you mean 'fast'?");
  EXPECT_EQ(error_of_set("mode", std::string("sideways")),
            here + "'mode' cannot be 'sideways'; valid are: fast, slow");
  set("mode", std::string("slow"));
  EXPECT_EQ(params.text("mode"), "slow");
  set("title", std::string("whatever"));
}

TEST_F(ParamsTest, NothingIsGivenTwice) {
  set("max_depth", int64_t{5});
  EXPECT_EQ(error_of_set("max_depth", int64_t{5}), here + "'max_depth' is given twice");
  EXPECT_EQ(error_of_set("maxDepth", int64_t{6}), here + "'max_depth' is given twice");
  EXPECT_EQ(params.integer("max_depth"), 5);
}

TEST_F(ParamsTest, KnownNamesWithoutEffectAreAWarning) {
  set("nearClip", 0.1);
  set("banner", std::string("any type"));
  EXPECT_EQ(params.warnings(), (std::vector<std::string>{here + "'near_clip' has no effect here",
                                                         here + "'banner' has no effect here"}));
  EXPECT_NO_THROW(params.expect_all_read());
}

TEST_F(ParamsTest, DefaultsComeFromTheSchema) {
  EXPECT_EQ(params.integer("max_depth"), -1);
  EXPECT_EQ(params.boolean("strict"), false);
  EXPECT_EQ(params.real("radius"), 1.5);
  EXPECT_EQ(params.text("mode"), "fast");
  EXPECT_EQ(params.triple("origin"), (Triple{0, 0, 0}));
  EXPECT_FALSE(params.has("radius"));
}

TEST_F(ParamsTest, AMissingOneIsAskedForWithItsDoc) {
  EXPECT_EQ(message_of([&] { params.real("needed"); }),
            "s.xml:3: integrator 'demo' needs 'needed': What cannot be guessed.");
}

TEST_F(ParamsTest, AnIntegerServesAsAReal) {
  set("radius", int64_t{2});
  EXPECT_EQ(params.real("radius"), 2.0);
}

TEST_F(ParamsTest, RangesIncludeTheirEnds) {
  set("radius", 1.0);
  set("max_depth", int64_t{4});
  EXPECT_EQ(params.real_in("radius", 0, 1), 1.0);
  EXPECT_EQ(params.real_in("radius", 1, 2), 1.0);
  EXPECT_EQ(params.integer_in("max_depth", 4, 4), 4);
  EXPECT_EQ(message_of([&] { params.real_in("radius", 0, 0.5); }),
            here + "'radius' is 1.000000, but must lie between 0.000000 and 0.500000");
  EXPECT_EQ(message_of([&] { params.integer_in("max_depth", 5, 9); }),
            here + "'max_depth' is 4, but must lie between 5 and 9");
}

TEST_F(ParamsTest, WhatNothingReadsIsAnError) {
  set("radius", 2.0);
  set("strict", true);
  params.boolean("strict");
  EXPECT_EQ(message_of([&] { params.expect_all_read(); }),
            here + "'radius' has no effect with the other parameters given");
  params.real("radius");
  EXPECT_NO_THROW(params.expect_all_read());
}

TEST_F(ParamsTest, AskingWhetherItIsGivenIsNotReading) {
  set("radius", 2.0);
  EXPECT_TRUE(params.has("radius"));
  EXPECT_THROW(params.expect_all_read(), SceneError);
}

TEST_F(ParamsTest, ANestedObjectThatNothingTakesIsAnError) {
  params.add("bsdf", std::make_shared<Stone>(), {"s.xml", 9});
  EXPECT_TRUE(params.has("bsdf"));
  EXPECT_EQ(message_of([&] { params.expect_all_read(); }),
            "s.xml:9: integrator 'demo' does not take a nested bsdf");
}

TEST_F(ParamsTest, ObjectsAreFoundByNameAndByFamily) {
  EXPECT_EQ(params.object<Lamp>("lamp"), nullptr);
  const auto unnamed = std::make_shared<Lamp>(), named = std::make_shared<Lamp>();
  params.add("lamp", unnamed, {});
  EXPECT_EQ(params.object<Lamp>("lamp"), unnamed);
  set("lamp", ObjectPtr(named));
  EXPECT_EQ(params.object<Lamp>("lamp"), named);
  EXPECT_NO_THROW(params.expect_all_read());
}

TEST_F(ParamsTest, AnObjectOfAnotherKindIsNotOverlooked) {
  const auto stone = std::make_shared<Stone>();
  stone->type = "granite";
  set("lamp", ObjectPtr(stone));
  EXPECT_EQ(message_of([&] { params.object<Lamp>("lamp"); }),
            here + "'lamp' cannot be a 'granite'");
}

TEST_F(ParamsTest, AllObjectsOfAKindComeInOrder) {
  const auto a = std::make_shared<Lamp>(), b = std::make_shared<Lamp>();
  params.add("emitter", a, {});
  params.add("bsdf", std::make_shared<Stone>(), {});
  params.add("emitter", b, {});
  EXPECT_EQ(params.objects<Lamp>(), (std::vector<std::shared_ptr<Lamp>>{a, b}));
  EXPECT_THROW(params.expect_all_read(), SceneError);  // the stone
  EXPECT_EQ(params.objects<Stone>().size(), 1u);
  EXPECT_NO_THROW(params.expect_all_read());
}

TEST_F(ParamsTest, APluginFailsWithThePlaceOfItsParameter) {
  set("radius", 2.0);
  EXPECT_EQ(message_of([&] { params.fail("radius", "is odd"); }), here + "'radius' is odd");
  EXPECT_EQ(message_of([&] { params.fail("origin", "is odd"); }),
            "s.xml:3: integrator 'demo': 'origin' is odd");
  EXPECT_EQ(message_of([&] { params.fail("is odd"); }), "s.xml:3: integrator 'demo' is odd");
  params.warn("beware");
  EXPECT_EQ(params.warnings(), std::vector<std::string>{"s.xml:3: integrator 'demo': beware"});
}

TEST_F(ParamsTest, APluginThatReadsWhatItsSchemaLacksIsABug) {
  EXPECT_THROW(params.real("undeclared"), Error);
}

}  // namespace
}  // namespace mlt
