// OpenEXR: linear floats, any number of named layers, and text attributes in the header. A file's
// bytes depend on nothing but its content.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/atomic_file.h"
#include "image/image.h"

namespace mlt {

/// Text in the header of an image, as (name, value).
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// One layer to be written: channel "R" of layer "error" is stored as "error.R", of layer "" as
/// "R".
struct ExrLayer {
  std::string name;
  const Image& image;
  /// Names in place of the default ones: Y, YA, RGB, RGBA for 1 to 4 channels.
  std::vector<std::string> channels = {};
  bool always_floats = false;  ///< Whether it has floats in a file of halfs, too.
};

/// Encodes a scanline file, ZIP-compressed, with nothing in it that was not passed in. Halfs are
/// clamped to their finite range. A UsageError if layers do not fit together.
std::string encode_exr(const std::vector<ExrLayer>& layers, bool half, const Metadata& metadata);

/// As above, into a file, by a few rows at a time.
void encode_exr(AtomicFile& file, const std::vector<ExrLayer>& layers, bool half,
                const Metadata& metadata);

/// The named layer of the first part; with "" the colour of the file: R, G, B (A), else Y (A), else
/// a single channel, else the first layer (by name) that has these. Deep data and subsampled
/// channels are refused. The result covers the display window; pixels outside the data window are
/// 0. `name` is the file's, for messages. Throws FileError.
Image decode_exr(std::string_view bytes, const std::string& name, const std::string& layer = "");

/// All text attributes of the first part, sorted by name.
Metadata decode_exr_metadata(std::string_view bytes, const std::string& name);

}  // namespace mlt
