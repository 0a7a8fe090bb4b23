// Scenes as bytes: built again elsewhere they are the same scene.
#include <gtest/gtest.h>

#include "io/pack.h"
#include "job/plugins.h"
#include "scene_files.h"

#include <filesystem>

namespace mlt {
namespace {

class Pack : public test::SceneFiles {
 protected:
  LoadedScene load(const LoadOptions& options = {}) const {
    write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    return load_file(write("scene.xml",
                           "<scene><sensor type='perspective'><transform name='to_world'>"
                           "<lookat origin='0, 0, 4' target='0, 0, 0' up='0, 1, 0'/></transform>"
                           "<film type='hdrfilm'><string name='filename' value='to_write.exr'/>"
                           "</film></sensor><integrator type='bdpt'/>"
                           "<bsdf type='diffuse' id='a'><spectrum name='reflectance' "
                           "value='400:0.1, 500:0.7, 600:0.2'/></bsdf>"
                           "<shape type='obj'><string name='filename' value='mesh.obj'/>"
                           "<ref id='a'/></shape><emitter type='constant'/></scene>"),
                     plugins(), options);
  }
};

TEST_F(Pack, TheSceneIsTheSameWithoutItsFiles) {
  LoadOptions options;
  options.size = Vec2i(7, 5);
  const LoadedScene loaded = load(options);
  const std::string packed = pack(loaded);
  std::filesystem::remove(path("mesh.obj"));
  const LoadedScene again = unpack_scene(packed, plugins());
  EXPECT_EQ(again.hash, loaded.hash);
  EXPECT_EQ(again.scene->triangle_count(), 1u);
  EXPECT_EQ(again.size, loaded.size);
  EXPECT_EQ(again.scene->camera().raster().size, loaded.scene->camera().raster().size);
  ASSERT_TRUE(again.integrator);
  EXPECT_EQ(again.integrator->type, "bdpt");
}

TEST_F(Pack, RemembersWhereTheFilesWere) {
  const LoadedScene loaded = load();
  const std::string packed = pack(loaded);
  EXPECT_EQ(pack(unpack_scene(packed, plugins())), packed);
}

TEST_F(Pack, RefusesDamagedBytes) {
  const std::string packed = pack(load());
  for (size_t size = 0; size < packed.size(); size += 37)
    EXPECT_THROW(unpack_scene(packed.substr(0, size), plugins()), RenderError) << size;
  EXPECT_THROW(unpack_scene(packed + '\0', plugins()), RenderError);
}

}  // namespace
}  // namespace mlt
