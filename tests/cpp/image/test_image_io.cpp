// Images through files: what each format keeps, how it is told apart, and what happens when a path
// or an image is not what it should be.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "base/atomic_file.h"
#include "base/error.h"
#include "image/image_files.h"
#include "image/image_io.h"
#include "image/srgb.h"

namespace mlt {
namespace {

namespace fs = std::filesystem;

size_t files_in(const std::string& folder) {
  return static_cast<size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

void expect_near(const Image& a, const Image& b, double tolerance) {
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  ASSERT_EQ(a.channels, b.channels);
  for (size_t i = 0; i < a.data.size(); ++i) ASSERT_NEAR(a.data[i], b.data[i], tolerance) << i;
}

TEST(Srgb, IsItsOwnInverse) {
  for (int i = 0; i <= 1000; ++i) {
    // The standard's two constants meet only to about 1e-8.
    EXPECT_NEAR(linear_to_srgb(srgb_to_linear(i / 1000.0)), i / 1000.0, 1e-7);
  }
  EXPECT_DOUBLE_EQ(srgb_to_linear(1), 1);
  EXPECT_DOUBLE_EQ(srgb_to_linear(0.5), std::pow(1.11 / 2.11, 2.4));
  EXPECT_DOUBLE_EQ(linear_to_srgb(0.001), 0.01292);
}

TEST(Image, RefusesImpossibleSizes) {
  EXPECT_THROW(Image(0, 1, 1), UsageError);
  EXPECT_THROW(Image(1, -1, 1), UsageError);
  EXPECT_THROW(Image(1, 1, 0), UsageError);
  EXPECT_THROW(Image(1 << 20, 1 << 20, 3), UsageError);
  EXPECT_THROW(Image(std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), 4),
               UsageError);
}

TEST(ImageIo, ReadsIntegersOfEveryFormat) {
  for (int channels = 1; channels <= 4; ++channels) {
    const Image image = random_levels(31, 17, channels, 255);
    const ReadImage png = read_image_memory(png8_bytes(image), "x");
    EXPECT_EQ(png.image, image);
    EXPECT_EQ(png.bits, 8);
    EXPECT_TRUE(png.srgb_encoded);
    EXPECT_EQ(png.has_alpha, channels % 2 == 0);
    const Image fine = random_levels(31, 17, channels, 65535);
    const ReadImage png16 = read_image_memory(png16_bytes(fine), "x");
    EXPECT_EQ(png16.image, fine);
    EXPECT_EQ(png16.bits, 16);
    EXPECT_TRUE(png16.srgb_encoded);
    if (channels == 2) continue;  // as TGA, stb writes grey with alpha in a way that it cannot read
    EXPECT_EQ(read_image_memory(tga_bytes(image), "x.TGA").image, image) << channels;
    if (channels == 1) continue;  // and grey BMPs it writes in colour
    EXPECT_EQ(read_image_memory(bmp_bytes(image), "x").image, image) << channels;
  }
}

TEST(ImageIo, ReadsJpeg) {
  for (const bool progressive : {false, true}) {
    const ReadImage read = read_image_memory(jpeg_bytes(progressive), "x");
    EXPECT_TRUE(read.srgb_encoded);
    EXPECT_FALSE(read.has_alpha);
    expect_near(read.image, jpeg_image(), 4.0 / 255);
  }
}

TEST(ImageIo, LinearImageDecodesColourButNotAlpha) {
  const Image image = random_levels(16, 16, 4, 255);
  const Image linear = linear_image(read_image_memory(png8_bytes(image), "x"));
  for (size_t i = 0; i < image.data.size(); ++i) {
    const float v = image.data[i];
    EXPECT_NEAR(linear.data[i], i % 4 == 3 ? v : srgb_to_linear(v), 1e-7);
  }
  const Image radiance = random_image(16, 16, 3, 50);
  EXPECT_EQ(linear_image(read_image_memory(encode_exr({{"", radiance}}, false, {}), "x")),
            radiance);
}

TEST(ImageIo, PngIsExposedClippedEncodedAndRounded) {
  const TemporaryFolder folder;
  Image image(4, 2, 3);
  image.data = {0,        1,      2,    -1,    std::nanf(""),
                INFINITY, 0.18f,  0.5f, 0.25f, 0.001f,
                0.002f,   0.003f, 0,    0,     0,
                0,        0,      0,    0,     0,
                0,        0,      0,    0};
  for (const double exposure : {0.0, 1.0, -2.5}) {
    write_png(folder / "a.png", image, exposure);
    const ReadImage read = read_image(folder / "a.png");
    for (size_t i = 0; i < image.data.size(); ++i) {
      double v = std::exp2(exposure) * static_cast<double>(image.data[i]);
      v = std::isnan(v) ? 0 : std::min(std::max(v, 0.0), 1.0);
      EXPECT_EQ(read.image.data[i], static_cast<float>(std::round(255 * linear_to_srgb(v)) / 255))
          << i << " " << exposure;
    }
  }
}

TEST(ImageIo, JpegShowsWhatPngDoes) {
  const TemporaryFolder folder;
  for (const int channels : {1, 3}) {
    Image image(40, 24, channels);
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 40; ++x)
        for (int c = 0; c < channels; ++c)
          image.at(x, y, c) = static_cast<float>(0.1 + 0.005 * x * (c + 1) + 0.01 * y);
    write_png(folder / "a.png", image, -0.5);
    const ReadImage read = read_image_memory(jpeg_of(image, -0.5), "a.jpg");
    EXPECT_TRUE(read.srgb_encoded);
    expect_near(read.image, read_image(folder / "a.png").image, 4.0 / 255);
  }
}

TEST(ImageIo, PngAlphaIsNeitherExposedNorEncoded) {
  const TemporaryFolder folder;
  Image image(1, 1, 4);
  image.data = {0.5f, 0.5f, 0.5f, 0.4f};
  write_png(folder / "a.png", image, 3);
  EXPECT_EQ(read_image(folder / "a.png").image.data[3], 102 / 255.0f);
}

TEST(ImageIo, HdrKeepsEightBitsOfTheLargestChannel) {
  const TemporaryFolder folder;
  for (const int width : {5, 40}) {  // stored flat, and in runs
    const Image image = random_image(width, 11, 3, 1000);
    write_hdr(folder / "a.hdr", image);
    const ReadImage read = read_image(folder / "a.hdr");
    EXPECT_FALSE(read.srgb_encoded);
    EXPECT_EQ(read.bits, 32);
    ASSERT_EQ(read.image.channels, 3);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < width; ++x) {
        const float largest = std::max({image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)});
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(read.image.at(x, y, c), image.at(x, y, c), largest / 127);
      }
    }
  }
  Image odd(2, 1, 3);
  odd.data = {-1, std::nanf(""), INFINITY, 0, 0, 0};
  write_hdr(folder / "odd.hdr", odd);
  const Image read = read_image(folder / "odd.hdr").image;
  EXPECT_EQ(read.data[0], 0);
  EXPECT_EQ(read.data[1], 0);
  EXPECT_NEAR(read.data[2], 1e38, 1e36);
}

TEST(ImageIo, ContentDecidesHowAFileIsRead) {
  const TemporaryFolder folder;
  const Image image = random_image(8, 8, 3);
  write_exr(folder / "really.png", image);
  EXPECT_EQ(read_image(folder / "really.png").image, image);
}

TEST(ImageIo, ExtensionDecidesHowAFileIsWritten) {
  const TemporaryFolder folder;
  const Image image = random_image(8, 8, 3);
  WriteOptions options;
  options.metadata = {{"pymlt.seed", "7"}};
  write_image(folder / "a.EXR", image, options);
  EXPECT_EQ(read_image(folder / "a.EXR").image, image);
  EXPECT_EQ(read_exr_metadata(folder / "a.EXR"), options.metadata);
  write_image(folder / "a.png", image);
  EXPECT_TRUE(read_image(folder / "a.png").srgb_encoded);
  write_image(folder / "a.JPG", image);
  EXPECT_EQ(read_file(folder / "a.JPG"), jpeg_of(image));
  write_image(folder / "a.hdr", {{"", image}, {"error", image}});
  EXPECT_FALSE(read_image(folder / "a.hdr").srgb_encoded);
  for (const char* name : {"a.tiff", "a", "a.exr.bak", ".exr"}) {
    try {
      write_image(folder / name, image);
      FAIL() << name;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(".exr, .png, .jpg, .jpeg, .hdr"), std::string::npos);
    }
  }
  EXPECT_EQ(files_in(folder.path()), 4u);
}

TEST(ImageIo, EqualRendersAreEqualFiles) {
  const TemporaryFolder folder;
  const Image image = random_image(64, 64, 3);
  for (const std::string extension : {".exr", ".png", ".jpg", ".hdr"}) {
    write_image(folder / ("a" + extension), image);
    write_image(folder / ("b" + extension), image);
    EXPECT_EQ(read_file(folder / ("a" + extension)), read_file(folder / ("b" + extension)));
  }
}

TEST(ImageIo, AnImageThatDoesNotFitIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_png(folder / "a.png", Image(2, 2, 5)), UsageError);
  EXPECT_THROW(write_hdr(folder / "a.hdr", Image()), UsageError);
  EXPECT_THROW(write_jpeg(folder / "a.jpg", Image(2, 2, 4)), UsageError);
  EXPECT_THROW(write_jpeg(folder / "a.jpg", Image(65501, 1, 1)), UsageError);
  Image lying(4, 4, 3);
  lying.width = 400;
  EXPECT_THROW(write_png(folder / "a.png", lying), UsageError);
  EXPECT_THROW(write_jpeg(folder / "a.jpg", lying), UsageError);
  EXPECT_THROW(write_exr(folder / "a.exr", lying), UsageError);
  EXPECT_THROW(write_image(folder / "a.exr", std::vector<ExrLayer>{}), UsageError);
  EXPECT_EQ(files_in(folder.path()), 0u);
}

TEST(ImageIo, ReadingSaysWhichFileAndWhy) {
  const TemporaryFolder folder;
  write_file(folder / "empty.png", "");
  write_file(folder / "text.png", "not an image");
  write_image(folder / "a.png", Image(2, 2, 3));
  const auto message = [&](const std::string& name, const std::string& layer = "") {
    try {
      read_image(folder / name, layer);
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(folder / name), std::string::npos);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message("none.png").find("no such file"), std::string::npos);
  EXPECT_NE(message("empty.png").find("is empty"), std::string::npos);
  EXPECT_NE(message("text.png").find("no image"), std::string::npos);
  EXPECT_NE(message("a.png", "error").find("no layer"), std::string::npos);
  EXPECT_NE(message("").find("folder"), std::string::npos);
}

TEST(AtomicFile, ReplacesWhatALinkNames) {
  const TemporaryFolder folder;
  write_file(folder / "a", "old and longer");
  fs::create_symlink("a", folder / "link");
  write_file(folder / "link", "new");
  EXPECT_EQ(read_file(folder / "a"), "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(files_in(folder.path()), 2u);
}

TEST(AtomicFile, CheckWritableTouchesNothing) {
  const TemporaryFolder folder;
  check_writable(folder / "new.exr");
  EXPECT_EQ(files_in(folder.path()), 0u);
  write_file(folder / "a.png", "content");
  check_writable(folder / "a.png");
  EXPECT_EQ(read_file(folder / "a.png"), "content");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(AtomicFile, CheckWritableKnowsWhatWillFail) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "d.exr");
  write_file(folder / "file", "x");
  ASSERT_EQ(mkfifo((folder / "fifo.exr").c_str(), 0600), 0);
  fs::create_symlink("missing/a.exr", folder / "dangling.exr");
  for (const std::string name :
       {"missing/a.exr", "d.exr", "file/a.exr", "fifo.exr", "d.exr/", "dangling.exr"}) {
    EXPECT_THROW(check_writable(folder / name), Error) << name;
    EXPECT_THROW(write_file(folder / name, "x"), FileError) << name;
  }
  EXPECT_THROW(check_writable(folder / (std::string(300, 'a') + ".exr")), FileError);
  EXPECT_THROW(check_writable(folder / "a.gif"), UsageError);
  EXPECT_THROW(check_writable(""), Error);
  EXPECT_EQ(files_in(folder.path()), 4u);
}

TEST(AtomicFile, CheckWritableKnowsPermissions) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  write_file(folder / "a.exr", "x");
  fs::permissions(folder / "a.exr", fs::perms::owner_read);
  EXPECT_THROW(check_writable(folder / "a.exr"), FileError);
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(check_writable(folder / "closed/a.exr"), FileError);
}

}  // namespace
}  // namespace mlt
