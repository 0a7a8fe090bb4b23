// Numbers and lists, as exporters write them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/text.h"

namespace mlt {
namespace {

TEST(Text, ReadsNumbersInEveryNotation) {
  EXPECT_EQ(parse_real("3"), 3.0);
  EXPECT_EQ(parse_real("-.5"), -0.5);
  EXPECT_EQ(parse_real("1e-005"), 1e-5);
  EXPECT_EQ(parse_real("+2.50"), 2.5);
  EXPECT_EQ(parse_real(" \t7.\n"), 7.0);
  EXPECT_EQ(parse_real("0.1"), 0.1);
  EXPECT_EQ(parse_real("-0"), 0.0);
  EXPECT_TRUE(std::signbit(*parse_real("-0")));
}

TEST(Text, ReadsWhatIsTooSmallAsZeroAndRefusesWhatIsTooLarge) {
  EXPECT_EQ(parse_real("1e-400"), 0.0);
  EXPECT_EQ(parse_real("5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(parse_real("1e400"), std::nullopt);
  EXPECT_EQ(parse_real("-1e400"), std::nullopt);
}

TEST(Text, RefusesWhatIsNotANumber) {
  for (const char* text : {"", " ", "nan", "inf", "-infinity", "1,5", "1 2", "0x10", "1e", "--1",
                           "+-1", "abc", "1f", "."})
    EXPECT_EQ(parse_real(text), std::nullopt) << text;
}

TEST(Text, ReadsIntegers) {
  EXPECT_EQ(parse_integer(" -12 "), -12);
  EXPECT_EQ(parse_integer("+8"), 8);
  EXPECT_EQ(parse_integer("9223372036854775807"), std::numeric_limits<int64_t>::max());
  for (const char* text : {"", "8.0", "1e3", "9223372036854775808", "8 9", "eight"})
    EXPECT_EQ(parse_integer(text), std::nullopt) << text;
}

TEST(Text, ReadsBooleans) {
  EXPECT_EQ(parse_boolean("true"), true);
  EXPECT_EQ(parse_boolean(" False "), false);
  for (const char* text : {"", "1", "yes", "truefalse"})
    EXPECT_EQ(parse_boolean(text), std::nullopt) << text;
}

TEST(Text, SplitsAtSpacesAndCommasInAnyMixture) {
  EXPECT_EQ(parse_reals("1,2,3"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(parse_reals("  1 2\t3\n"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(parse_reals(" 1 ,2,  3 ,"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(parse_reals(""), std::vector<double>{});
  EXPECT_EQ(parse_reals("1, b"), std::nullopt);
}

TEST(Text, QuotesOnOneShortLine) {
  EXPECT_EQ(quote("a\nb"), "'a b'");
  EXPECT_LT(quote(std::string(10'000, 'x')).size(), 100u);
}

}  // namespace
}  // namespace mlt
