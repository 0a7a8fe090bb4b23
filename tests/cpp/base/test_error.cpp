// What error messages are made of: a place, and the word that was probably meant.
#include <gtest/gtest.h>

#include "base/error.h"

namespace mlt {
namespace {

TEST(Error, NamesThePlaceAsFarAsItIsKnown) {
  EXPECT_EQ(at({"scene.xml", 12}, "no"), "scene.xml:12: no");
  EXPECT_EQ(at({"scene.xml", 0}, "no"), "scene.xml: no");
  EXPECT_EQ(at({}, "no"), "no");
  EXPECT_EQ(at({"", 12}, "no"), "no");
}

TEST(Error, EachKindIsAnError) {
  EXPECT_THROW(throw SceneError("a"), Error);
  EXPECT_THROW(throw UsageError("a"), Error);
  EXPECT_THROW(throw FileError("a"), Error);
  EXPECT_THROW(throw RenderError("a"), Error);
  EXPECT_THROW(throw Error("a"), std::runtime_error);
}

// A file's name may hold any byte but '/' and 0.
TEST(Error, IsOneLineWhateverItTellsOf) {
  EXPECT_STREQ(FileError("no\r\nsuch\x1b[1m.exr: there is no such file").what(),
               "no  such [1m.exr: there is no such file");
}

const std::vector<std::string> names{"max_depth", "rr_depth", "hide_emitters"};

TEST(Closest, FindsAMisspeltWord) {
  EXPECT_EQ(closest("max_dpeth", names), "max_depth");   // two letters swapped
  EXPECT_EQ(closest("maxdepth", names), "max_depth");    // one missing
  EXPECT_EQ(closest("max_deepth", names), "max_depth");  // one too many
  EXPECT_EQ(closest("nax_depth", names), "max_depth");   // one wrong
  EXPECT_EQ(closest("rr_depth", names), "rr_depth");
}

TEST(Closest, FindsNothingForAStranger) {
  EXPECT_EQ(closest("reflectance", names), "");
  EXPECT_EQ(closest("", names), "");
  EXPECT_EQ(closest("max_depth", {}), "");
}

TEST(Closest, PrefersTheNearer) {
  EXPECT_EQ(closest("depth_a", {"depth_bc", "depth_b", "depth_cb"}), "depth_b");
}

TEST(Closest, CountsASwapAsOneMistake) {
  EXPECT_EQ(closest("fvo", {"fov"}), "fov");  // a three-letter word may have one mistake
  EXPECT_EQ(closest("fxx", {"fov"}), "");
}

TEST(Suggestion, ListsWhatIsValidWhenNothingIsNear) {
  EXPECT_EQ(suggestion("max_dpeth", names), "; did you mean 'max_depth'?");
  EXPECT_EQ(suggestion("zzz", names), "; valid are: max_depth, rr_depth, hide_emitters");
  EXPECT_EQ(suggestion("zzz", {}), "; none is known here");
}

}  // namespace
}  // namespace mlt
