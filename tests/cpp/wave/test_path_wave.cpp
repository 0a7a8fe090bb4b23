// Paths traced side by side are those that trace_path traces one by one.
#include <gtest/gtest.h>

#include "scenes.h"
#include "wave/path_wave.h"

namespace mlt {
namespace {

using namespace test;

constexpr int waves = 4;

struct Traced {
  std::vector<Color> radiance;
  RayCounts rays;
};

/// Calls start(ray, sampler) for the paths of one wave.
template <class Start>
void start_paths(const Scene& scene, int wave, Start&& start) {
  for (uint32_t i = 0; i < PathWave::capacity; ++i) {
    PixelSampler sampler(7 + wave + 1000 * (i / 8), i);  // eight of each stream
    const Vec2 raster = scene.camera().raster().sample(sampler.next2());
    const Ray ray = camera_ray(scene.camera(), raster, sampler).ray;
    start(ray, sampler);
  }
}

Traced one_by_one(const Scene& scene, const PathRules& rules) {
  Traced traced;
  for (int w = 0; w < waves; ++w)
    start_paths(scene, w, [&](const Ray& ray, PixelSampler& sampler) {
      traced.radiance.push_back(trace_path(scene, rules, ray, sampler, traced.rays));
    });
  return traced;
}

Traced side_by_side(const Scene& scene, const PathRules& rules) {
  Traced traced;
  PathWave wavefront(scene, rules);
  for (int w = 0; w < waves; ++w) {
    start_paths(scene, w, [&](const Ray& ray, PixelSampler& sampler) {
      EXPECT_FALSE(wavefront.full());
      wavefront.add(ray, sampler);
    });
    EXPECT_TRUE(wavefront.full());
    wavefront.trace(traced.rays);
    for (size_t i = 0; i < wavefront.size(); ++i) traced.radiance.push_back(wavefront.radiance(i));
    wavefront.clear();
  }
  return traced;
}

bool close(const Color& a, const Color& b) {
  return max_component(glm::abs(a - b)) <= 1e-3 * (max_component(a) + max_component(b));
}

class PathWaveOf : public testing::TestWithParam<std::string> {};

/// A difference in rounding may send a path past an edge, or end it, but that is rare.
void expect_the_same(const Scene& scene) {
  std::vector<PathRules> variants(4);
  variants[1].strict_normals = true;
  variants[2].max_depth = 3;
  variants[2].rr_depth = 1;
  variants[3].min_depth = 3;
  variants[3].hide_emitters = true;
  for (const PathRules& rules : variants) {
    const Traced single = one_by_one(scene, rules), wave = side_by_side(scene, rules);
    ASSERT_EQ(single.radiance.size(), wave.radiance.size());
    int different = 0, lit = 0;
    for (size_t i = 0; i < single.radiance.size(); ++i) {
      different += !close(single.radiance[i], wave.radiance[i]);
      lit += !is_black(single.radiance[i]);
    }
    EXPECT_GT(lit, 0);
    EXPECT_LE(different, waves * static_cast<int>(PathWave::capacity) / 200);
    const auto about = [](uint64_t n) { return 3 + static_cast<double>(n) / 200; };
    EXPECT_NEAR(wave.rays.intersect, single.rays.intersect, about(single.rays.intersect));
    if (scene.has_passages()) continue;  // single paths look for passages of black light, too
    EXPECT_NEAR(wave.rays.occluded, single.rays.occluded, about(single.rays.occluded));
  }
}

TEST_P(PathWaveOf, FindsWhatSinglePathsFind) { expect_the_same(*make_scene(GetParam()).scene); }

TEST_P(PathWaveOf, FindsTheSameWhereTheFirstShapeLetsLightPass) {
  expect_the_same(*with_pane_first(GetParam()).scene);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PathWaveOf, testing::ValuesIn(scene_names()),
                         [](const auto& info) { return info.param; });

TEST(PathWave, FindsWhatSinglePathsFindWhereThingsMove) {
  for (const std::string& name : moving_scene_names()) {
    SCOPED_TRACE(name);
    expect_the_same(*make_scene(name).scene);
  }
}

TEST(PathWave, FindsWhatSinglePathsFindWhereTheLastScatteringDisperses) {
  expect_the_same(*make_scene("frosted_pane").scene);
}

TEST(PathWave, FindsWhatSinglePathsFindOnGlossyMeshes) {
  const ScenePtr scene = make_scene("glossy_meshes").scene;
  int glossy = 0;
  for (uint32_t shape = 0; shape < scene->shapes().size(); ++shape)
    glossy += scene->lane_mesh(shape).glossy != nullptr;
  EXPECT_EQ(glossy, 3);
  expect_the_same(*scene);
}

TEST(PathWave, TracesAnIncompleteWave) {
  const ScenePtr scene = make_scene(scene_names().front()).scene;
  PathWave wavefront(*scene, {});
  RayCounts rays;
  wavefront.trace(rays);
  EXPECT_EQ(rays.total(), 0u);
  PixelSampler sampler(1, 1);
  const Ray ray = camera_ray(scene->camera(), {1.5, 1.5}, sampler).ray;
  PixelSampler again = sampler;
  wavefront.add(ray, sampler);
  wavefront.trace(rays);
  RayCounts single;
  EXPECT_TRUE(close(wavefront.radiance(0), trace_path(*scene, {}, ray, again, single)));
  EXPECT_EQ(rays.total(), single.total());
}

}  // namespace
}  // namespace mlt
