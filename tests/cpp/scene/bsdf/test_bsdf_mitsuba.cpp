// The same values as Mitsuba 3 (stored in mitsuba_values.inc). Bounds of the relative difference:
// Mitsuba computes in single precision; its plastics use a polynomial fit and a coarse quadrature
// for the internal reflectance; its Beckmann densities use the rational fit of G1 (Walter et al.
// 2007, sec. 5.2), ours the exact one. Lobe probabilities of the plastics are our own, and where
// all normals are sampled Mitsuba widens the distribution of a roughdielectric (Walter et al., sec.
// 5.3). Samples of a bent normal are shared with the normal turned around.
#include "scene/bsdf/bsdf_testing.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

struct Row {
  const char* label;
  Vec3 wl, wc;
  Color f;
  double pdf;
};

const Row rows[] = {
#include "scene/bsdf/mitsuba_values.inc"
};

constexpr double single_precision = 2e-4;
constexpr double coating = 2.5e-3;
constexpr double masking_fit = 3.6e-3;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(BsdfMitsuba, ValuesAgree) {
  for (const Row& row : rows) {
    const Case& c = find_case(row.label);
    const Vec3 wl = normalize(row.wl), wc = normalize(row.wc);
    const Spectrum f = c.bsdf->eval(point(), wl, wc, Lobe::smooth);
    const double bound = contains(row.label, "plastic") ? coating : single_precision;
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(f[k], row.f[k], bound * row.f[k]) << row.label << ", cos " << wl.z << " " << wc.z;
  }
}

TEST(BsdfMitsuba, DensitiesAgreeWhereSamplingIsAlike) {
  for (const Row& row : rows) {
    const Case& c = find_case(row.label);
    if (contains(row.label, "plastic") || contains(row.label, "all normals") ||
        contains(row.label, "normalmap"))
      continue;
    const double pdf = c.bsdf->pdf(point(), normalize(row.wc), normalize(row.wl), Lobe::smooth);
    const double bound = contains(row.label, "beckmann") ? masking_fit : single_precision;
    EXPECT_NEAR(pdf, row.pdf, bound * row.pdf) << row.label;
  }
}

}  // namespace
}  // namespace mlt::test
