// What the tests of image files share: a folder that goes away, random pixels, and files of kinds
// that the library reads but does not write.
#pragma once

#include <string>

#include "base/rng.h"
#include "image/image.h"

namespace mlt {

/// An empty folder, removed with everything in it at the end of the scope.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Samples from 0 to `scale`.
Image random_image(int width, int height, int channels, double scale = 1, uint64_t seed = 1);

/// Samples that are k / levels, so that an integer format can hold them.
Image random_levels(int width, int height, int channels, int levels);

/// A smooth ramp, and the two files beside this one that libjpeg made of it.
Image jpeg_image();
std::string jpeg_bytes(bool progressive);

/// Encoders by stb and, for 16 bit, by hand; samples as they are, in [0, 1].
std::string png8_bytes(const Image& image);
std::string png16_bytes(const Image& image);
std::string bmp_bytes(const Image& image);
std::string tga_bytes(const Image& image);

enum class ExrSample { half, float32, uint };

/// An EXR file of any kind, with its data window at (x, y) in a display window of w x h pixels.
struct ExrKind {
  ExrSample sample = ExrSample::float32;
  std::vector<std::string> channels;  // one per channel of the image
  bool tiled = false, mipmapped = false;
  int parts = 1;                                            // the second and later ones are black
  int x = 0, y = 0, display_width = 0, display_height = 0;  // 0: the data window
  int compression = 3;                                      // Imf::ZIP_COMPRESSION
};
std::string exr_bytes(const Image& image, const ExrKind& kind);

}  // namespace mlt
