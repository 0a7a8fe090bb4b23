// Loading the image of a plug-in, from a file or from the scene.
#pragma once

#include "base/params.h"
#include "scene/texture/texels.h"

namespace mlt {

/// The decoding of stored values to linear ones.
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

/// The parameters for an image: the name of a file, or the image itself.
std::vector<Parameter> image_parameters(const char* filename_doc);

/// Reads the image that the parameter `filename` names, or takes the one in `data`, as 1 (grey) or
/// 3 (RGB) linear channels; alpha is dropped. Throws FileError for a file that cannot be read or
/// holds NaN or infinity.
Image load_image(Params& params, const Decoding& decoding);
/// Loads the texels of a texture, as above.
Texels load_texels(Params& params, const Decoding& decoding);

}  // namespace mlt
