#include "scene/texture/spectrum_texture.h"

#include "base/text.h"

namespace mlt {

std::shared_ptr<SpectrumTexture> emitted_spectrum(const UsedSpectrum& light) {
  return std::make_shared<SpectrumTexture>([light](SpectrumUse) { return light; });
}

std::shared_ptr<SpectrumTexture> table_spectrum(Params& params, const std::string& name,
                                                const WavelengthTable& table) {
  try {
    check_spectrum(table);
  } catch (const UsageError& error) {
    params.fail(name, std::string("is no valid spectrum: ") + error.what());
  }
  for (const auto& [wavelength, value] : table)
    if (value < 0)
      params.fail(name, fmt::format("is {} at {} nm, but must not be negative", value, wavelength));
  if (is_invisible(table))
    params.fail(fmt::format("has wavelengths from {} to {} nm, none of which is visible ({} to {})",
                            table.front().first, table.back().first, first_wavelength,
                            last_wavelength));
  return std::make_shared<SpectrumTexture>(
      [table](SpectrumUse use) { return spectrum_of_table(table, use); });
}

std::vector<double> numbers_param(Params& params, const std::string& name) {
  const std::string text = params.text(name);
  std::vector<double> numbers;
  for (const std::string_view word : split(text)) {
    const auto number = parse_real(word);
    if (!number) params.fail(name, "contains " + quote(word) + ", which is not a finite number");
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace mlt
