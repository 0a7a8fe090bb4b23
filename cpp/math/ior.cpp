#include "math/ior.h"

#include <cctype>

namespace mlt {

namespace {

struct DielectricEntry {
  const char* name;
  double ior;
};

/// Indices at 589 nm and 0 to 20 degrees Celsius, mostly from Hecht, "Optics", 4th ed.
/// Curves of sapphire (the ordinary ray) and of N-SF11 are from the sources in ior_curves.cpp.
constexpr DielectricEntry dielectrics[] = {
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.5750},      {"sapphire", 1.7681},        {"sf11", 1.7845},
    {"diamond", 2.419},
};

/// The source of the measurements: luxpop.com, or Palik, "Handbook of Optical Constants of Solids",
/// whose values have "_palik" behind the name. `both` have one set of values.
enum Source { luxpop = 1, palik = 2, both = 3 };

struct ConductorEntry {
  const char* name;
  Source source;
  double eta[3], k[3];
};

/// Spectral measurements, converted to linear sRGB as by
/// spectrum_to_rgb(..., SpectrumUse::emission).
constexpr ConductorEntry conductors[] = {
    {"none", luxpop, {0, 0, 0}, {1, 1, 1}},
    {"a-C", luxpop, {2.94405, 2.22714, 1.96816}, {0.887465, 0.799299, 0.81529}},
    {"Ag", luxpop, {0.155276, 0.116728, 0.138388}, {4.82835, 3.12222, 2.1469}},
    {"Al", luxpop, {1.6575, 0.880405, 0.521244}, {9.22381, 6.2695, 4.837}},
    {"AlAs", both, {3.6053, 3.23294, 2.21632}, {0.000679437, 0, 0.00751271}},
    {"AlSb", both, {0, 4.13937, 4.66925}, {0, 0.0940091, 1.30057}},
    {"Au", luxpop, {0.143036, 0.375307, 1.44205}, {3.983, 2.38556, 1.60336}},
    {"Be", both, {4.18501, 3.18503, 2.78406}, {3.83547, 3.01012, 2.86899}},
    {"Cr", luxpop, {4.36967, 2.91651, 1.6549}, {5.20655, 4.23131, 3.7547}},
    {"CsI", both, {2.1449, 1.70232, 1.66243}, {0, 0, 0}},
    {"Cu", luxpop, {0.201005, 0.92375, 1.10222}, {3.91326, 2.45305, 2.14209}},
    {"Cu2O", both, {3.55177, 2.94987, 2.75188}, {0.114207, 0.193897, 0.606134}},
    {"Cu", palik, {0.213229, 0.919715, 1.10241}, {3.92187, 2.45733, 2.13658}},
    {"CuO", both, {3.24754, 2.44781, 2.21022}, {0.52109, 0.570031, 0.722179}},
    {"d-C", both, {2.70872, 2.31883, 2.2289}, {0, 0, 0}},
    {"Hg", both, {2.39894, 1.44003, 0.90957}, {6.32759, 4.37192, 3.42176}},
    {"HgTe", both, {4.77904, 3.2312, 2.6599}, {1.63161, 1.58081, 1.72929}},
    {"Ir", both, {3.0863, 2.08219, 1.61791}, {5.59215, 4.06709, 3.26731}},
    {"K", both, {0.0640432, 0.0464098, 0.0381849}, {2.1042, 1.34894, 0.913126}},
    {"Li", both, {0.265791, 0.195618, 0.220949}, {3.54015, 2.31112, 1.66861}},
    {"MgO", both, {2.08958, 1.65072, 1.59488}, {4.3327e-12, 0, 2.49865e-11}},
    {"Mo", both, {4.48397, 3.52513, 2.77631}, {4.11144, 3.42083, 3.15061}},
    {"Na", palik, {0.0602694, 0.0561409, 0.0619884}, {3.17927, 2.11249, 1.57904}},
    {"Nb", both, {3.42007, 2.79009, 2.39563}, {3.44139, 2.73767, 2.57975}},
    {"Ni", palik, {2.3673, 1.66337, 1.46708}, {4.49881, 3.05015, 2.34544}},
    {"Rh", both, {2.58579, 1.86022, 1.55426}, {6.78226, 4.70299, 3.97607}},
    {"Se", both, {4.05831, 2.84294, 2.82085}, {0.75405, 0.638444, 0.521808}},
    {"Se-e", both, {5.72285, 4.16574, 4.08134}, {0.871136, 1.10516, 1.56532}},
    {"SiC", both, {3.17234, 2.52597, 2.47937}, {7.53766e-07, 0, 1.01925e-05}},
    {"SnTe", both, {4.52425, 1.98164, 1.28159}, {0, 0, 0}},
    {"Ta", both, {2.06272, 2.39294, 2.62793}, {2.40836, 1.74149, 1.94703}},
    {"Te", both, {7.39023, 4.4821, 2.63711}, {3.25602, 3.52706, 3.29205}},
    {"Te-e", both, {7.50891, 4.29643, 2.36999}, {5.58393, 4.94721, 3.99759}},
    {"ThF4", both, {1.83071, 1.44223, 1.38765}, {0, 0, 0}},
    {"TiC", both, {3.70053, 2.83742, 2.58229}, {3.26564, 2.35159, 2.17279}},
    {"TiN", both, {1.64845, 1.15052, 1.37982}, {3.36833, 1.9435, 1.10207}},
    {"TiO2", both, {3.45661, 2.80174, 2.90517}, {0.000105265, 0, 0.000652887}},
    {"TiO2-e", both, {3.10656, 2.51317, 2.58244}, {2.97516e-05, 0, 0.000182698}},
    {"V", palik, {4.27758, 3.51295, 2.76107}, {3.4913, 2.88945, 3.11152}},
    {"VC", both, {3.65757, 2.75274, 2.53267}, {3.0683, 2.19869, 1.96319}},
    {"VN", both, {2.8656, 2.11919, 1.94009}, {3.03224, 2.05612, 1.61631}},
    {"W", luxpop, {4.37082, 3.30025, 2.99841}, {3.50064, 2.60487, 2.27323}},
};

/// Calls visit(name, entry) for every name of a conductor.
template <class Visit>
void for_each_conductor(Visit visit) {
  for (const ConductorEntry& e : conductors) {
    if (e.source & luxpop) visit(std::string(e.name), e);
    if (e.source & palik) visit(std::string(e.name) + "_palik", e);
  }
}

Color color(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

}  // namespace

std::optional<double> find_dielectric(const std::string& name) {
  std::string lower;
  for (unsigned char c : name) lower += static_cast<char>(std::tolower(c));
  for (const DielectricEntry& e : dielectrics)
    if (lower == e.name) return e.ior;
  return std::nullopt;
}

std::vector<std::string> dielectric_names() {
  std::vector<std::string> names;
  for (const DielectricEntry& e : dielectrics) names.emplace_back(e.name);
  return names;
}

std::optional<ComplexIor> find_conductor(const std::string& name) {
  std::optional<ComplexIor> found;
  for_each_conductor([&](const std::string& known, const ConductorEntry& e) {
    if (known == name) found = ComplexIor{color(e.eta), color(e.k)};
  });
  return found;
}

std::vector<std::string> conductor_names() {
  std::vector<std::string> names;
  for_each_conductor(
      [&](const std::string& name, const ConductorEntry&) { names.push_back(name); });
  return names;
}

}  // namespace mlt
