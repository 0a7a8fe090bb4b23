// The writing part of exr.h.
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

class FileOutput : public Imf::OStream {
 public:
  explicit FileOutput(AtomicFile& file) : Imf::OStream("file"), file_(file) {}

  void write(const char* source, int count) override {
    file_.write({source, static_cast<size_t>(count)});
  }
  uint64_t tellp() override { return file_.position(); }
  void seekp(uint64_t position) override { file_.seek(position); }

 private:
  AtomicFile& file_;
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

/// Adds text attributes, which must not replace those that describe the file.
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

/// The channels of all layers, as samples of the file's type for some rows at a time.
class Rows {
 public:
  static constexpr int most = 16;  ///< Rows that ZIP compresses together.

  Rows(const std::vector<ExrLayer>& layers, bool halfs) : layers_(layers), halfs_(halfs) {
    for (const ExrLayer& layer : layers)
      buffers_.emplace_back(has_halfs(layer) ? static_cast<size_t>(most) * row_size(layer) : 0);
  }

  Imf::PixelType type(const ExrLayer& layer) const {
    return has_halfs(layer) ? Imf::HALF : Imf::FLOAT;
  }

  /// The frame buffer of `count` rows from y on.
  Imf::FrameBuffer frame(int y, int count) {
    Imf::FrameBuffer frame;
    for (size_t l = 0; l < layers_.size(); ++l) {
      const size_t sample = has_halfs(layers_[l]) ? sizeof(half) : sizeof(float);
      const Image& image = layers_[l].image;
      const size_t row = row_size(layers_[l]), first = row * static_cast<size_t>(y);
      const char* base = reinterpret_cast<const char*>(image.data.data());
      if (has_halfs(layers_[l])) {
        const auto from = image.data.begin() + static_cast<std::ptrdiff_t>(first);
        std::transform(from, from + static_cast<std::ptrdiff_t>(row) * count, buffers_[l].begin(),
                       to_half);
        base = reinterpret_cast<const char*>(buffers_[l].data()) - sample * first;
      }
      for (const std::string& name : channel_names(layers_[l])) {
        frame.insert(name, Imf::Slice(type(layers_[l]), const_cast<char*>(base),
                                      sample * static_cast<size_t>(image.channels), sample * row));
        base += sample;
      }
    }
    return frame;
  }

 private:
  static size_t row_size(const ExrLayer& layer) {
    return static_cast<size_t>(layer.image.width) * static_cast<size_t>(layer.image.channels);
  }
  bool has_halfs(const ExrLayer& layer) const { return halfs_ && !layer.always_floats; }

  const std::vector<ExrLayer>& layers_;
  bool halfs_;
  std::vector<std::vector<half>> buffers_;
};

void encode(Imf::OStream& stream, const std::vector<ExrLayer>& layers, bool halfs,
            const Metadata& metadata) {
  check_layers(layers);
  const int width = layers.front().image.width, height = layers.front().image.height;
  Rows rows(layers, halfs);
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  insert_metadata(metadata, &header);
  for (const ExrLayer& layer : layers)
    for (const std::string& name : channel_names(layer)) {
      if (header.channels().findChannel(name))
        throw UsageError("EXR channel '" + name + "' is written twice");
      header.channels().insert(name, Imf::Channel(rows.type(layer)));
    }
  Imf::OutputFile file(stream, header, 0);
  for (int y = 0; y < height; y += Rows::most) {
    const int count = std::min(Rows::most, height - y);
    file.setFrameBuffer(rows.frame(y, count));
    file.writePixels(count);
  }
}

}  // namespace

std::string encode_exr(const std::vector<ExrLayer>& layers, bool half, const Metadata& metadata) {
  MemoryOutput stream;
  encode(stream, layers, half, metadata);
  return std::move(stream.bytes);
}

void encode_exr(AtomicFile& file, const std::vector<ExrLayer>& layers, bool half,
                const Metadata& metadata) {
  FileOutput stream(file);
  encode(stream, layers, half, metadata);
}

}  // namespace mlt
