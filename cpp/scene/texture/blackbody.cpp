// Mitsuba's spectrum of a black body, by Planck's law.
#include "base/registry.h"
#include "scene/texture/spectrum_texture.h"

namespace mlt {
namespace {

constexpr double largest_scale = 1e30;

ObjectPtr make_blackbody(Params& params) {
  const double kelvin = params.real("temperature");
  if (!(kelvin > 0))
    params.fail("temperature", fmt::format("is {} K, but must be above 0", kelvin));
  const double scale = params.real_in("scale", 0, largest_scale);
  const Curve curve = Curve::blackbody(kelvin).scaled(scale);
  const Color rgb = curve_to_rgb(curve);
  if (!std::isfinite(max_component(rgb)))
    params.fail("temperature", fmt::format("is {} K, which is too bright", kelvin));
  return emitted_spectrum({{glm::max(rgb, Color(0)), curve}, min_component(rgb) < 0});
}

}  // namespace

Plugin texture_blackbody() {
  return {{"texture",
           "blackbody",
           "The light of a black body.",
           {{"temperature", ParamType::real, no_default, "In kelvin."},
            {"scale", ParamType::real, 1.0, "A factor on W / (m^2 sr nm)."}}},
          make_blackbody};
}

}  // namespace mlt
