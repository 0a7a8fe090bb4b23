#include "image/exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace mlt {
namespace {

/// Grey values from `low` upwards by 1 in any order, with these many channels.
Image ramp(int channels, float low = 1) {
  Image image(20, 10, channels);
  std::vector<float> values(image.pixel_count());
  for (size_t i = 0; i < values.size(); ++i) values[i] = low + static_cast<float>(i);
  std::shuffle(values.begin(), values.end(), std::mt19937(1));
  for (size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = values[i / static_cast<size_t>(channels)];
  return image;
}

TEST(Exposure, ShowsNineteenOfTwentyPixelsBelowWhite) {
  const double scale = std::exp2(fitting_exposure(ramp(3)));
  EXPECT_NEAR(scale * 190, 0.8, 1e-9);
}

TEST(Exposure, FirefliesAndWhatIsNoNumberDoNotMatter) {
  Image image = ramp(3);
  const double before = fitting_exposure(image);
  for (float& sample : image.data)
    if (sample == 200) sample = 1e30f;
  EXPECT_EQ(fitting_exposure(image), before);
  image.data[0] = std::numeric_limits<float>::quiet_NaN();
  image.data[3] = std::numeric_limits<float>::infinity();
  EXPECT_NEAR(fitting_exposure(image), before, 0.02);
}

TEST(Exposure, AlphaDoesNotCount) {
  Image image = ramp(4, 1000);
  for (size_t i = 3; i < image.data.size(); i += 4) image.data[i] = 1e9f;
  EXPECT_EQ(fitting_exposure(image), fitting_exposure(ramp(3, 1000)));
}

TEST(Exposure, OfWhatIsBlackIsZeroAndOfWhatIsExtremeLimited) {
  EXPECT_EQ(fitting_exposure(Image(4, 4, 3)), 0);
  EXPECT_EQ(fitting_exposure(ramp(1, 1e12f)), -16);
  Image dim(4, 4, 1);
  dim.data.assign(dim.data.size(), 1e-20f);
  EXPECT_EQ(fitting_exposure(dim), 16);
}

}  // namespace
}  // namespace mlt
