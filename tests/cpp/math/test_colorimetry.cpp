// Spectra and named indices against values read from Mitsuba 3.9 (variant scalar_rgb): the
// `reflectance` of a diffuse BSDF, the `eta` of a conductor, the `intensity` of a point light.
#include "math/colorimetry.h"

#include "base/error.h"
#include "math/ior.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

struct Case {
  WavelengthTable samples;
  SpectrumUse use;
  Color expected;
};

TEST(Colorimetry, MatchesMitsuba) {
  const std::vector<Case> cases{
      {{{400, 1}, {700, 1}}, SpectrumUse::reflectance, {0.995342, 0.9997564, 0.9949091}},
      {{{400, 1}, {700, 1}}, SpectrumUse::unbounded, {0.995342, 0.9997564, 0.9949091}},
      {{{400, 1}, {700, 1}}, SpectrumUse::emission, {1.199694, 0.9495203, 0.9034433}},
      {{{200, 1}, {900, 1}}, SpectrumUse::reflectance, {0.9989853, 0.9988737, 0.9988016}},
      {{{200, 1}, {900, 1}}, SpectrumUse::unbounded, {0.9989853, 0.9988737, 0.9988016}},
      {{{200, 1}, {900, 1}}, SpectrumUse::emission, {1.204884, 0.9482282, 0.9092668}},
      {{{400, 0.04}, {500, 0.2}, {600, 0.8}, {700, 0.76}},
       SpectrumUse::reflectance,
       {0.9276233, 0.4508825, 0.07510941}},
      {{{400, 0.04}, {500, 0.2}, {600, 0.8}, {700, 0.76}},
       SpectrumUse::unbounded,
       {0.9276233, 0.4508825, 0.07510941}},
      {{{400, 0.04}, {500, 0.2}, {600, 0.8}, {700, 0.76}},
       SpectrumUse::emission,
       {1.066822, 0.4337433, 0.05980165}},
      {{{400, 0}, {500, 8}, {600, 15.6}, {700, 18.4}}, SpectrumUse::reflectance, {1, 1, 1}},
      {{{400, 0}, {500, 8}, {600, 15.6}, {700, 18.4}},
       SpectrumUse::unbounded,
       {17.71471, 11.35443, 3.304508}},
      {{{400, 0}, {500, 8}, {600, 15.6}, {700, 18.4}},
       SpectrumUse::emission,
       {20.71084, 10.85463, 2.771152}},
      {{{400, 1.5}, {700, 2.5}}, SpectrumUse::reflectance, {1, 1, 1}},
      {{{400, 1.5}, {700, 2.5}}, SpectrumUse::unbounded, {2.297161, 1.97609, 1.628406}},
      {{{400, 1.5}, {700, 2.5}}, SpectrumUse::emission, {2.739847, 1.879001, 1.468861}},
      {{{410, 0.1}, {431.5, 0.7}, {502, 0.3}, {555, 0.9}, {587, 0.2}, {640, 0.4}},
       SpectrumUse::reflectance,
       {0.2136923, 0.5977852, 0.5245327}},
      {{{410, 0.1}, {431.5, 0.7}, {502, 0.3}, {555, 0.9}, {587, 0.2}, {640, 0.4}},
       SpectrumUse::unbounded,
       {0.2136923, 0.5977852, 0.5245327}},
      {{{410, 0.1}, {431.5, 0.7}, {502, 0.3}, {555, 0.9}, {587, 0.2}, {640, 0.4}},
       SpectrumUse::emission,
       {0.2703695, 0.5707703, 0.4776248}},
      {{{500, 1}, {600, 1}}, SpectrumUse::reflectance, {0.2098034, 1, 0}},
      {{{500, 1}, {600, 1}}, SpectrumUse::unbounded, {0.2098034, 1.023663, 0}},
      {{{500, 1}, {600, 1}}, SpectrumUse::emission, {0.2730651, 0.9879128, 0}},
      {{{400, 0.1}, {410, 0.5}}, SpectrumUse::reflectance, {0.0006224219, 0, 0.003834235}},
      {{{400, 0.1}, {410, 0.5}}, SpectrumUse::unbounded, {0.0006224219, 0, 0.003834235}},
      {{{400, 0.1}, {410, 0.5}}, SpectrumUse::emission, {0.0006936062, 0, 0.004272194}},
      {{{380.134, 0.847}, {387.764, 0.255}, {394.495, 0.449}, {401.652, 0.789}, {408.094, 0.028},
        {415.836, 0.433}, {422.762, 0.002}, {429.445, 0.722}, {436.229, 0.945}, {443.901, 0.031},
        {450.025, 0.541}, {457.939, 0.381}, {464.217, 0.422}, {471.029, 0.222}, {478.438, 0.496},
        {485.233, 0.231}, {492.219, 0.460}, {499.29, 0.021},  {506.838, 0.556}, {513.642, 0.186},
        {520.993, 0.860}, {527.121, 0.333}, {534.721, 0.711}, {541.936, 0.422}, {548.83, 0.670},
        {555.303, 0.588}, {562.882, 0.846}, {569.505, 0.589}, {576.035, 0.243}, {583.797, 0.414},
        {590.173, 0.549}, {597.703, 0.674}, {604.375, 0.439}, {611.508, 0.778}, {618.521, 0.393},
        {625.49, 0.030},  {632.043, 0.703}, {639.983, 0.593}, {646.394, 0.170}, {653.502, 0.982},
        {660.771, 0.540}, {667.86, 0.232},  {674.514, 0.952}, {681.578, 0.459}, {688.269, 0.548},
        {695.957, 0.006}, {702.784, 0.820}, {709.886, 0.741}, {716.809, 0.519}, {723.561, 0.426},
        {730.056, 0.870}, {737.57, 0.200},  {744.505, 0.485}, {751.357, 0.346}, {758.538, 0.623},
        {765.612, 0.458}, {772.028, 0.230}, {779.177, 0.584}},
       SpectrumUse::reflectance,
       {0.5374748, 0.5268395, 0.39698}},
      {{{380.134, 0.847}, {387.764, 0.255}, {394.495, 0.449}, {401.652, 0.789}, {408.094, 0.028},
        {415.836, 0.433}, {422.762, 0.002}, {429.445, 0.722}, {436.229, 0.945}, {443.901, 0.031},
        {450.025, 0.541}, {457.939, 0.381}, {464.217, 0.422}, {471.029, 0.222}, {478.438, 0.496},
        {485.233, 0.231}, {492.219, 0.460}, {499.29, 0.021},  {506.838, 0.556}, {513.642, 0.186},
        {520.993, 0.860}, {527.121, 0.333}, {534.721, 0.711}, {541.936, 0.422}, {548.83, 0.670},
        {555.303, 0.588}, {562.882, 0.846}, {569.505, 0.589}, {576.035, 0.243}, {583.797, 0.414},
        {590.173, 0.549}, {597.703, 0.674}, {604.375, 0.439}, {611.508, 0.778}, {618.521, 0.393},
        {625.49, 0.030},  {632.043, 0.703}, {639.983, 0.593}, {646.394, 0.170}, {653.502, 0.982},
        {660.771, 0.540}, {667.86, 0.232},  {674.514, 0.952}, {681.578, 0.459}, {688.269, 0.548},
        {695.957, 0.006}, {702.784, 0.820}, {709.886, 0.741}, {716.809, 0.519}, {723.561, 0.426},
        {730.056, 0.870}, {737.57, 0.200},  {744.505, 0.485}, {751.357, 0.346}, {758.538, 0.623},
        {765.612, 0.458}, {772.028, 0.230}, {779.177, 0.584}},
       SpectrumUse::unbounded,
       {0.5374748, 0.5268395, 0.39698}},
      {{{380.134, 0.847}, {387.764, 0.255}, {394.495, 0.449}, {401.652, 0.789}, {408.094, 0.028},
        {415.836, 0.433}, {422.762, 0.002}, {429.445, 0.722}, {436.229, 0.945}, {443.901, 0.031},
        {450.025, 0.541}, {457.939, 0.381}, {464.217, 0.422}, {471.029, 0.222}, {478.438, 0.496},
        {485.233, 0.231}, {492.219, 0.460}, {499.29, 0.021},  {506.838, 0.556}, {513.642, 0.186},
        {520.993, 0.860}, {527.121, 0.333}, {534.721, 0.711}, {541.936, 0.422}, {548.83, 0.670},
        {555.303, 0.588}, {562.882, 0.846}, {569.505, 0.589}, {576.035, 0.243}, {583.797, 0.414},
        {590.173, 0.549}, {597.703, 0.674}, {604.375, 0.439}, {611.508, 0.778}, {618.521, 0.393},
        {625.49, 0.030},  {632.043, 0.703}, {639.983, 0.593}, {646.394, 0.170}, {653.502, 0.982},
        {660.771, 0.540}, {667.86, 0.232},  {674.514, 0.952}, {681.578, 0.459}, {688.269, 0.548},
        {695.957, 0.006}, {702.784, 0.820}, {709.886, 0.741}, {716.809, 0.519}, {723.561, 0.426},
        {730.056, 0.870}, {737.57, 0.200},  {744.505, 0.485}, {751.357, 0.346}, {758.538, 0.623},
        {765.612, 0.458}, {772.028, 0.230}, {779.177, 0.584}},
       SpectrumUse::emission,
       {0.6387666, 0.5022745, 0.36668}},
  };
  for (size_t i = 0; i < cases.size(); ++i) {
    const Color c = spectrum_to_rgb(cases[i].samples, cases[i].use).color;
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(c[k], cases[i].expected[k], 2e-6 * std::max(1.0, cases[i].expected[k])) << i;
  }
}

TEST(Colorimetry, UniformMatchesMitsuba) {
  const Color c = uniform_spectrum_to_rgb(0.5, SpectrumUse::emission);
  EXPECT_NEAR(c.x, 0.602397, 1e-6);
  EXPECT_NEAR(c.y, 0.474146, 1e-6);
  EXPECT_NEAR(c.z, 0.454458, 1e-6);
  EXPECT_EQ(uniform_spectrum_to_rgb(0.5, SpectrumUse::reflectance), Color(0.5));
  EXPECT_EQ(uniform_spectrum_to_rgb(0.5, SpectrumUse::unbounded), Color(0.5));
}

TEST(Colorimetry, SaysWhenItClamps) {
  EXPECT_TRUE(spectrum_to_rgb({{500, 1}, {600, 1}}, SpectrumUse::reflectance).clamped);
  EXPECT_FALSE(spectrum_to_rgb({{400, 0.5}, {700, 0.5}}, SpectrumUse::reflectance).clamped);
  EXPECT_TRUE(spectrum_to_rgb({{400, 1.5}, {700, 1.5}}, SpectrumUse::reflectance).clamped);
  EXPECT_FALSE(spectrum_to_rgb({{400, 1.5}, {700, 1.5}}, SpectrumUse::unbounded).clamped);
}

TEST(Colorimetry, RefusesBadLists) {
  const auto convert = [](const WavelengthTable& s) {
    return spectrum_to_rgb(s, SpectrumUse::emission);
  };
  EXPECT_THROW(convert({}), UsageError);
  EXPECT_THROW(convert({{500, 1}}), UsageError);
  EXPECT_THROW(convert({{500, 1}, {500, 2}}), UsageError);
  EXPECT_THROW(convert({{500, 1}, {400, 2}}), UsageError);
  EXPECT_THROW(convert({{500, 1}, {600, infinity}}), UsageError);
  EXPECT_THROW(convert({{std::nan(""), 1}, {600, 1}}), UsageError);
}

TEST(Ior, NamesAreFound) {
  EXPECT_EQ(find_dielectric("bk7"), 1.5046);
  EXPECT_EQ(find_dielectric("BK7"), 1.5046);
  EXPECT_EQ(find_dielectric("diamond"), 2.419);
  EXPECT_EQ(find_dielectric("sapphire"), 1.7681);
  EXPECT_EQ(find_dielectric("SF11"), 1.7845);
  EXPECT_FALSE(find_dielectric("unobtainium"));
  ASSERT_TRUE(find_conductor("Au"));
  EXPECT_NEAR(find_conductor("Au")->k.x, 3.983, 1e-4);
  EXPECT_NEAR(find_conductor("none")->k.x, 1, 0);
  EXPECT_FALSE(find_conductor("au"));
  EXPECT_GE(conductor_names().size(), 70u);
  for (const std::string& name : conductor_names()) {
    const ComplexIor ior = find_conductor(name).value();
    EXPECT_GE(min_component(ior.eta), 0) << name;
    EXPECT_GE(min_component(ior.k), 0) << name;
  }
}

}  // namespace
}  // namespace mlt::test
