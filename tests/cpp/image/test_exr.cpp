// EXR files: what is written comes back, equal content gives equal bytes, and the kinds of file
// that other programs write are read as they are meant.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "image/exr.h"
#include "image/image_files.h"

namespace mlt {
namespace {

const std::vector<std::string> rgb = {"R", "G", "B"};

Image decode(const std::string& bytes, const std::string& layer = "") {
  return decode_exr(bytes, "test.exr", layer);
}

TEST(Exr, KeepsFloatsExactly) {
  for (int channels = 1; channels <= 4; ++channels) {
    Image image = random_image(37, 23, channels, 1e6);
    image.data[0] = -3.5f;
    image.data[1] = std::numeric_limits<float>::infinity();
    image.data[2] = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ(decode(encode_exr({{"", image}}, false, {})), image) << channels;
  }
}

TEST(Exr, RoundsToHalfAndNeverToInfinity) {
  Image image = random_image(40, 7, 3, 100);
  image.data[0] = 1e9f;
  image.data[1] = -1e9f;
  image.data[2] = std::numeric_limits<float>::infinity();
  image.data[3] = std::nanf("");
  const Image read = decode(encode_exr({{"", image}}, true, {}));
  EXPECT_EQ(read.data[0], 65504);
  EXPECT_EQ(read.data[1], -65504);
  EXPECT_EQ(read.data[2], std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(read.data[3]));
  for (size_t i = 4; i < read.data.size(); ++i)  // 11 significant bits
    EXPECT_NEAR(read.data[i], image.data[i], image.data[i] / 2048 + 1e-7);
}

TEST(Exr, KeepsLayersApart) {
  const Image beauty = random_image(9, 5, 3), error = random_image(9, 5, 3, 1, 2);
  const Image depth = random_image(9, 5, 1, 100, 3), uv = random_image(9, 5, 2, 1, 4);
  const std::string bytes =
      encode_exr({{"", beauty}, {"error", error}, {"depth", depth, {"Z"}}, {"a.b", uv}}, false, {});
  EXPECT_EQ(decode(bytes), beauty);
  EXPECT_EQ(decode(bytes, "error"), error);
  EXPECT_EQ(decode(bytes, "depth"), depth);
  EXPECT_EQ(decode(bytes, "a.b"), uv);
  EXPECT_THROW(decode(bytes, "albedo"), FileError);
}

TEST(Exr, ReadsTheFirstLayerIfThereIsNoOther) {
  const Image image = random_image(9, 5, 3);
  EXPECT_EQ(decode(encode_exr({{"view", image}}, false, {})), image);
  const Image mask = random_image(9, 5, 1);
  EXPECT_EQ(decode(encode_exr({{"layer", mask, {"R"}}}, false, {})), mask);
}

TEST(Exr, KeepsMetadata) {
  const Metadata metadata = {{"comments", "two\nlines, caf\xc3\xa9"},
                             {"pymlt.integrator", "mlt(max_depth=10)"},
                             {"a name of more than thirty-one characters", ""}};
  const std::string bytes = encode_exr({{"", random_image(3, 3, 3)}}, false, metadata);
  Metadata sorted = metadata;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(decode_exr_metadata(bytes, "test.exr"), sorted);
  EXPECT_TRUE(decode_exr_metadata(encode_exr({{"", Image(1, 1, 1)}}, false, {}), "x").empty());
}

TEST(Exr, EqualImagesMakeEqualFiles) {
  const Image image = random_image(64, 48, 3), copy = image;
  const Metadata metadata = {{"b", "1"}, {"a", "2"}}, reordered = {{"a", "2"}, {"b", "1"}};
  EXPECT_EQ(encode_exr({{"", image}}, false, metadata), encode_exr({{"", copy}}, false, reordered));
  EXPECT_EQ(encode_exr({{"", image}}, true, {}), encode_exr({{"", copy}}, true, {}));
}

TEST(Exr, RefusesWhatCannotBeWritten) {
  const Image image(4, 4, 3), other(4, 5, 3), many(2, 2, 7);
  EXPECT_THROW(encode_exr({}, false, {}), UsageError);
  EXPECT_THROW(encode_exr({{"", Image()}}, false, {}), UsageError);
  EXPECT_THROW(encode_exr({{"", image}, {"x", other}}, false, {}), UsageError);
  EXPECT_THROW(encode_exr({{"", image}, {"", image}}, false, {}), UsageError);
  EXPECT_THROW(encode_exr({{"", many}}, false, {}), UsageError);
  EXPECT_THROW(encode_exr({{"", image, {"R", "G"}}}, false, {}), UsageError);
  for (const char* name :
       {"", "compression", "dataWindow", "type", "chunkCount", "screenWindowWidth"})
    EXPECT_THROW(encode_exr({{"", image}}, false, {{name, "x"}}), UsageError) << name;
  EXPECT_THROW(encode_exr({{"", image}}, false, {{"k", "x"}, {"k", "y"}}), UsageError);
}

TEST(Exr, ReadsEverySampleType) {
  const Image image = random_image(33, 17, 3, 200);
  Image whole = image, halved = image;
  for (float& v : whole.data) v = std::floor(v);
  for (float& v : halved.data) v = std::round(v * 8) / 8;
  EXPECT_EQ(decode(exr_bytes(image, {ExrSample::float32, rgb})), image);
  EXPECT_EQ(decode(exr_bytes(halved, {ExrSample::half, rgb})), halved);
  EXPECT_EQ(decode(exr_bytes(whole, {ExrSample::uint, rgb})), whole);
}

TEST(Exr, ReadsEveryLosslessCompression) {
  const Image image = random_levels(70, 50, 3, 16);
  for (int compression = 0; compression <= 4; ++compression) {
    ExrKind kind{ExrSample::float32, rgb};
    kind.compression = compression;
    EXPECT_EQ(decode(exr_bytes(image, kind)), image) << compression;
  }
}

/// An even image is what compresses best: it must not be taken for a lie.
TEST(Exr, BelievesAnEvenImage) {
  Image image(2048, 1024, 3);
  for (int compression = 0; compression <= 9; ++compression) {
    ExrKind kind{ExrSample::half, rgb};
    kind.compression = compression;
    EXPECT_EQ(decode(exr_bytes(image, kind)), image) << compression;
  }
}

TEST(Exr, ReadsTilesAndTheirTopLevel) {
  const Image image = random_image(50, 41, 3);
  ExrKind kind{ExrSample::float32, rgb};
  kind.tiled = true;
  EXPECT_EQ(decode(exr_bytes(image, kind)), image);
  kind.mipmapped = true;
  EXPECT_EQ(decode(exr_bytes(image, kind)), image);
}

TEST(Exr, ReadsTheFirstPart) {
  const Image image = random_image(20, 10, 3);
  ExrKind kind{ExrSample::float32, rgb};
  kind.parts = 3;
  EXPECT_EQ(decode(exr_bytes(image, kind)), image);
}

TEST(Exr, KnowsChannelsByName) {
  const auto read = [](std::vector<std::string> names) {
    const Image image = random_image(6, 4, static_cast<int>(names.size()));
    const Image result = decode(exr_bytes(image, {ExrSample::float32, std::move(names)}));
    return std::pair(image, result);
  };
  for (const auto& names : std::vector<std::vector<std::string>>{rgb,
                                                                 {"R", "G", "B", "A"},
                                                                 {"Y"},
                                                                 {"Y", "A"},
                                                                 {"R"},
                                                                 {"Z"},
                                                                 {"Red", "Green", "Blue"},
                                                                 {"r", "g", "b"},
                                                                 {"L.R", "L.G", "L.B"},
                                                                 {"mask", "A"}}) {
    const auto [image, result] = read(names);
    EXPECT_EQ(image, result) << names.front();
  }
  const auto [image, result] = read({"B", "G", "R", "Z", "albedo.R", "albedo.G", "albedo.B"});
  ASSERT_EQ(result.channels, 3);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(result.at(2, 3, c), image.at(2, 3, 2 - c));
  EXPECT_THROW(read({"X", "Y", "Z"}), FileError);
  EXPECT_THROW(read({"Y", "RY", "BY"}), FileError);
  EXPECT_THROW(read({"R", "G"}), FileError);
}

/// The display window is the image (OpenEXR, "Technical Introduction"); the rest is black.
TEST(Exr, ShowsTheDisplayWindow) {
  const Image image = random_image(20, 10, 3);
  for (const bool tiled : {false, true}) {
    for (const auto& [x, y] : {std::pair(3, 2), std::pair(-4, -5), std::pair(12, -3)}) {
      ExrKind kind{ExrSample::float32, rgb, tiled};
      kind.x = x;
      kind.y = y;
      kind.display_width = 24;
      kind.display_height = 15;
      const Image read = decode(exr_bytes(image, kind));
      ASSERT_EQ(read.width, 24);
      ASSERT_EQ(read.height, 15);
      for (int j = 0; j < 15; ++j) {
        for (int i = 0; i < 24; ++i) {
          const int u = i - x, v = j - y;
          const bool inside = u >= 0 && v >= 0 && u < 20 && v < 10;
          EXPECT_EQ(read.at(i, j, 1), inside ? image.at(u, v, 1) : 0) << i << " " << j;
        }
      }
    }
  }
  ExrKind kind{ExrSample::float32, rgb};
  kind.x = 100;
  kind.display_width = kind.display_height = 20;
  EXPECT_THROW(decode(exr_bytes(image, kind)), FileError);
}

}  // namespace
}  // namespace mlt
