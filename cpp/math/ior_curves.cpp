#include "math/ior_curves.h"

#include "math/ior.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <iterator>
#include <string_view>

namespace mlt {

namespace {

// ---- dielectrics

constexpr double sq(double resonance) { return resonance * resonance; }

constexpr size_t most_terms = 8;

struct SellmeierEntry {
  const char* name;
  SellmeierTerm terms[most_terms];  // and zeros
};

constexpr SellmeierEntry sellmeier_entries[] = {
    // M. Daimon, A. Masumura, "Measurement of the refractive index of distilled water from the
    // near-infrared region to the ultraviolet region", Appl. Opt. 46, 3811 (2007), 20 degrees.
    {"water",
     {{5.684027565e-1, 5.101829712e-3},
      {1.726177391e-1, 1.821153936e-2},
      {2.086189578e-2, 2.620722293e-2},
      {1.130748688e-1, 1.069792721e1}}},
    // I. H. Malitson, "Interspecimen comparison of the refractive index of fused silica", J. Opt.
    // Soc. Am. 55, 1205 (1965).
    {"fused quartz",
     {{.6961663, sq(.0684043)}, {.4079426, sq(.1162414)}, {.8974794, sq(9.896161)}}},
    // N-BK7 in Schott's catalogue of 2017.
    {"bk7", {{1.03961212, .00600069867}, {.231792344, .0200179144}, {1.01046945, 103.560653}}},
    // H. H. Li, "Refractive index of alkali halides and its wavelength and temperature
    // derivatives", J. Phys. Chem. Ref. Data 5, 329 (1976), 24 degrees.
    {"sodium chloride",
     {{.00055, 0},
      {.198, sq(.05)},
      {.48398, sq(.1)},
      {.38696, sq(.128)},
      {.25998, sq(.158)},
      {.08796, sq(40.5)},
      {3.17064, sq(60.98)},
      {.30038, sq(120.34)}}},
    // The ordinary ray: I. H. Malitson, M. J. Dodge, "Refractive index and birefringence of
    // synthetic sapphire", J. Opt. Soc. Am. 62, 1405 (1972); the formula is in M. J. Dodge,
    // "Refractive index", Handbook of Laser Science and Technology IV, CRC Press 1986.
    {"sapphire",
     {{1.4313493, sq(.0726631)}, {.65054713, sq(.1193242)}, {5.3414021, sq(18.028251)}}},
    // N-SF11 in Schott's catalogue of 2017, for 370 nm and more.
    {"sf11", {{1.73759695, .013188707}, {.313747346, .0623068142}, {1.89878101, 155.23629}}},
    // F. Peter, "Ueber Brechungsindizes und Absorptionskonstanten des Diamanten zwischen 644 und
    // 226 mu", Z. Phys. 15, 358 (1923).
    {"diamond", {{.3306, sq(.175)}, {4.3356, sq(.106)}}},
};

/// S. G. Warren, R. E. Brandt, "Optical constants of ice from the ultraviolet to the microwave: a
/// revised compilation", J. Geophys. Res. 113, D14220 (2008), -7 degrees; a part of the rows.
const WavelengthTable water_ice{{350, 1.3249}, {390, 1.3203}, {400, 1.3194}, {420, 1.3177},
                                {440, 1.3163}, {460, 1.3151}, {480, 1.3140}, {500, 1.3130},
                                {550, 1.3110}, {600, 1.3094}, {650, 1.3080}, {700, 1.3069},
                                {760, 1.3057}, {830, 1.3044}};

bool same_but_for_case(std::string_view a, std::string_view lower) {
  return std::equal(a.begin(), a.end(), lower.begin(), lower.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == y; });
}

// ---- conductors

struct Measured {
  double nm, value;
};
using MeasuredList = std::initializer_list<Measured>;

struct ConductorRow {
  const char* name;
  MeasuredList eta, k;
};

/// The sources are those of find_conductor's colours. One row stands for both names where the
/// values under them are the same.
constexpr ConductorRow conductor_rows[] = {
#include "math/conductor_tables.inc"
};

const ConductorRow* find_row(std::string_view name) {
  for (const ConductorRow& row : conductor_rows)
    if (name == row.name) return &row;
  constexpr std::string_view palik = "_palik";
  if (name.size() <= palik.size() || name.substr(name.size() - palik.size()) != palik)
    return nullptr;
  return find_row(name.substr(0, name.size() - palik.size()));
}

WavelengthTable as_table(MeasuredList list) {
  WavelengthTable table;
  for (const Measured& m : list) table.emplace_back(m.nm, m.value);
  return table;
}

}  // namespace

std::optional<RefractiveIndex> find_dispersive(const std::string& name) {
  for (const SellmeierEntry& e : sellmeier_entries)
    if (same_but_for_case(name, e.name))
      return RefractiveIndex::sellmeier({std::begin(e.terms), std::end(e.terms)});
  if (same_but_for_case(name, "water ice")) return RefractiveIndex::table(water_ice);
  if (const auto n = find_dielectric(name)) return RefractiveIndex::constant(*n);
  return std::nullopt;
}

std::optional<ConductorTables> find_conductor_tables(const std::string& name) {
  if (!find_conductor(name)) return std::nullopt;
  const ConductorRow* row = find_row(name);
  return row ? ConductorTables{as_table(row->eta), as_table(row->k)} : ConductorTables{};
}

std::optional<ConductorCurves> find_conductor_curves(const std::string& name) {
  const auto tables = find_conductor_tables(name);
  if (!tables) return std::nullopt;
  if (tables->eta.empty()) return ConductorCurves{Curve::constant(0), Curve::constant(1)};
  return ConductorCurves{Curve::held_table(tables->eta), Curve::held_table(tables->k)};
}

}  // namespace mlt
