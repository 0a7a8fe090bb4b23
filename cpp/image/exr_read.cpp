// The reading part of exr.h. A header that announces more pixels than a file of this size can hold,
// with the best ratio that its compression method can reach, is refused before memory is allocated.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <new>

#include "image/exr.h"
#include "image/validate.h"

namespace mlt {
namespace {

class MemoryInput : public Imf::IStream {
 public:
  MemoryInput(std::string_view bytes, const std::string& name)
      : Imf::IStream(name.c_str()), bytes_(bytes) {}

  bool read(char* target, int count) override {
    if (count < 0 || position_ > bytes_.size() ||
        static_cast<size_t>(count) > bytes_.size() - position_)
      throw std::runtime_error("the file ends early");
    std::memcpy(target, bytes_.data() + position_, static_cast<size_t>(count));
    position_ += static_cast<size_t>(count);
    return position_ < bytes_.size();
  }
  uint64_t tellg() override { return position_; }
  void seekg(uint64_t position) override { position_ = position; }

 private:
  std::string_view bytes_;
  uint64_t position_ = 0;
};

int64_t width_of(const Imath::Box2i& box) { return int64_t{box.max.x} - box.min.x + 1; }
int64_t height_of(const Imath::Box2i& box) { return int64_t{box.max.y} - box.min.y + 1; }

/// The most bytes of pixels for one byte of the file. Deflate: 1032 (RFC 1951: 258 bytes in 2
/// bits), of which PXR24 makes 4 bytes from 3; DWA deflates one DC value for 64 pixels.
int64_t max_expansion(Imf::Compression compression) {
  switch (compression) {
    case Imf::NO_COMPRESSION: return 1;
    case Imf::DWAA_COMPRESSION:
    case Imf::DWAB_COMPRESSION: return 1500 * 64;
    default: return 1500;
  }
}

/// The number of lines that are decompressed together, if the image has as many.
int64_t lines_of_chunk(Imf::Compression compression) {
  switch (compression) {
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION: return 1;
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION: return 16;
    case Imf::DWAB_COMPRESSION: return 256;
    default: return 32;
  }
}

/// The area of a window, which may be more than an integer holds.
double area_of(const Imath::Box2i& window) {
  return static_cast<double>(width_of(window)) * static_cast<double>(height_of(window));
}

void check_header(const Imf::Header& header, size_t file_size) {
  if (header.hasType() && Imf::isDeepData(header.type()))
    throw std::runtime_error("it holds deep data; only flat images can be read");
  const Imath::Box2i &data = header.dataWindow(), &display = header.displayWindow();
  const double pixels = area_of(data);
  if (width_of(data) <= 0 || height_of(data) <= 0 || width_of(display) <= 0 ||
      height_of(display) <= 0)
    throw std::runtime_error("its header says that it has no pixels");
  if (pixels > max_image_pixels)
    throw std::runtime_error("its header says that it has more than 2^31 pixels");
  if (area_of(display) > std::max(16 * pixels, 0x1p26))
    throw std::runtime_error("its display window is far larger than its data");
  if (header.hasTileDescription()) {
    const Imf::TileDescription& tile = header.tileDescription();
    if (static_cast<double>(tile.xSize) * tile.ySize > std::max(4 * pixels, 0x1p22))
      throw std::runtime_error("its header says that a tile is far larger than the image");
  }
  int64_t pixel_size = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    pixel_size += c.channel().type == Imf::HALF ? 2 : 4;
  const double limit = static_cast<double>(max_expansion(header.compression())) *
                       (static_cast<double>(file_size) + 64);
  const double chunk =
      static_cast<double>(width_of(data) * pixel_size * lines_of_chunk(header.compression()));
  constexpr double small_chunk = 0x1p28;
  if (pixels * static_cast<double>(pixel_size) > limit || chunk > std::max(limit, small_chunk))
    throw std::runtime_error(too_many_pixels(width_of(data), height_of(data)));
}

/// Channels of one layer by their last name, in lower case and short ("red" is "r").
using Layer = std::map<std::string, std::string>;

std::string short_name(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  for (const char* word : {"red", "green", "blue", "alpha"})
    if (name == word) return name.substr(0, 1);
  return name;
}

std::map<std::string, Layer> find_layers(const Imf::ChannelList& channels) {
  std::map<std::string, Layer> layers;
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    const std::string name = c.name();
    const size_t dot = name.rfind('.');
    const bool plain = dot == std::string::npos;
    layers[plain ? "" : name.substr(0, dot)].emplace(
        short_name(plain ? name : name.substr(dot + 1)), name);
  }
  return layers;
}

/// The names of a layer's colour channels (and alpha) in order, or nothing.
std::vector<std::string> colour_of(const Layer& layer) {
  std::vector<std::string> names;
  const auto take = [&](const char* c) {
    if (layer.count(c)) names.push_back(layer.at(c));
  };
  if (layer.count("ry") || layer.count("by")) return names;
  if (layer.count("r") && layer.count("g") && layer.count("b")) {
    for (const char* c : {"r", "g", "b", "a"}) take(c);
  } else if (layer.count("y") && !layer.count("x") && !layer.count("z")) {
    for (const char* c : {"y", "a"}) take(c);
  } else if (layer.size() == 1) {
    names.push_back(layer.begin()->second);
  } else if (layer.size() == 2 && layer.count("a")) {
    for (const auto& [key, name] : layer)
      if (key != "a") names = {name, layer.at("a")};
  }
  return names;
}

std::vector<std::string> choose_channels(const Imf::ChannelList& channels,
                                         const std::string& wanted) {
  const std::map<std::string, Layer> layers = find_layers(channels);
  for (const auto& [name, layer] : layers) {
    if (!wanted.empty() && name != wanted) continue;
    const std::vector<std::string> names = colour_of(layer);
    if (!names.empty()) return names;
  }
  std::string list;
  for (auto c = channels.begin(); c != channels.end() && list.size() < 200; ++c)
    list += (list.empty() ? "" : ", ") + std::string(c.name());
  throw std::runtime_error(
      (wanted.empty() ? "" : "in layer '" + wanted + "' ") +
      std::string("it needs channels R, G, B, or Y, or a single one, but has ") +
      (list.empty() ? "none" : list));
}

/// Copies the part of the data window that lies in the display window.
Image through_display_window(Image&& pixels, const Imath::Box2i& data,
                             const Imath::Box2i& display) {
  if (data == display) return std::move(pixels);
  const int x0 = std::max(data.min.x, display.min.x), x1 = std::min(data.max.x, display.max.x);
  const int y0 = std::max(data.min.y, display.min.y), y1 = std::min(data.max.y, display.max.y);
  if (x0 > x1 || y0 > y1)
    throw std::runtime_error("its data window lies outside its display window");
  Image shown(static_cast<int>(width_of(display)), static_cast<int>(height_of(display)),
              pixels.channels);
  for (int y = y0; y <= y1; ++y) {
    const float* from = &pixels.data[pixels.index(x0 - data.min.x, y - data.min.y, 0)];
    std::copy(from, from + pixels.index(x1 - x0 + 1, 0, 0),
              &shown.data[shown.index(x0 - display.min.x, y - display.min.y, 0)]);
  }
  return shown;
}

Image read_part(Imf::InputPart& part, const std::string& layer) {
  const Imf::Header& header = part.header();
  const Imath::Box2i& window = header.dataWindow();
  const std::vector<std::string> names = choose_channels(header.channels(), layer);
  Image image(static_cast<int>(width_of(window)), static_cast<int>(height_of(window)),
              static_cast<int>(names.size()));
  const size_t stride = sizeof(float) * names.size();
  Imf::FrameBuffer frame;
  for (size_t c = 0; c < names.size(); ++c) {
    const Imf::Channel& channel = header.channels()[names[c]];
    if (channel.xSampling != 1 || channel.ySampling != 1)
      throw std::runtime_error("its channel '" + names[c] + "' is subsampled; write it as RGB");
    frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, image.data.data() + c, window, stride));
  }
  part.setFrameBuffer(frame);
  part.readPixels(window.min.y, window.max.y);
  return through_display_window(std::move(image), window, header.displayWindow());
}

/// OpenEXR's own message, without its mention of the file.
[[noreturn]] void fail(const std::string& name, const std::string& reason) {
  throw FileError(name + ": cannot be read as EXR: " + reason);
}

template <class Read>
auto with_file(std::string_view bytes, const std::string& name, const Read& read) {
  try {
    check_exr_headers(bytes);
    MemoryInput stream(bytes, name);
    Imf::MultiPartInputFile file(stream, 0, false);
    return read(file);
  } catch (const std::bad_alloc&) {
    fail(name, "it needs more memory than is available");
  } catch (const std::exception& error) {
    fail(name, error.what());
  }
}

}  // namespace

Image decode_exr(std::string_view bytes, const std::string& name, const std::string& layer) {
  return with_file(bytes, name, [&](Imf::MultiPartInputFile& file) {
    check_header(file.header(0), bytes.size());
    Imf::InputPart part(file, 0);
    return read_part(part, layer);
  });
}

Metadata decode_exr_metadata(std::string_view bytes, const std::string& name) {
  return with_file(bytes, name, [](Imf::MultiPartInputFile& file) {
    Metadata metadata;
    const Imf::Header& header = file.header(0);
    for (auto a = header.begin(); a != header.end(); ++a) {
      const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
      if (text && std::strcmp(a.name(), "type") != 0)
        metadata.emplace_back(a.name(), text->value());
    }
    return metadata;
  });
}

}  // namespace mlt
