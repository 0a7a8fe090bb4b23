// The file of a spectrum, which becomes a colour of every use and an index of refraction.
#include "fuzz.h"

#include "io/values.h"
#include "math/colorimetry.h"
#include "math/dispersion.h"
#include "scene/texture/texture.h"

#include <cmath>
#include <sstream>

void mlt::fuzz::read(std::string_view bytes) {
  std::istringstream file{std::string(bytes)};
  const WavelengthTable table = read_spectrum_table(file, "input");
  check_spectrum(table);
  for (const SpectrumUse use : {SpectrumUse::reflectance, SpectrumUse::emission})
    if (const Spectrum s = spectrum_of_table(table, use).color.at(0.3); std::isnan(s[0]))
      std::abort();
  if (std::isnan(RefractiveIndex::table(table).sodium())) std::abort();
}
