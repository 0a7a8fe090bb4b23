// From an image file that a plug-in names to the numbers that it looks up.
#pragma once

#include "base/params.h"
#include "scene/texture/texels.h"

namespace mlt {

/// How stored values become linear ones.
struct Decoding {
  enum class Kind {
    by_format,  ///< sRGB for integer formats, none for EXR and HDR.
    none,
    srgb,
    power
  };
  Kind kind = Kind::by_format;
  double gamma = 1;            ///< For `power`: linear = stored^gamma.
  bool keep_negative = false;  ///< Otherwise negative values become 0, with a warning.
};

/// Those that name an image file, or hold an image.
std::vector<Parameter> image_parameters(const char* filename_doc);

/// Reads the image that the parameter `filename` names, or takes the one in `data`, as 1 (grey) or
/// 3 (RGB) linear channels; alpha is dropped. Throws FileError for a file that cannot be read or
/// holds NaN or infinity.
Image load_image(Params& params, const Decoding& decoding);
/// The same for a texture.
Texels load_texels(Params& params, const Decoding& decoding);

}  // namespace mlt
