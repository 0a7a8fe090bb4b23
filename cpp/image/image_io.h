// Reading and writing image files. The format of a file that is read follows from its content, that
// of a new one from its extension. EXR and HDR hold linear radiance, the integer formats sRGB.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "image/exr.h"
#include "image/image.h"

namespace mlt {

struct ReadImage {
  Image image;
  bool srgb_encoded = false;  // integer formats; a scene may say otherwise (normal maps, masks)
  bool has_alpha = false;     // the last of 2 or 4 channels; never encoded
  int bits = 32;              // of a stored sample: 8 or 16 (integers), else 32
};

/// Reads EXR, PNG (8 and 16 bit), JPEG, HDR, TGA or BMP, with as many channels as the file has.
/// Only EXR has layers; see decode_exr for which channels "" means. Throws a FileError that names
/// the file. EXR samples may be NaN or infinite, as in the file.
ReadImage read_image(const std::string& path, const std::string& layer = "");

/// As above, from the bytes of a file; `name` is for messages.
ReadImage read_image_memory(std::string_view bytes, const std::string& name,
                            const std::string& layer = "");

/// Whether a file begins like one of these formats. Throws FileError.
bool is_known_image(const std::string& path);

/// The image in linear light, decoded if it was encoded.
Image linear_image(ReadImage read);

/// The text attributes of an EXR file, sorted by name.
Metadata read_exr_metadata(const std::string& path);

/// Stops by which an image may be brightened or darkened.
constexpr double max_exposure = 128;

struct WriteOptions {
  bool half = false;    // EXR: 16-bit samples
  Metadata metadata;    // EXR: text attributes
  double exposure = 0;  // PNG, JPEG: stops by which the image is brightened
};

/// Writes linear samples unchanged. Equal images and options make equal files.
void write_exr(const std::string& path, const Image& image, const WriteOptions& options = {});
void write_exr(const std::string& path, const std::vector<ExrLayer>& layers,
               const WriteOptions& options = {});

/// Writes sRGB with 8 bits: each colour sample is scaled by 2^exposure, clipped to [0, 1],
/// encoded, rounded.
void write_png(const std::string& path, const Image& image, double exposure = 0);

/// As PNG, with the losses of JPEG. Throws UsageError for more than 3 channels.
std::string jpeg_of(const Image& image, double exposure = 0);
void write_jpeg(const std::string& path, const Image& image, double exposure = 0);

void write_hdr(const std::string& path, const Image& image);

/// Writes by extension: .exr, .png, .jpg, .jpeg or .hdr, else a UsageError that lists them. Only
/// EXR holds more than the first layer.
void write_image(const std::string& path, const Image& image, const WriteOptions& options = {});
void write_image(const std::string& path, const std::vector<ExrLayer>& layers,
                 const WriteOptions& options = {});

/// Whether colours in a file of this name are not multiplied by alpha: PNG.
bool has_straight_alpha(const std::string& path);
/// Why a file of this name will have no alpha, or "".
std::string alpha_problem(const std::string& path);

/// Throws now the UsageError or FileError that write_image(path) would throw after a long render.
void check_writable(const std::string& path);

}  // namespace mlt
