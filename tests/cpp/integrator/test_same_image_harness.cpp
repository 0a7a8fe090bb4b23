// The harness that compares renderings, on images of pure noise: it accepts what is equal, rejects
// what is not, and does not take noise for agreement.
#include <gtest/gtest.h>

#include "base/rng.h"
#include "harness/same_image.h"

namespace mlt {
namespace {

using namespace test;

/// Pixels of mean `mean(x, y)`, each an average of n exponential numbers.
template <class Mean>
Side noise(const std::string& name, int n, Mean mean) {
  return {name, [=](uint64_t seed, double effort) {
            Rng rng(seed, Purpose::test, 0);
            Image image(8, 6, 3);
            const int count = static_cast<int>(n * effort);
            for (int y = 0; y < 6; ++y)
              for (int x = 0; x < 8; ++x)
                for (int c = 0; c < 3; ++c) {
                  double sum = 0;
                  for (int i = 0; i < count; ++i) sum -= std::log(1 - rng.next());
                  image.at(x, y, c) = static_cast<float>(mean(x, y) * sum / count);
                }
            return image;
          }};
}

constexpr auto one = [](int, int) { return 1.0; };
constexpr auto brighter = [](int, int) { return 1.02; };
constexpr auto brighter_corner = [](int x, int y) { return x < 2 && y < 2 ? 1.1 : 1.0; };
constexpr auto brighter_pixel = [](int x, int y) { return x == 5 && y == 4 ? 1.5 : 1.0; };

TEST(SameImageHarness, AcceptsWhatIsEqual) {
  int rejected = 0;
  for (uint64_t seed = 1; seed <= 30; ++seed) {
    SameImageSettings settings;
    settings.seed = seed;
    const SameImage found = same_image(noise("a", 40, one), noise("b", 60, one), settings);
    EXPECT_TRUE(found.powerful) << found.text;
    rejected += !found.same;
  }
  EXPECT_EQ(rejected, 0) << "of 30 at the level 1e-3, squared by the repetition";
}

TEST(SameImageHarness, RejectsWhatDiffers) {
  for (const auto& [name, other] : {std::pair("all", noise("b", 40, brighter)),
                                    std::pair("corner", noise("b", 40, brighter_corner)),
                                    std::pair("pixel", noise("b", 40, brighter_pixel))}) {
    const SameImage found = same_image(noise("a", 40, one), other);
    EXPECT_TRUE(found.powerful) << name << ": " << found.text;
    EXPECT_FALSE(found.same) << name << ": " << found.text;
  }
}

TEST(SameImageHarness, ComparesWithAKnownImage) {
  Image image(8, 6, 3);
  for (float& x : image.data) x = 1;
  EXPECT_TRUE(same_image(noise("a", 40, one), {"known", nullptr, image}));
  EXPECT_FALSE(same_image(noise("a", 40, brighter), {"known", nullptr, image}).same);
}

TEST(SameImageHarness, DoesNotTakeNoiseForAgreement) {
  SameImageSettings settings;
  settings.max_effort = 2;
  const SameImage found = same_image(noise("a", 1, one), noise("b", 1, one), settings);
  EXPECT_FALSE(found.powerful) << found.text;
  EXPECT_FALSE(found) << found.text;
}

TEST(SameImageHarness, DoesNotTakeBlackForAgreement) {
  const auto black = [](int, int) { return 0.0; };
  EXPECT_FALSE(same_image(noise("a", 1, black), noise("b", 1, black)));
}

TEST(SameImageHarness, RejectsNumbersThatAreNone) {
  const auto broken = [](int x, int) { return x == 3 ? std::nan("") : 1.0; };
  EXPECT_FALSE(same_image(noise("a", 40, broken), noise("b", 40, one)));
}

}  // namespace
}  // namespace mlt
