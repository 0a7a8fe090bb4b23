// Samples of bidirectional path tracing that are traced side by side are those of
// BidirectionalSampler, and with t = 1 alone those of LightEstimator.
#include <gtest/gtest.h>

#include "path/estimators.h"
#include "scenes.h"
#include "wave/bidirectional_wave.h"

namespace mlt {
namespace {

using namespace test;

constexpr int waves = 2;

struct Sample {
  Color seen{0};        ///< By the techniques with t >= 2.
  Color splats{0};      ///< By the others,
  Vec2 where{0};        ///< and the sum of L* times raster position.
  double survived = 0;  ///< Sum of L* times survival times (1 + certainty), of all.
};

struct Samples {
  std::vector<Sample> samples;
  RayCounts rays;
};

/// Eight samples have the same one.
uint64_t stream(int wave, int i) { return 11 + wave + 10007 * (i / 8); }
Vec2 pixel(const Scene& scene, int i) {
  const Vec2i size = scene.camera().raster().size;
  return Vec2(i % size.x, i / size.x % size.y);
}

void add(Sample& sample, const FoundLight& light) {
  const double luminance = target_luminance(light.rgb);
  sample.survived += luminance * light.over_density * (1 + light.certainty);
  if (light.own_pixel) {
    sample.seen += light.rgb;
  } else {
    sample.splats += light.rgb;
    sample.where += light.raster * luminance;
  }
}

Samples one_by_one(const Scene& scene, const BidirectionalSettings& settings) {
  Samples found;
  BidirectionalSampler bidirectional(scene, settings);
  for (int w = 0; w < waves; ++w)
    for (int i = 0; i < BidirectionalWave::capacity; ++i) {
      PixelSampler sampler(stream(w, i), static_cast<uint32_t>(i));
      const Vec2 raster = pixel(scene, i) + sampler.next2();
      bidirectional.sample(raster, sampler, found.rays);
      Sample sample;
      bidirectional.connect_all(found.rays, [&](const Connection& c) {
        add(sample, {{c.raster, c.contribution * c.weight, c.t >= 2}, c.survival, c.certainty});
      });
      found.samples.push_back(sample);
    }
  return found;
}

/// The same by LightEstimator, which knows no survival.
Samples light_one_by_one(const Scene& scene, const PathRules& rules) {
  Samples found;
  LightEstimator estimator(scene, rules);
  for (int w = 0; w < waves; ++w)
    for (int i = 0; i < BidirectionalWave::capacity; ++i) {
      PixelSampler sampler(stream(w, i), static_cast<uint32_t>(i));
      const Vec2 raster = pixel(scene, i) + sampler.next2();
      Sample sample;
      estimator(raster, sampler, found.rays, [&](const FoundLight& light) { add(sample, light); });
      sample.survived = 0;
      found.samples.push_back(sample);
    }
  return found;
}

Samples side_by_side(const Scene& scene, const BidirectionalSettings& settings,
                     Techniques techniques = Techniques::all) {
  Samples found;
  BidirectionalWave wave(scene, settings, techniques);
  for (int w = 0; w < waves; ++w) {
    for (int i = 0; i < BidirectionalWave::capacity; ++i) {
      EXPECT_FALSE(wave.full());
      wave.add(stream(w, i), static_cast<uint32_t>(i), pixel(scene, i));
    }
    EXPECT_TRUE(wave.full());
    wave.trace(found.rays);
    for (int i = 0; i < wave.size(); ++i) {
      Sample sample;
      wave.show_lights(i, [&](const FoundLight& light) { add(sample, light); });
      if (techniques == Techniques::to_lens) sample.survived = 0;
      found.samples.push_back(sample);
    }
    wave.clear();
  }
  return found;
}

bool close(const Color& a, const Color& b) {
  return max_component(glm::abs(a - b)) <= 1e-3 * (max_component(a) + max_component(b));
}
bool close(const Sample& a, const Sample& b) {
  return close(a.seen, b.seen) && close(a.splats, b.splats) &&
         std::fabs(a.survived - b.survived) <= 1e-3 * (a.survived + b.survived) &&
         length(a.where - b.where) <= 1e-3 * (length(a.where) + length(b.where));
}

struct Compared {
  int different = 0, lit = 0, splatted = 0;
};

Compared compare(const Samples& single, const Samples& wave) {
  Compared compared;
  for (size_t i = 0; i < wave.samples.size(); ++i) {
    const Sample &a = single.samples[i], &b = wave.samples[i];
    compared.different += !close(a, b);
    compared.lit += !is_black(a.seen) && !is_black(a.splats);
    compared.splatted += !is_black(a.splats);
  }
  return compared;
}

std::vector<BidirectionalSettings> all_settings() {
  std::vector<BidirectionalSettings> variants(5);
  variants[1].rules.strict_normals = true;
  variants[1].heuristic = Heuristic::balance;
  variants[2].rules.max_depth = 3;
  variants[2].rules.rr_depth = 1;
  variants[2].light_image = false;
  variants[2].heuristic = Heuristic::balance;
  variants[3].rules.min_depth = 3;
  variants[3].rules.rr_depth = PathRules::no_roulette;
  variants[3].rules.max_depth = 6;
  variants[4].rules.max_depth = 2;
  variants[4].rules.hide_emitters = true;
  return variants;
}

class BidirectionalWaveOf : public testing::TestWithParam<std::string> {};

/// A difference in rounding may send a path past an edge, or end it, but that is rare.
void expect_the_same(const Samples& single, const Samples& wave, double behind_lens = 0) {
  EXPECT_EQ(single.samples.size(), wave.samples.size());
  const Compared compared = compare(single, wave);
  EXPECT_LE(compared.different, waves * BidirectionalWave::capacity / 100);
  const auto about = [](uint64_t n) { return 3 + static_cast<double>(n) / 200; };
  EXPECT_NEAR(wave.rays.intersect, single.rays.intersect, about(single.rays.intersect));
  EXPECT_LE(wave.rays.occluded, single.rays.occluded + about(single.rays.occluded));
  EXPECT_GE(wave.rays.occluded,
            (1 - behind_lens) * single.rays.occluded - about(single.rays.occluded));
}

/// Single samples count the shadow rays to an orthographic lens that they are behind, too, but no
/// wave traces them: 7 of 745 here.
void expect_what_single_walks_from_lights_find(const Scene& scene, double behind_lens = 0) {
  for (const BidirectionalSettings& settings : all_settings()) {
    EXPECT_TRUE(BidirectionalWave::supports(scene, settings));
    expect_the_same(light_one_by_one(scene, settings.rules),
                    side_by_side(scene, {settings.rules}, Techniques::to_lens), behind_lens);
  }
}

void expect_what_single_samples_find(const Scene& scene) {
  for (const BidirectionalSettings& settings : all_settings()) {
    EXPECT_TRUE(BidirectionalWave::supports(scene, settings));
    expect_the_same(one_by_one(scene, settings), side_by_side(scene, settings));
  }
}

TEST_P(BidirectionalWaveOf, FindsWhatSingleSamplesFind) {
  expect_what_single_samples_find(*make_scene(GetParam()).scene);
}

TEST_P(BidirectionalWaveOf, FindsTheSameWhereTheFirstShapeLetsLightPass) {
  expect_what_single_samples_find(*with_pane_first(GetParam()).scene);
}

TEST_P(BidirectionalWaveOf, FindsWhatSingleWalksFromLightsFind) {
  expect_what_single_walks_from_lights_find(*make_scene(GetParam()).scene,
                                            GetParam() == "orthographic" ? 0.01 : 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, BidirectionalWaveOf, testing::ValuesIn(grey_scene_names()),
                         [](const auto& info) { return info.param; });

/// With lights and lenses in media, and media that glow.
class BidirectionalWaveInMedia : public testing::TestWithParam<std::string> {};

TEST_P(BidirectionalWaveInMedia, FindsWhatSingleSamplesFind) {
  const ScenePtr scene = with_grey_media(GetParam()).scene;
  expect_what_single_samples_find(*scene);
  expect_what_single_walks_from_lights_find(*scene);
}

INSTANTIATE_TEST_SUITE_P(Scenes, BidirectionalWaveInMedia,
                         testing::Values("fog", "smoke_box", "smoke", "fire"),
                         [](const auto& info) { return info.param; });

TEST(BidirectionalWave, FindsWhatSingleSamplesFindWhereALampReachesIntoFog) {
  const std::string fog =
      "<bsdf type='null'/><medium name='interior' type='homogeneous'>"
      "<float name='sigma_t' value='2'/><float name='albedo' value='0.8'/></medium>";
  const std::string lamp = scale(0.35) + rotate("x", 90) + translate(0.5, 0.3, 0);
  const ScenePtr scene =
      load_scene(camera(in_front, "0, 0, 0", 42, film(16, 12)) + room() + cube(scale(0.6), fog) +
                 rectangle(lamp, white + area_light("6 5 4")));
  expect_what_single_samples_find(*scene);
}

/// So that the comparison is not one of nothing with nothing.
TEST(BidirectionalWave, ServesManyScenes) {
  int served = 0, lit = 0, splatted = 0;
  for (const std::string& name : scene_names()) {
    const ScenePtr scene = make_scene(name).scene;
    const BidirectionalSettings settings;
    if (!BidirectionalWave::supports(*scene, settings)) continue;
    ++served;
    lit += compare(one_by_one(*scene, settings), side_by_side(*scene, settings)).lit;
    splatted += compare(light_one_by_one(*scene, settings.rules),
                        side_by_side(*scene, settings, Techniques::to_lens))
                    .splatted;
  }
  EXPECT_GE(served, 30);
  EXPECT_GE(lit, 1000);
  EXPECT_GE(splatted, 1000);
}

TEST(BidirectionalWave, TracesAnIncompleteWave) {
  const ScenePtr scene = make_scene("smooth_normals").scene;
  const BidirectionalSettings settings;
  ASSERT_TRUE(BidirectionalWave::supports(*scene, settings));
  BidirectionalWave wave(*scene, settings);
  RayCounts rays;
  wave.trace(rays);
  EXPECT_EQ(rays.total(), 0u);
  const Samples single = one_by_one(*scene, settings);
  for (int i = 0; i < 11; ++i) wave.add(stream(0, i), static_cast<uint32_t>(i), pixel(*scene, i));
  wave.trace(rays);
  for (int i = 0; i < wave.size(); ++i) {
    Color seen(0);
    wave.show_lights(i, [&](const FoundLight& light) {
      if (light.own_pixel) seen += light.rgb;
    });
    EXPECT_TRUE(close(seen, single.samples[i].seen)) << i;
  }
}

TEST(BidirectionalWave, LeavesOtherTechniquesAlone) {
  const ScenePtr scene = make_scene(scene_names().front()).scene;
  BidirectionalSettings settings;
  settings.heuristic = Heuristic::maximum;
  EXPECT_FALSE(BidirectionalWave::supports(*scene, settings));
  settings = {};
  settings.sample_direct = false;
  EXPECT_FALSE(BidirectionalWave::supports(*scene, settings));
  EXPECT_FALSE(BidirectionalWave::supports(*make_scene("fog").scene, {}));
}

}  // namespace
}  // namespace mlt
