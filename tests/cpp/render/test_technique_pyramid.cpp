#include "render/technique_pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mlt {
namespace {

Image plain(int width, int height, float value) {
  Image image(width, height, 3);
  std::fill(image.data.begin(), image.data.end(), value);
  return image;
}

/// How many pixels have exactly this value.
int count(const Image& image, float value) {
  int found = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) found += image.at(x, y, 0) == value;
  return found;
}

TEST(TechniquePyramid, LayersAreNamedByTheirTechnique) {
  const auto name = parse_technique("weighted.s1.t12");
  ASSERT_TRUE(name);
  EXPECT_EQ(name->s, 1);
  EXPECT_EQ(name->t, 12);
  EXPECT_TRUE(name->weighted);
  EXPECT_FALSE(parse_technique("raw.s0.t2")->weighted);
  for (const char* other :
       {"", "raw", "raw.s.t2", "raw.s1", "raw.s1.t2x", "raw.s-1.t2", "error.s1.t2"})
    EXPECT_FALSE(parse_technique(other)) << other;
}

TEST(TechniquePyramid, OtherLayersMakeNoPicture) {
  EXPECT_FALSE(technique_pyramid({}, 0));
  EXPECT_FALSE(technique_pyramid({{"error", plain(4, 4, 1)}}, 0));
}

TEST(TechniquePyramid, EachImageIsSeenOnceInItsPlace) {
  const std::vector<NamedImage> layers = {{"raw.s0.t2", plain(100, 50, 0.25f)},
                                          {"weighted.s0.t2", plain(100, 50, 0.125f)},
                                          {"raw.s1.t1", plain(100, 50, 0.5f)},
                                          {"weighted.s1.t1", plain(100, 50, 0.375f)}};
  const auto picture = technique_pyramid(layers, 0);
  ASSERT_TRUE(picture);
  for (const float value : {0.25f, 0.125f, 0.5f, 0.375f})
    EXPECT_EQ(count(*picture, value), 100 * 50);
  EXPECT_GT(count(*picture, 0), 100);  // ink
  const auto first = [&](float value) {
    const auto at =
        std::find(picture->data.begin(), picture->data.end(), value) - picture->data.begin();
    return std::make_pair(at / 3 % picture->width, at / 3 / picture->width);
  };
  EXPECT_LT(first(0.25f).first, first(0.5f).first);      // s grows to the right
  EXPECT_EQ(first(0.25f).second, first(0.5f).second);    // in one row
  EXPECT_LT(first(0.25f).second, first(0.125f).second);  // weighted ones below
}

TEST(TechniquePyramid, LargeImagesShrinkToTheirMeansAndExposureIsApplied) {
  Image stripes(64, 32, 3);
  for (size_t i = 0; i < stripes.data.size(); ++i) stripes.data[i] = i / 3 % 2 ? 0.25f : 0;
  const auto picture = technique_pyramid({{"raw.s0.t2", stripes}}, 1, 32);
  EXPECT_EQ(count(*picture, 0.25f), 32 * 16);  // (0 + 0.25) / 2, twice as bright
}

TEST(TechniquePyramid, WhatAPinholeCannotDoIsLeftOut) {
  std::vector<NamedImage> layers = {{"raw.s0.t2", plain(100, 50, 0.25f)},
                                    {"raw.s2.t0", plain(100, 50, 0)}};
  const int narrow = technique_pyramid(layers, 0)->width;
  layers[1].image = plain(100, 50, 0.5f);
  const auto wide = technique_pyramid(layers, 0);
  EXPECT_EQ(count(*wide, 0.5f), 100 * 50);
  EXPECT_GT(wide->width, 200);
  EXPECT_GE(wide->width, narrow);
}

TEST(TechniquePyramid, ImagesOfOnePixelAreFine) {
  EXPECT_TRUE(technique_pyramid({{"raw.s0.t2", plain(1, 1, 0.25f)}}, 0));
}

}  // namespace
}  // namespace mlt
