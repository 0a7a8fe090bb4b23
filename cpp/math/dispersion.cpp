#include "math/dispersion.h"

#include "base/error.h"
#include "math/colorimetry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mlt {

namespace {

void check_finite(const char* what, double value) {
  if (!std::isfinite(value)) throw UsageError(fmt::format("{} is {}, not finite", what, value));
}

/// At a pole the index is infinite, and beyond it n^2 may be negative.
void check_pole(double c) {
  check_finite("C of a Sellmeier term", c);
  if (c < 0)
    throw UsageError(fmt::format("C of a Sellmeier term is {} um^2, but must not be negative", c));
  const double pole = 1000 * std::sqrt(c);
  if (first_wavelength <= pole && pole <= last_wavelength)
    throw UsageError(fmt::format(
        "a Sellmeier term with C = {} um^2 has its pole at {:.4g} nm; it must lie outside of {} to "
        "{} nm (C is the square of the pole's wavelength)",
        c, pole, first_wavelength, last_wavelength));
}

/// The formulas have no extremum or pole that a step of one nm would miss.
void check_visible(const RefractiveIndex& index, const std::string& origin) {
  for (double nm = first_wavelength; nm <= last_wavelength; ++nm)
    if (const double n = index.at(nm); !(std::isfinite(n) && n > 0))
      throw UsageError(
          fmt::format("{} is an index of refraction of {:.6g} at {} nm; it must be positive from "
                      "{} to {} nm",
                      origin, n, nm, first_wavelength, last_wavelength));
}

}  // namespace

RefractiveIndex::RefractiveIndex(Form form, bool disperses, const std::string& origin)
    : form_(std::move(form)), disperses_(disperses) {
  check_visible(*this, origin);
}

double RefractiveIndex::Sellmeier::at(double nm) const {
  const double square = nm * nm * 1e-6;
  double sum = 1;
  for (const SellmeierTerm& t : *terms) sum += t.b * square / (square - t.c);
  return std::sqrt(sum);
}

RefractiveIndex RefractiveIndex::constant(double n) {
  return {Cauchy{n, 0}, false, fmt::format("{}", n)};
}

RefractiveIndex RefractiveIndex::cauchy(double a, double b) {
  return {Cauchy{a, b}, b != 0, fmt::format("Cauchy's formula with A = {}, B = {} nm^2", a, b)};
}

RefractiveIndex RefractiveIndex::sellmeier(std::vector<SellmeierTerm> terms) {
  for (const SellmeierTerm& t : terms) {
    check_finite("B of a Sellmeier term", t.b);
    check_pole(t.c);
  }
  terms.erase(std::remove_if(terms.begin(), terms.end(), [](const auto& t) { return t.b == 0; }),
              terms.end());
  const bool disperses =
      std::any_of(terms.begin(), terms.end(), [](const auto& t) { return t.c != 0; });
  return {Sellmeier{std::make_shared<const std::vector<SellmeierTerm>>(std::move(terms))},
          disperses, "Sellmeier's formula"};
}

RefractiveIndex RefractiveIndex::abbe(double n_d, double v_d) {
  if (!(v_d > 0))
    throw UsageError(
        fmt::format("Abbe's number is {}, but must be positive (glass: 20 to 90)", v_d));
  const double difference = (n_d - 1) / v_d;  // n_F - n_C
  const double b = difference / (1 / (line_f * line_f) - 1 / (line_c * line_c));
  return {Cauchy{n_d - b / (line_d * line_d), b}, b != 0,
          fmt::format("n_d = {} with Abbe's number {}", n_d, v_d)};
}

RefractiveIndex RefractiveIndex::table(const WavelengthTable& pairs) {
  for (const auto& [nm, n] : pairs)
    if (!(std::isfinite(n) && n > 0))
      throw UsageError(fmt::format(
          "a table has an index of refraction of {} at {} nm; it must be positive", n, nm));
  const bool disperses = std::any_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
    return pair.second != pairs.front().second;
  });
  return {Curve::held_table(pairs), disperses, "a table"};
}

}  // namespace mlt
