// The writing half of exr.h.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "image/exr.h"

namespace mlt {
namespace {

class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : Imf::OStream("memory") {}

  void write(const char* source, int count) override {
    const size_t size = static_cast<size_t>(count);
    if (position_ + size > bytes.size()) bytes.resize(position_ + size);
    std::memcpy(bytes.data() + position_, source, size);
    position_ += size;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }

  std::string bytes;

 private:
  size_t position_ = 0;
};

std::vector<std::string> channel_names(const ExrLayer& layer) {
  static const char* const defaults[] = {"Y", "YA", "RGB", "RGBA"};
  const int count = layer.image.channels;
  std::vector<std::string> names = layer.channels;
  if (names.empty() && count >= 1 && count <= 4)
    for (const char* c = defaults[count - 1]; *c; ++c) names.emplace_back(1, *c);
  if (names.size() != static_cast<size_t>(count))
    throw UsageError(fmt::format("layer '{}' has {} channels but {} channel names", layer.name,
                                 count, names.size()));
  for (std::string& name : names)
    if (!layer.name.empty()) name.insert(0, layer.name + ".");
  return names;
}

/// Text attributes must not take the place of those that describe the file.
void insert_metadata(const Metadata& metadata, Imf::Header* header) {
  static const std::set<std::string> reserved = {"name",      "type",     "version",       "view",
                                                 "multiView", "channels", "chunkCount",    "tiles",
                                                 "preview",   "envmap",   "chromaticities"};
  for (const auto& [name, value] : metadata) {
    if (name.empty() || name.size() > 255 || name.find('\0') != std::string::npos)
      throw UsageError("'" + name + "' cannot be the name of an EXR attribute; use 1 to 255 bytes");
    if (reserved.count(name) || header->find(name) != header->end())
      throw UsageError("EXR attribute '" + name + "' is given twice or has a meaning of its own");
    header->insert(name, Imf::StringAttribute(value));
  }
}

/// Rounds to half, but never a finite value to an infinity.
half to_half(float v) {
  return std::isfinite(v) ? half(std::clamp(v, -65504.0f, 65504.0f)) : half(v);
}

void check_layers(const std::vector<ExrLayer>& layers) {
  if (layers.empty()) throw UsageError("an EXR file needs at least one layer");
  const Image& first = layers.front().image;
  for (const ExrLayer& layer : layers) {
    const Image& image = layer.image;
    if (image.width != first.width || image.height != first.height)
      throw UsageError("the layers of an EXR file must have one size, but '" + layer.name +
                       "' differs from '" + layers.front().name + "'");
    if (image.data.size() != Image::sample_count(image.width, image.height, image.channels))
      throw UsageError("layer '" + layer.name + "' has a size that differs from its data");
  }
}

}  // namespace

std::string encode_exr(const std::vector<ExrLayer>& layers, bool half_floats,
                       const Metadata& metadata) {
  check_layers(layers);
  const int width = layers.front().image.width, height = layers.front().image.height;
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  insert_metadata(metadata, &header);

  const Imf::PixelType type = half_floats ? Imf::HALF : Imf::FLOAT;
  const size_t sample_size = half_floats ? sizeof(half) : sizeof(float);
  Imf::FrameBuffer frame;
  std::vector<std::vector<half>> halfs(layers.size());
  for (size_t l = 0; l < layers.size(); ++l) {
    const Image& image = layers[l].image;
    const char* base = reinterpret_cast<const char*>(image.data.data());
    if (half_floats) {
      halfs[l].resize(image.data.size());
      std::transform(image.data.begin(), image.data.end(), halfs[l].begin(), to_half);
      base = reinterpret_cast<const char*>(halfs[l].data());
    }
    const size_t stride = sample_size * static_cast<size_t>(image.channels);
    for (const std::string& name : channel_names(layers[l])) {
      if (header.channels().findChannel(name))
        throw UsageError("EXR channel '" + name + "' is written twice");
      header.channels().insert(name, Imf::Channel(type));
      frame.insert(name, Imf::Slice(type, const_cast<char*>(base), stride,
                                    stride * static_cast<size_t>(width)));
      base += sample_size;
    }
  }

  MemoryOutput stream;
  {
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(frame);
    file.writePixels(height);
  }
  return std::move(stream.bytes);
}

}  // namespace mlt
