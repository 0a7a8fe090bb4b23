// Files from strangers: cut off anywhere, with any byte changed, or with a size that is a lie, they
// end in a FileError or an image, and never in a crash or an absurd allocation.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <map>

#include "base/atomic_file.h"
#include "base/error.h"
#include "image/image_files.h"
#include "image/image_io.h"

namespace mlt {
namespace {

std::map<std::string, std::string> sample_files() {
  const Image image = random_levels(24, 18, 3, 255), rgba = random_levels(24, 18, 4, 255);
  const std::vector<std::string> rgb = {"R", "G", "B"};
  std::map<std::string, std::string> files = {
      {"a.png", png8_bytes(image)},
      {"alpha.png", png8_bytes(rgba)},
      {"deep.png", png16_bytes(image)},
      {"a.jpg", jpeg_bytes(false)},
      {"progressive.jpg", jpeg_bytes(true)},
      {"a.bmp", bmp_bytes(image)},
      {"a.tga", tga_bytes(image)},
      {"alpha.tga", tga_bytes(rgba)},
      {"a.exr", encode_exr({{"", image}}, false, {})},
      {"half.exr", encode_exr({{"", image}, {"x", image}}, true, {{"k", "v"}})}};
  ExrKind tiled{ExrSample::float32, rgb, true, true};
  files["tiled.exr"] = exr_bytes(image, tiled);
  ExrKind parts{ExrSample::uint, rgb};
  parts.parts = 2;
  files["parts.exr"] = exr_bytes(image, parts);
  for (int compression = 0; compression <= 9; ++compression) {
    ExrKind kind{ExrSample::half, rgb};
    kind.compression = compression;
    files["compression" + std::to_string(compression) + ".exr"] = exr_bytes(image, kind);
  }
  const TemporaryFolder folder;
  write_hdr(folder / "a.hdr", image);
  files["a.hdr"] = read_file(folder / "a.hdr");
  return files;
}

enum class Outcome { image, file_error };

Outcome outcome(const std::string& bytes, const std::string& name) {
  try {
    const ReadImage read = read_image_memory(bytes, name);
    EXPECT_EQ(read.image.data.size(),
              Image::sample_count(read.image.width, read.image.height, read.image.channels));
    return Outcome::image;
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()).rfind(name + ": ", 0), 0u) << error.what();
    return Outcome::file_error;
  }
}

TEST(CorruptImage, IntactFilesAreRead) {
  for (const auto& [name, bytes] : sample_files()) EXPECT_EQ(outcome(bytes, name), Outcome::image);
}

/// Pixels that are not there are never made up.
TEST(CorruptImage, ATruncatedFileIsAnError) {
  for (const auto& [name, bytes] : sample_files()) {
    for (size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 400) {
      const bool only_the_second_part_is_cut = name == "parts.exr" && size > bytes.size() / 2;
      const bool only_small_levels_are_cut = name == "tiled.exr" && size > bytes.size() / 2;
      if (only_the_second_part_is_cut || only_small_levels_are_cut) break;
      // stb's own writer adds nothing after the pixels but, for TGA, a footer that nobody needs.
      if (name.find(".tga") != std::string::npos && size + 26 >= bytes.size()) break;
      EXPECT_EQ(outcome(bytes.substr(0, size), name), Outcome::file_error) << name << " " << size;
    }
  }
}

TEST(CorruptImage, AChangedByteIsSurvived) {
  Rng rng(1, Purpose::test, 0);
  for (const auto& [name, bytes] : sample_files()) {
    for (int i = 0; i < 600; ++i) {
      std::string changed = bytes;
      const int count = 1 + static_cast<int>(rng.below(3));
      for (int k = 0; k < count; ++k) {
        const size_t range = rng.below(2) ? std::min<size_t>(bytes.size(), 400) : bytes.size();
        changed[rng.below(range)] = static_cast<char>(rng.below(256));
      }
      outcome(changed, name);
    }
  }
}

TEST(CorruptImage, PngChecksumsCount) {
  std::string bytes = png8_bytes(random_levels(24, 18, 3, 255));
  bytes[bytes.size() / 2] ^= 1;
  EXPECT_EQ(outcome(bytes, "a.png"), Outcome::file_error);
}

/// Such tables have been written past the end of arrays.
TEST(CorruptImage, AJpegHuffmanTableOfMoreThan256CodesIsAnError) {
  for (const bool progressive : {false, true}) {
    const std::string bytes = jpeg_bytes(progressive);
    int tables = 0;
    for (size_t i = bytes.find("\xff\xc4"); i != std::string::npos;
         i = bytes.find("\xff\xc4", i + 2)) {
      std::string changed = bytes;
      changed.replace(i + 5, 16, std::string(16, '\x20'));
      EXPECT_EQ(outcome(changed, "a.jpg"), Outcome::file_error) << i;
      ++tables;
    }
    EXPECT_GE(tables, 1);
  }
}

TEST(CorruptImage, AnEmptyHuffmanTableIsAnErrorUnderAnyName) {
  const std::string bytes("\xff\xd8\xff\xc4\xff\x00\x13\xff", 8);
  for (const char* name : {"t.jpg", "t.tga", "t.png", "t"})
    EXPECT_EQ(outcome(bytes, name), Outcome::file_error) << name;
}

/// What is no TGA by its content is not tried as one because of its name.
TEST(CorruptImage, ANameMakesNoImage) {
  for (const auto& [name, bytes] : sample_files()) {
    const Image image = read_image_memory(bytes, name).image;
    for (const char* other : {"x.tga", "x.png", "x.exr", "x"})
      EXPECT_EQ(read_image_memory(bytes, other).image, image) << name << " as " << other;
  }
  EXPECT_EQ(outcome("this is a text, and no picture at all", "x.tga"), Outcome::file_error);
}

int64_t peak_memory() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return int64_t{usage.ru_maxrss} * 1024;
}

std::string big(uint32_t v, size_t bytes) {
  std::string result;
  for (size_t i = bytes; i-- > 0;) result += static_cast<char>(v >> (8 * i) & 255);
  return result;
}

std::string little(uint32_t v, size_t bytes) {
  std::string result;
  for (size_t i = 0; i < bytes; ++i) result += static_cast<char>(v >> (8 * i) & 255);
  return result;
}

/// Small files that claim to be huge, or to have no pixels at all.
TEST(CorruptImage, ALyingSizeIsAnErrorAndCostsNothing) {
  const std::map<std::string, std::string> files = sample_files();
  const int64_t before = peak_memory();
  const auto replaced = [](std::string bytes, size_t position, const std::string& part) {
    return bytes.replace(position, part.size(), part);
  };
  for (const uint32_t size : {0u, 40'000u, 0x00ffffffu, 0x7fffffffu, 0xffffffffu}) {
    const uint32_t small = size & 0xffff;
    EXPECT_EQ(outcome(replaced(files.at("a.bmp"), 18, little(size, 4) + little(size, 4)), "a.bmp"),
              Outcome::file_error);
    EXPECT_EQ(
        outcome(replaced(files.at("a.tga"), 12, little(small, 2) + little(small, 2)), "a.tga"),
        Outcome::file_error);
    const std::string& jpeg = files.at("a.jpg");
    const size_t frame = jpeg.find("\xff\xc0");
    EXPECT_EQ(outcome(replaced(jpeg, frame + 5, big(small, 2) + big(small, 2)), "a.jpg"),
              Outcome::file_error);
    const std::string decimal = std::to_string(size);
    EXPECT_EQ(outcome("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + decimal + " +X " + decimal +
                          "\n" + std::string(1000, '\1'),
                      "a.hdr"),
              Outcome::file_error);
    for (const std::string name : {"a.exr", "tiled.exr", "compression9.exr", "compression0.exr"}) {
      const std::string& exr = files.at(name);
      const size_t window =
          exr.find("dataWindow") + std::string("dataWindow\0box2i\0....", 21).size();
      for (const std::string& part :
           {little(size - 1, 4) + little(size - 1, 4), little(size - 1, 4) + little(17, 4),
            little(23, 4) + little(size - 1, 4)})
        EXPECT_EQ(outcome(replaced(exr, window + 8, part), name), Outcome::file_error)
            << name << " " << size;
    }
  }
  const std::string& parts = files.at("parts.exr");
  const size_t count = parts.find("chunkCount") + std::string("chunkCount\0int\0....", 19).size();
  EXPECT_EQ(outcome(replaced(parts, count, little(0x0fffffff, 4)), "parts.exr"),
            Outcome::file_error);
  const std::string& text = files.at("half.exr");
  const size_t size = text.find("string\0", 0, 7) + 7;
  EXPECT_EQ(outcome(replaced(text, size, little(0x7fffffff, 4)), "half.exr"), Outcome::file_error);
  EXPECT_LT(peak_memory() - before, 200 << 20);
}

}  // namespace
}  // namespace mlt
