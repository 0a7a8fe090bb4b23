// The table of plug-ins, and what it says about names that it does not have.
#include <gtest/gtest.h>

#include "base/registry.h"

namespace mlt {
namespace {

ObjectPtr make_nothing(Params&) { return std::make_shared<Object>(); }

Plugin plugin(const std::string& family, const std::string& name) {
  Schema schema;
  schema.family = family;
  schema.name = name;
  return {schema, make_nothing};
}

Registry example() {
  Registry registry;
  registry.add(plugin("bsdf", "diffuse"));
  registry.add(plugin("bsdf", "conductor"));
  registry.add(plugin("shape", "sphere"));
  registry.refuse("bsdf", "measured", "measured materials are not supported");
  registry.refuse("medium", "heterogeneous", "grids are not supported");
  return registry;
}

std::string error_of(const Registry& registry, const std::string& family, const std::string& name) {
  try {
    registry.find(family, name, {"s.xml", 4});
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Registry, FindsWhatWasAdded) {
  const Registry registry = example();
  EXPECT_EQ(registry.find("bsdf", "diffuse", {}).schema.name, "diffuse");
  EXPECT_EQ(registry.names("bsdf"), (std::vector<std::string>{"conductor", "diffuse"}));
  EXPECT_EQ(registry.names("medium"), std::vector<std::string>{});
  EXPECT_EQ(registry.families(), (std::vector<std::string>{"bsdf", "shape"}));
}

TEST(Registry, SuggestsWhatWasMeant) {
  EXPECT_EQ(error_of(example(), "bsdf", "difuse"),
            "s.xml:4: unknown bsdf 'difuse'; did you mean 'diffuse'?");
  EXPECT_EQ(error_of(example(), "bsdf", "velvet_curtain"),
            "s.xml:4: unknown bsdf 'velvet_curtain'; valid are: conductor, diffuse");
  EXPECT_EQ(error_of(example(), "shap", "sphere"),
            "s.xml:4: unknown element 'shap'; did you mean 'shape'?");
}

TEST(Registry, RefusesByNameWithTheReason) {
  EXPECT_EQ(error_of(example(), "bsdf", "measured"),
            "s.xml:4: bsdf 'measured' is not supported: measured materials are not supported");
}

TEST(Registry, RefusesInFamiliesThatHaveNoPlugin) {
  EXPECT_EQ(error_of(example(), "medium", "heterogeneous"),
            "s.xml:4: medium 'heterogeneous' is not supported: grids are not supported");
}

TEST(Registry, KnowsPlugInsByOtherNames) {
  Registry registry = example();
  registry.alias("bsdf", "lambertian", "diffuse");
  EXPECT_EQ(registry.find("bsdf", "lambertian", {}).schema.name, "diffuse");
  EXPECT_TRUE(registry.has("bsdf", "lambertian"));
  EXPECT_EQ(registry.names("bsdf"), (std::vector<std::string>{"conductor", "diffuse"}));
  EXPECT_THROW(registry.alias("bsdf", "diffuse", "conductor"), Error);
}

TEST(Registry, NoNameIsRegisteredOrRefusedTwice) {
  Registry registry = example();
  EXPECT_THROW(registry.add(plugin("bsdf", "diffuse")), Error);
  EXPECT_THROW(registry.refuse("bsdf", "diffuse", "not implemented yet"), Error);
  EXPECT_THROW(registry.add(plugin("bsdf", "measured")), Error);
  EXPECT_THROW(registry.refuse("bsdf", "measured", "again"), Error);
  registry.add(plugin("shape", "diffuse"));
  EXPECT_EQ(error_of(registry, "bsdf", "diffuse"), "no error");
}

TEST(Registry, KnowsTheFamiliesOfAName) {
  Registry registry = example();
  registry.refuse("shape", "measured", "no");
  EXPECT_EQ(registry.families_of("measured"), (std::vector<std::string>{"bsdf", "shape"}));
  EXPECT_EQ(registry.families_of("sphere"), std::vector<std::string>{"shape"});
  EXPECT_TRUE(registry.families_of("nothing").empty());
}

}  // namespace
}  // namespace mlt
