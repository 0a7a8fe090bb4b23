#include <gmock/gmock.h>

#include "filters.h"
#include "scene/film/film_settings.h"
#include "scene/plugin_testing.h"

namespace mlt {

#define MLT_PLUGIN(family, name) Plugin family##_##name();
#include "scene/film/list.inc"
#undef MLT_PLUGIN

namespace {

using test::error_in;
using test::Given;
using test::make;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(FilmPlugins, HaveMitsubasDefaults) {
  for (const Plugin& plugin : {film_hdrfilm(), film_ldrfilm()}) {
    const auto film = make<FilmSettings>(plugin);
    EXPECT_EQ(film->size, Vec2i(768, 576));
    EXPECT_EQ(film->crop_size, Vec2i(0));
    EXPECT_EQ(film->filter->name(), "gaussian");
    EXPECT_TRUE(film->half_precision);
  }
}

TEST(FilmPlugins, ReadSizeCropFilterAndPrecision) {
  const ObjectPtr filter = make<FilterObject>(rfilter_tent(), {{"radius", 1.5}});
  const auto film = make<FilmSettings>(film_hdrfilm(), {{"width", int64_t{64}},
                                                        {"height", int64_t{36}},
                                                        {"cropOffsetX", int64_t{10}},
                                                        {"cropWidth", int64_t{20}},
                                                        {"componentFormat", std::string("float32")},
                                                        {"rfilter", filter}});
  EXPECT_EQ(film->size, Vec2i(64, 36));
  EXPECT_EQ(film->crop_offset, Vec2i(10, 0));
  EXPECT_EQ(film->crop_size, Vec2i(20, 36));
  EXPECT_FALSE(film->half_precision);
  EXPECT_EQ(film->filter->name(), "tent");
  EXPECT_EQ(film->filter->radius(), 1.5);
}

TEST(FilmPlugins, TakeAFilterWithoutAName) {
  const Plugin plugin = film_hdrfilm();
  Params params(plugin.schema, {});
  params.add("rfilter", make<FilterObject>(rfilter_box()), {});
  const auto film = std::dynamic_pointer_cast<FilmSettings>(make_object(plugin, params));
  params.expect_all_read();
  EXPECT_TRUE(film->filter->is_box());
}

TEST(FilmPlugins, RefuseSizesThatMakeNoSense) {
  for (int64_t bad : {int64_t{0}, int64_t{-5}, int64_t{32769}, int64_t{1} << 40}) {
    EXPECT_THAT(error_in(film_hdrfilm(), {{"width", bad}}), HasSubstr("width")) << bad;
    EXPECT_THAT(error_in(film_hdrfilm(), {{"height", bad}}), HasSubstr("height")) << bad;
    EXPECT_THAT(error_in(film_hdrfilm(), {{"crop_width", bad}}), HasSubstr("crop_width")) << bad;
  }
  EXPECT_THAT(error_in(film_hdrfilm(), {{"width", int64_t{32768}}, {"height", int64_t{32768}}}),
              HasSubstr("2^28"));
  EXPECT_THAT(
      error_in(film_hdrfilm(), {{"crop_offset_x", int64_t{700}}, {"crop_width", int64_t{100}}}),
      HasSubstr("outside of the image"));
  EXPECT_THAT(error_in(film_hdrfilm(), {{"crop_offset_y", int64_t{10}}}), HasSubstr("outside"));
  EXPECT_THAT(error_in(film_hdrfilm(), {{"component_format", std::string("float64")}}),
              HasSubstr("did you mean 'float16'"));
}

TEST(FilmPlugins, WarnOnlyAboutWhatChangesTheResult) {
  std::vector<std::string> warnings;
  make<FilmSettings>(
      film_hdrfilm(),
      {{"pixel_format", std::string("rgb")}, {"file_format", std::string("openexr")}}, &warnings);
  EXPECT_THAT(warnings, IsEmpty());
  make<FilmSettings>(film_hdrfilm(), {{"pixelFormat", std::string("luminance")}}, &warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("'luminance' is read as 'rgb'")));
  const auto film =
      make<FilmSettings>(film_hdrfilm(), {{"component_format", std::string("uint32")}}, &warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("'uint32' is read as 'float32'")));
  EXPECT_FALSE(film->half_precision);
  make<FilmSettings>(film_ldrfilm(), {{"banner", false}}, &warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("no effect")));
  make<FilmSettings>(film_ldrfilm(), {{"gamma", 2.2}}, &warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("no effect")));
}

TEST(FilmPlugins, HaveAlphaIfTheFormatOfPixelsHasIt) {
  std::vector<std::string> warnings;
  const auto has_alpha = [&](const std::string& format) {
    return make<FilmSettings>(film_hdrfilm(), {{"pixel_format", format}}, &warnings)->alpha;
  };
  EXPECT_TRUE(has_alpha("rgba"));
  EXPECT_THAT(warnings, IsEmpty());
  for (const char* format : {"luminance_alpha", "xyza"}) {
    EXPECT_TRUE(has_alpha(format));
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("is read as 'rgba'")));
  }
  for (const char* format : {"luminance", "xyz", "spectrum"}) {
    EXPECT_FALSE(has_alpha(format));
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("is read as 'rgb'")));
  }
}

TEST(FilterPlugins, MakeTheFilterTheyName) {
  const Plugin plugins[] = {rfilter_box(),      rfilter_tent(),       rfilter_gaussian(),
                            rfilter_mitchell(), rfilter_catmullrom(), rfilter_lanczos()};
  const std::vector<Filter> filters = test::default_filters();
  ASSERT_EQ(std::size(plugins), filters.size());
  for (size_t i = 0; i < filters.size(); ++i) {
    EXPECT_EQ(plugins[i].schema.family, "rfilter");
    const auto filter = make<FilterObject>(plugins[i])->filter;
    EXPECT_EQ(filter->name(), plugins[i].schema.name);
    EXPECT_EQ(filter->name(), filters[i].name());
    EXPECT_EQ(filter->radius(), filters[i].radius());
    for (double x : {0.0, 0.4, 0.9, 1.7}) EXPECT_EQ(filter->eval(x), filters[i].eval(x));
  }
  EXPECT_EQ(make<FilterObject>(rfilter_lanczos(), {{"lobes", int64_t{2}}})->filter->radius(), 2);
  EXPECT_EQ(make<FilterObject>(rfilter_gaussian(), {{"stddev", 0.25}})->filter->radius(), 1);
  const auto sharp = make<FilterObject>(rfilter_mitchell(), {{"B", 0.0}, {"C", 0.5}})->filter;
  for (double x : {0.0, 0.4, 0.9, 1.7}) EXPECT_EQ(sharp->eval(x), catmullrom_filter().eval(x));
}

TEST(FilterPlugins, NameTheLineOfABadParameter) {
  const std::string error = error_in(rfilter_gaussian(), {{"stddev", -1.0}});
  EXPECT_THAT(error, HasSubstr("scene.xml:7"));
  EXPECT_THAT(error, HasSubstr("stddev"));
  EXPECT_THAT(error_in(rfilter_lanczos(), {{"lobes", int64_t{0}}}), HasSubstr("lobes"));
}

TEST(SamplerPlugins, CarryTheSampleCount) {
  const Plugin plugins[] = {sampler_independent(), sampler_stratified(), sampler_ldsampler(),
                            sampler_multijitter(), sampler_orthogonal(), sampler_halton(),
                            sampler_sobol(),       sampler_hammersley()};
  for (const Plugin& plugin : plugins) {
    EXPECT_EQ(plugin.schema.family, "sampler");
    EXPECT_EQ(make<SamplerSettings>(plugin)->sample_count, 0);
    EXPECT_EQ(make<SamplerSettings>(plugin, {{"sampleCount", int64_t{17}}})->sample_count, 17);
    for (const int64_t count : {int64_t{0}, int64_t{1} << 31})
      EXPECT_THAT(error_in(plugin, {{"sample_count", count}}), HasSubstr("sample_count"));
  }
}

}  // namespace
}  // namespace mlt
