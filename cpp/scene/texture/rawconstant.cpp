// Mitsuba 3's texture that is the same everywhere: numbers as they are, such as a normal.
#include "base/registry.h"
#include "scene/texture/texture.h"

namespace mlt {

Plugin texture_rawconstant() {
  return {{"texture",
           "rawconstant",
           "The same everywhere.",
           {{"value", ParamType::radiance, no_default, "A number, a vector or a colour."}}},
          [](Params& params) -> ObjectPtr {
            const SpectralColor value = to_spectral(params, "value", SpectrumUse::unbounded);
            return std::const_pointer_cast<Texture>(constant_texture(value));
          }};
}

}  // namespace mlt
