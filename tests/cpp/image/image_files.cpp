#include "image/image_files.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTileDescription.h>
#include <ImfTiledOutputFile.h>
#include <stdlib.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/atomic_file.h"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace mlt {
namespace {

void append(void* target, void* data, int size) {
  static_cast<std::string*>(target)->append(static_cast<char*>(data), static_cast<size_t>(size));
}

std::vector<unsigned char> to_bytes(const Image& image) {
  std::vector<unsigned char> bytes;
  for (const float v : image.data)
    bytes.push_back(static_cast<unsigned char>(std::lround(255.0 * v)));
  return bytes;
}

std::string big_endian(uint32_t v) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(v >> shift & 255);
  return bytes;
}

std::string png_chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto crc =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(static_cast<uint32_t>(data.size())) + body +
         big_endian(static_cast<uint32_t>(crc));
}

/// Samples in the type of the file, kept alive while it is written.
struct Buffers {
  Buffers(const Image& image, ExrSample sample) : type(pixel_type(sample)) {
    for (const float v : image.data) {
      halfs.push_back(half(v));
      uints.push_back(v > 0 ? static_cast<unsigned>(v) : 0);
      floats.push_back(v);
    }
  }
  static Imf::PixelType pixel_type(ExrSample sample) {
    if (sample == ExrSample::half) return Imf::HALF;
    return sample == ExrSample::uint ? Imf::UINT : Imf::FLOAT;
  }
  char* base() {
    if (type == Imf::HALF) return reinterpret_cast<char*>(halfs.data());
    if (type == Imf::UINT) return reinterpret_cast<char*>(uints.data());
    return reinterpret_cast<char*>(floats.data());
  }
  size_t sample_size() const { return type == Imf::HALF ? 2 : 4; }

  Imf::PixelType type;
  std::vector<half> halfs;
  std::vector<unsigned> uints;
  std::vector<float> floats;
};

Imf::Header exr_header(const Image& image, const ExrKind& kind, Imf::PixelType type) {
  const Imath::Box2i data({kind.x, kind.y}, {kind.x + image.width - 1, kind.y + image.height - 1});
  const Imath::Box2i display({0, 0}, {kind.display_width - 1, kind.display_height - 1});
  Imf::Header header(kind.display_width > 0 ? display : data, data);
  header.compression() = static_cast<Imf::Compression>(kind.compression);
  for (const std::string& name : kind.channels) header.channels().insert(name, Imf::Channel(type));
  if (kind.tiled)
    header.setTileDescription(
        Imf::TileDescription(16, 8, kind.mipmapped ? Imf::MIPMAP_LEVELS : Imf::ONE_LEVEL));
  return header;
}

Imf::FrameBuffer exr_frame(const Image& image, const ExrKind& kind, Buffers* buffers) {
  Imf::FrameBuffer frame;
  const size_t stride = buffers->sample_size() * static_cast<size_t>(image.channels);
  const Imath::Box2i data({kind.x, kind.y}, {kind.x + image.width - 1, kind.y + image.height - 1});
  for (size_t c = 0; c < kind.channels.size(); ++c)
    frame.insert(kind.channels[c],
                 Imf::Slice::Make(buffers->type, buffers->base() + c * buffers->sample_size(), data,
                                  stride));
  return frame;
}

void write_parts(const std::string& path, const Image& image, const ExrKind& kind) {
  Image black = image;
  std::fill(black.data.begin(), black.data.end(), 0.0f);
  Buffers first(image, kind.sample), rest(black, kind.sample);
  std::vector<Imf::Header> headers;
  for (int i = 0; i < kind.parts; ++i) {
    headers.push_back(exr_header(image, kind, first.type));
    headers.back().setName("part" + std::to_string(i));
    headers.back().setType(Imf::SCANLINEIMAGE);
  }
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), kind.parts);
  for (int i = 0; i < kind.parts; ++i) {
    Imf::OutputPart part(file, i);
    part.setFrameBuffer(exr_frame(image, kind, i == 0 ? &first : &rest));
    part.writePixels(image.height);
  }
}

/// Every level holds the corner of the full image: only level 0 is an image anyone should see.
void write_tiles(const std::string& path, const Image& image, const ExrKind& kind) {
  Buffers buffers(image, kind.sample);
  Imf::TiledOutputFile file(path.c_str(), exr_header(image, kind, buffers.type));
  file.setFrameBuffer(exr_frame(image, kind, &buffers));
  for (int level = 0; level < file.numLevels(); ++level)
    file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "pymlt-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

Image random_image(int width, int height, int channels, double scale, uint64_t seed) {
  Image image(width, height, channels);
  Rng rng(seed, Purpose::test, 0);
  for (float& v : image.data) v = static_cast<float>(scale * rng.next());
  return image;
}

Image random_levels(int width, int height, int channels, int levels) {
  Image image(width, height, channels);
  Rng rng(1, Purpose::test, 1);
  for (float& v : image.data)
    v = static_cast<float>(static_cast<double>(rng.below(static_cast<uint64_t>(levels) + 1)) /
                           levels);
  return image;
}

std::string png8_bytes(const Image& image) {
  std::string bytes;
  stbi_write_png_to_func(append, &bytes, image.width, image.height, image.channels,
                         to_bytes(image).data(), image.width * image.channels);
  return bytes;
}

std::string png16_bytes(const Image& image) {
  std::string raw;
  for (int y = 0; y < image.height; ++y) {
    raw += '\0';
    for (int i = 0; i < image.width * image.channels; ++i) {
      const long v = std::lround(65535.0 * image.data[image.index(0, y, i)]);
      raw += {static_cast<char>(v >> 8), static_cast<char>(v & 255)};
    }
  }
  uLongf size = compressBound(raw.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(raw.data()), raw.size());
  packed.resize(size);
  const char colour_type[] = {0, 4, 2, 6};
  std::string header = big_endian(static_cast<uint32_t>(image.width)) +
                       big_endian(static_cast<uint32_t>(image.height));
  header += {16, colour_type[image.channels - 1], 0, 0, 0};
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", packed) +
         png_chunk("IEND", "");
}

Image jpeg_image() {
  Image ramp(24, 18, 3);
  for (int y = 0; y < 18; ++y) {
    for (int x = 0; x < 24; ++x) {
      for (int c = 0; c < 3; ++c) ramp.at(x, y, c) = static_cast<float>(x + y * (c + 1)) / 96;
    }
  }
  return ramp;
}

std::string jpeg_bytes(bool progressive) {
  return read_file(progressive ? "tests/cpp/image/progressive.jpg"
                               : "tests/cpp/image/baseline.jpg");
}

std::string bmp_bytes(const Image& image) {
  std::string bytes;
  stbi_write_bmp_to_func(append, &bytes, image.width, image.height, image.channels,
                         to_bytes(image).data());
  return bytes;
}

std::string tga_bytes(const Image& image) {
  std::string bytes;
  stbi_write_tga_to_func(append, &bytes, image.width, image.height, image.channels,
                         to_bytes(image).data());
  return bytes;
}

std::string exr_bytes(const Image& image, const ExrKind& kind) {
  const TemporaryFolder folder;
  const std::string path = folder / "kind.exr";
  if (kind.parts > 1) {
    write_parts(path, image, kind);
  } else if (kind.tiled) {
    write_tiles(path, image, kind);
  } else {
    Buffers buffers(image, kind.sample);
    Imf::OutputFile file(path.c_str(), exr_header(image, kind, buffers.type));
    file.setFrameBuffer(exr_frame(image, kind, &buffers));
    file.writePixels(image.height);
  }
  return read_file(path);
}

}  // namespace mlt
