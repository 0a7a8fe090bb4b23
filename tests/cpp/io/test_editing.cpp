// Scenes that are made of other scenes: what they share, and the names of what can be changed.
#include <gtest/gtest.h>

#include "io/editing.h"
#include "io/load.h"
#include "job/plugins.h"
#include "scene/mesh/mesh.h"

namespace mlt {
namespace {

constexpr char text[] =
    "<scene version='3.0.0'><sensor type='perspective'/>"
    "<bsdf type='diffuse' id='clay'/>"
    "<shape type='cube' id='box'><ref id='clay'/><emitter type='area'/></shape>"
    "<shape type='sphere'/><shape type='sphere'/></scene>";

LoadedScene load() { return load_string(text, ".", plugins(), {}); }

LoadedScene changed(const LoadedScene& loaded, const std::string& name, const Value& value) {
  Node tree = loaded.tree;
  const std::vector<NamedNode> nodes = name_nodes(tree, plugins());
  const NamedParameter named = find_parameter(nodes, name);
  Node given;
  given.properties.push_back({named.parameter->name, value, {}});
  apply({{named.plugin, given}});
  return build_again(loaded, tree, plugins());
}

const Mesh& box(const LoadedScene& loaded) { return *loaded.scene->shapes()[0]->as_mesh(); }

TEST(Editing, ACameraOrAMaterialLeavesBuffersAndHierarchyAsTheyAre) {
  const LoadedScene loaded = load();
  for (const char* name : {"sensor.fov", "clay.reflectance", "box.emitter.radiance"}) {
    const LoadedScene other = changed(loaded, name, 0.5);
    EXPECT_EQ(&other.scene->accel(), &loaded.scene->accel()) << name;
    EXPECT_EQ(&box(other).data(), &box(loaded).data()) << name;
    EXPECT_NE(&box(other), &box(loaded)) << name;
    EXPECT_NE(other.hash, loaded.hash) << name;
  }
  EXPECT_EQ(&changed(loaded, "sensor.fov", 0.5).scene->shapes()[0]->bsdf(),
            &loaded.scene->shapes()[0]->bsdf());
}

TEST(Editing, AShapeThatMovesHasAHierarchyOfItsOwn) {
  const LoadedScene loaded = load();
  const LoadedScene other = changed(loaded, "shape_1.radius", 0.5);
  EXPECT_NE(&other.scene->accel(), &loaded.scene->accel());
  EXPECT_EQ(&box(other).data(), &box(loaded).data());
}

TEST(Editing, TheValueThatWasThereMakesTheSameScene) {
  const LoadedScene loaded = changed(load(), "sensor.fov", 30.0);
  EXPECT_EQ(changed(changed(loaded, "sensor.fov", 50.0), "sensor.fov", 30.0).hash, loaded.hash);
}

TEST(Editing, NamesAreIdsOrPlaces) {
  LoadedScene loaded = load();
  std::vector<std::string> names;
  for (const NamedNode& plugin : name_nodes(loaded.tree, plugins())) names.push_back(plugin.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"sensor", "clay", "box", "box.emitter", "shape", "shape_1"}));
  EXPECT_THROW(changed(loaded, "box.bsdf", 0.5), UsageError);
}

}  // namespace
}  // namespace mlt
