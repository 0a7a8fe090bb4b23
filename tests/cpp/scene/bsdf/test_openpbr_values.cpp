// OpenPBR beside MaterialX's graph of it, which the specification names as its reference (stored in
// openpbr_values.inc). Single values differ, as layers here are symmetric, microfacets mask each
// other independently, and MaterialX cuts off the cosine between the directions in its rough
// diffuse lobe; in the median over directions that differ by angle and azimuth they agree.
#include "scene/bsdf/bsdf_testing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace mlt::test {
namespace {

struct OpenPbrRow {
  const char* label;
  Vec3 wl, wc;
  Color f;
};

const OpenPbrRow openpbr_rows[] = {
#include "scene/bsdf/openpbr_values.inc"
};

const Value pink = Triple{0.8, 0.3, 0.4}, blue = Triple{0.5, 0.7, 0.9},
            gold = Triple{0.9, 0.7, 0.3};

Given metal(Given more) {
  for (const auto& [name, value] :
       Given{{"base_metalness", 1.0}, {"base_color", gold}, {"specular_color", blue}})
    more.push_back({name, value});
  return more;
}

/// The materials of openpbr_values.py.
std::map<std::string, Given> reference_materials() {
  return {
      {"default", {}},
      {"rough", {{"specular_roughness", 0.8}, {"base_color", pink}}},
      {"dense", {{"specular_ior", 2.0}, {"specular_roughness", 0.5}, {"base_color", pink}}},
      {"clay", {{"base_diffuse_roughness", 1.0}, {"base_color", pink}}},
      {"metal", metal({{"specular_roughness", 0.3}})},
      {"rough metal", metal({{"specular_roughness", 0.8}})},
      {"stretched metal",
       metal({{"specular_roughness", 0.5}, {"specular_roughness_anisotropy", 0.7}})},
      {"coated",
       {{"coat_weight", 1.0}, {"coat_roughness", 0.3}, {"base_color", pink}, {"coat_color", blue}}},
      {"coated metal",
       metal({{"coat_weight", 0.6}, {"coat_roughness", 0.4}, {"coat_darkening", 0.0}})},
      {"fuzz", {{"fuzz_weight", 1.0}, {"base_color", pink}}},
      {"dust",
       {{"fuzz_weight", 0.8}, {"fuzz_roughness", 0.9}, {"fuzz_color", blue}, {"base_color", pink}}},
      {"film", {{"thin_film_weight", 1.0}, {"thin_film_thickness", 0.4}, {"base_color", 0.0}}}};
}

TEST(OpenPbrValues, AgreeWithTheReferenceInTheMedian) {
  std::map<std::string, std::vector<double>> ratios;
  const auto materials = reference_materials();
  for (const OpenPbrRow& row : openpbr_rows) {
    const BsdfPtr bsdf = make_bsdf("openpbr", materials.at(row.label));
    const Spectrum f = bsdf->eval(point(), normalize(row.wl), normalize(row.wc), Lobe::smooth);
    for (int k = 0; k < 3; ++k) {
      ratios[row.label].push_back(f[k] / row.f[k]);
      EXPECT_GT(f[k], 0.5 * row.f[k]) << row.label << ", cos " << row.wl.z << " " << row.wc.z;
      EXPECT_LT(f[k], 1.2 * row.f[k]) << row.label << ", cos " << row.wl.z << " " << row.wc.z;
    }
  }
  EXPECT_EQ(ratios.size(), materials.size());
  for (auto& [label, all] : ratios) {
    std::nth_element(all.begin(), all.begin() + all.size() / 2, all.end());
    EXPECT_NEAR(all[all.size() / 2], 1, 0.03) << label;
  }
}

}  // namespace
}  // namespace mlt::test
