#include "scene/emitter/sky_model.h"

#include "math/colorimetry.h"

namespace mlt {
namespace {

// ---- the sky

constexpr int control_points = 6, turbidities = 10;

constexpr double hosek_wilkie[turbidities * 2 * control_points * 3][10] = {
#include "scene/emitter/sky_model.inc"
};

/// The integral of the CIE's y, by which Mitsuba 0.6 divides.
constexpr double luminous_sum = 106.856980;

/// Evaluates, row by row, a Bezier curve of the fifth degree with these control points.
std::array<double, 10> along_elevation(int turbidity, int albedo, int channel, double x) {
  constexpr double binomials[control_points] = {1, 5, 10, 10, 5, 1};
  std::array<double, 10> sum{};
  for (int point = 0; point < control_points; ++point) {
    const double weight =
        binomials[point] * std::pow(x, point) * std::pow(1 - x, control_points - 1 - point);
    const int row = ((turbidity * 2 + albedo) * control_points + point) * 3 + channel;
    for (size_t i = 0; i < sum.size(); ++i) sum[i] += weight * hosek_wilkie[row][i];
  }
  return sum;
}

}  // namespace

SkyModel::SkyModel(double turbidity, const Color& albedo, double elevation) {
  const double x = std::cbrt(elevation / (pi / 2));
  const int low = std::min(static_cast<int>(turbidity), turbidities - 1);
  const double t = turbidity - low;
  for (int channel = 0; channel < 3; ++channel) {
    Coefficients& sum = channels_[channel];
    sum = {};
    for (int i = 0; i < 4; ++i) {
      const double a = albedo[channel];
      const double weight = (i & 1 ? t : 1 - t) * (i & 2 ? a : 1 - a);
      const Coefficients corner = along_elevation(low - 1 + (i & 1), i >> 1, channel, x);
      for (size_t k = 0; k < sum.size(); ++k) sum[k] += weight * corner[k];
    }
  }
}

Color SkyModel::radiance(double cos_theta, double gamma) const {
  const double cos_gamma = std::cos(gamma);
  Color result;
  for (int channel = 0; channel < 3; ++channel) {
    const auto& [mean, A, B, C, D, E, F, G, H, I] = channels_[channel];
    const double mie = (1 + sqr(cos_gamma)) / std::pow(1 + sqr(I) - 2 * I * cos_gamma, 1.5);
    const double f =
        (1 + A * std::exp(B / (cos_theta + 0.01))) *
        (C + D * std::exp(E * gamma) + F * sqr(cos_gamma) + G * mie + H * std::sqrt(cos_theta));
    result[channel] = std::max(0.0, f * mean / luminous_sum);
  }
  return result;
}

// ---- the sun

namespace {

/// Absorption coefficients by wavelength in nm; 0 beyond the ends of a table.
const WavelengthTable ozone{
    {300, 10},   {305, 4.8},  {310, 2.7},  {315, 1.35}, {320, .8},   {325, .38},  {330, .16},
    {335, .075}, {340, .04},  {345, .019}, {350, .007}, {355, 0},    {445, .003}, {450, .003},
    {455, .004}, {460, .006}, {465, .008}, {470, .009}, {475, .012}, {480, .014}, {485, .017},
    {490, .021}, {495, .025}, {500, .03},  {505, .035}, {510, .04},  {515, .045}, {520, .048},
    {525, .057}, {530, .063}, {535, .07},  {540, .075}, {545, .08},  {550, .085}, {555, .095},
    {560, .103}, {565, .11},  {570, .12},  {575, .122}, {580, .12},  {585, .118}, {590, .115},
    {595, .12},  {600, .125}, {605, .13},  {610, .12},  {620, .105}, {630, .09},  {640, .079},
    {650, .067}, {660, .057}, {670, .048}, {680, .036}, {690, .028}, {700, .023}, {710, .018},
    {720, .014}, {730, .011}, {740, .01},  {750, .009}, {760, .007}, {770, .004}, {780, 0},
    {790, 0}};
const WavelengthTable mixed_gases{{759, 0}, {760, 3}, {770, .21}, {771, 0}};
const WavelengthTable water_vapour{
    {689, 0},    {690, .016}, {700, .024}, {710, .0125}, {720, 1},     {730, .87}, {740, .061},
    {750, 1e-3}, {760, 1e-5}, {770, 1e-5}, {780, 6e-4},  {790, .0175}, {800, .036}};

/// Radiance of the sun outside of the atmosphere, in 100 W / (m^2 nm sr).
const WavelengthTable solar{{380, 165.5}, {390, 162.3}, {400, 211.2}, {410, 258.8}, {420, 258.2},
                            {430, 242.3}, {440, 267.6}, {450, 296.6}, {460, 305.4}, {470, 300.6},
                            {480, 306.6}, {490, 288.3}, {500, 287.1}, {510, 278.2}, {520, 271.0},
                            {530, 272.3}, {540, 263.6}, {550, 255.0}, {560, 250.6}, {570, 253.1},
                            {580, 253.5}, {590, 251.3}, {600, 246.3}, {610, 241.7}, {620, 236.8},
                            {630, 232.1}, {640, 228.2}, {650, 223.4}, {660, 219.7}, {670, 215.3},
                            {680, 211.0}, {690, 207.3}, {700, 202.4}, {710, 198.7}, {720, 194.3},
                            {730, 190.7}, {740, 186.3}, {750, 182.6}};

double at_wavelength(const WavelengthTable& table, double wavelength) {
  for (size_t i = 1; i < table.size(); ++i) {
    const auto& [x0, y0] = table[i - 1];
    const auto& [x1, y1] = table[i];
    if (wavelength >= x0 && wavelength <= x1) return y0 + (y1 - y0) * (wavelength - x0) / (x1 - x0);
  }
  return 0;
}

/// The transmittance of the atmosphere, `mass` times as thick as at the zenith.
double transmittance(double wavelength, double mass, double turbidity) {
  const double um = wavelength / 1000;
  const double beta = 0.04608365822050 * turbidity - 0.04586025928522;
  const double gas = at_wavelength(mixed_gases, wavelength) * mass;
  const double water = 2 * at_wavelength(water_vapour, wavelength) * mass;  // 2 cm
  const double depth = 0.008735 * std::pow(um, -4.08) * mass                // Rayleigh
                       + beta * std::pow(um, -1.3) * mass                   // aerosols
                       + 0.35 * at_wavelength(ozone, wavelength) * mass     // 0.35 cm
                       + 1.41 * gas / std::pow(1 + 118.93 * gas, 0.45) +
                       0.2385 * water / std::pow(1 + 20.07 * water, 0.45);
  return std::exp(-depth);
}

}  // namespace

Color sun_radiance(double theta, double turbidity) {
  const double mass = 1 / (std::cos(theta) + 0.000940 * std::pow(1.6386 - theta, -1.253));
  WavelengthTable spectrum;
  for (double wavelength = solar.front().first; wavelength <= solar.back().first; wavelength += 5)
    spectrum.emplace_back(wavelength, 100 * at_wavelength(solar, wavelength) *
                                          transmittance(wavelength, mass, turbidity));
  return spectrum_to_rgb(spectrum, SpectrumUse::emission).color;
}

}  // namespace mlt
