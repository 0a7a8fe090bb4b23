#include "scene/bsdf/bsdf_testing.h"

#include "scene/texture/texture.h"

#include <algorithm>
#include <stdexcept>

namespace mlt {

#define MLT_PLUGIN(family, name) Plugin family##_##name();
#include "scene/bsdf/list.inc"
MLT_PLUGIN(bsdf, minnaert)  // an example of the documentation
#undef MLT_PLUGIN

namespace test {
namespace {

using namespace std::string_literals;

const Plugin& plugin(const std::string& name) {
  static const std::vector<Plugin> plugins = {
#define MLT_PLUGIN(family, name) family##_##name(),
#include "scene/bsdf/list.inc"
      MLT_PLUGIN(bsdf, minnaert)
#undef MLT_PLUGIN
  };
  for (const Plugin& p : plugins)
    if (p.schema.name == name) return p;
  throw std::logic_error("no bsdf '" + name + "'");
}

class Ramp final : public Texture {
 public:
  Ramp(double low, double high) : low_(low), high_(high) {}
  Spectrum eval(const SurfacePoint& at) const override {
    return Spectrum(low_ + at.uv.x * (high_ - low_));
  }
  Color mean() const override { return Color(0.5 * (low_ + high_)); }
  Color maximum() const override { return Color(std::max(low_, high_)); }

 private:
  double low_, high_;
};

struct Maker {
  std::vector<Case> made;

  void add(const std::string& label, const std::string& name, const Given& given,
           double lost_samples, double max_weight, bool two_sided = false,
           const std::vector<BsdfPtr>& nested = {}) {
    const Schema& schema = bsdf_schema(name);
    made.push_back({label, make_bsdf(name, given, nested), schema.conserves_energy,
                    schema.reciprocal, two_sided, lost_samples, max_weight});
  }
};

/// Lobes are chosen by L*, which is at least a fifth of every channel.
constexpr double gray = 5;

/// The rational fit of Beckmann's G1 is up to 0.35 % too large (Walter et al. 2007, sec. 5.2).
constexpr double fit = 1.0036;

void add_rough(Maker& maker, const std::string& distribution) {
  const auto type = std::make_pair("distribution"s, Value(distribution));
  for (double alpha : {0.02, 0.1, 0.5}) {
    const std::string label = distribution + " " + std::to_string(alpha).substr(0, 4);
    const auto rough = std::make_pair("alpha"s, Value(alpha));
    maker.add("roughconductor " + label, "roughconductor", {type, rough, {"material", "Au"s}}, 1,
              fit);
    maker.add("roughdielectric " + label, "roughdielectric", {type, rough}, 1, fit, true);
    maker.add("roughplastic " + label, "roughplastic", {type, rough}, 1, infinity);
  }
  const auto all_normals = std::make_pair("sample_visible"s, Value(false));
  const auto rough = std::make_pair("alpha"s, Value(0.3));
  maker.add("roughconductor " + distribution + " all normals", "roughconductor",
            {type, rough, all_normals, {"eta", 1.5}, {"k", 2.0}}, 1, infinity);
  maker.add("roughdielectric " + distribution + " all normals", "roughdielectric",
            {type, rough, all_normals, {"int_ior", 1.2}, {"ext_ior", 1.7}}, 1, infinity, true);
  maker.add("roughplastic " + distribution + " all normals", "roughplastic",
            {type, rough, all_normals, {"nonlinear", true}, {"diffuse_reflectance", 0.9}}, 1,
            infinity);
  maker.add("roughconductor " + distribution + " anisotropic", "roughconductor",
            {type, {"alpha_u", 0.05}, {"alpha_v", ramp_texture(0.2, 0.6)}}, 1, fit);
  maker.add("roughdielectric " + distribution + " anisotropic", "roughdielectric",
            {type, {"alpha_u", 0.5}, {"alpha_v", 0.1}, {"specular_transmittance", 0.5}}, 1, fit,
            true);
}

/// Bent normals, by the same amount everywhere, of these materials that the maker has already.
void add_bent(Maker& maker) {
  const Given tilted = {{"normalmap", Triple{0.7, 0.4, 0.9}}};
  for (const char* nested : {"diffuse", "plastic", "dielectric", "twosided"}) {
    const Case c = *std::find_if(maker.made.begin(), maker.made.end(),
                                 [&](const Case& other) { return other.label == nested; });
    const std::string label = nested == "diffuse"s ? "normalmap" : "normalmap of "s + nested;
    maker.add(label, "normalmap", tilted, 1, infinity, c.two_sided, {c.bsdf});
    maker.made.back().symmetric = false;
  }
  for (const auto& [distribution, label] :
       {std::pair("beckmann"s, "normalmap of roughconductor"),
        std::pair("ggx"s, "normalmap of roughconductor, ggx")}) {
    const BsdfPtr gold = make_bsdf(
        "roughconductor",
        {{"distribution", distribution}, {"alpha_u", 0.2}, {"alpha_v", 0.5}, {"material", "Au"s}});
    maker.add(label, "normalmap", tilted, 1, infinity, false, {gold});
    maker.made.back().symmetric = false;
  }
}

void add_principled(Maker& maker) {
  const Value pink = Triple{0.8, 0.3, 0.4};
  const auto add = [&](const std::string& kind, Given given, bool two_sided) {
    given.push_back({"base_color", pink});
    const std::string name = kind.substr(0, kind.find(' '));
    maker.add(kind, name, given, 1, infinity, two_sided);
    maker.made.back().symmetric = name == "principled";  // As Mitsuba 3 has the thin one.
  };
  add("principled", {}, false);
  add("principled metal",
      {{"metallic", 0.7}, {"roughness", 0.3}, {"anisotropic", 0.8}, {"spec_tint", 0.4}}, false);
  add("principled cloth",
      {{"sheen", 0.8},
       {"sheen_tint", 0.6},
       {"flatness", 0.4},
       {"roughness", 0.9},
       {"specular", 0.2}},
      false);
  add("principled coated",
      {{"clearcoat", 0.9}, {"clearcoat_gloss", 0.3}, {"roughness", 0.6}, {"eta", 1.7}}, false);
  add("principled textured",
      {{"metallic", ramp_texture(0, 1)}, {"roughness", ramp_texture(0, 1)}, {"spec_tint", 0.3}},
      false);
  add("principled glass",
      {{"spec_trans", 0.8}, {"metallic", 0.1}, {"eta", 1.4}, {"spec_tint", 0.5}}, true);
  add("principled sharp glass",
      {{"spec_trans", ramp_texture(0, 1)},
       {"roughness", 0.2},
       {"clearcoat", 0.5},
       {"clearcoat_gloss", 1.0},
       {"eta", 0.7}},
      true);
  add("principledthin", {}, true);
  add("principledthin leaf",
      {{"spec_trans", 0.4},
       {"diff_trans", 0.7},
       {"eta", 1.3},
       {"anisotropic", 0.5},
       {"roughness", 0.6},
       {"spec_tint", 0.3},
       {"sheen", 0.5},
       {"sheen_tint", 0.7},
       {"flatness", 0.6}},
      true);
}

void add_openpbr(Maker& maker) {
  const Value pink = Triple{0.8, 0.3, 0.4}, blue = Triple{0.5, 0.7, 0.9};
  const auto add = [&](const std::string& label, Given given, bool two_sided = false) {
    given.push_back({"base_color", pink});
    maker.add("openpbr" + label, "openpbr", given, 1, infinity, two_sided);
  };
  add("", {});
  add(" clay", {{"base_diffuse_roughness", 0.8}, {"specular_weight", 0.3}});
  add(" metal",
      {{"base_metalness", 1.0}, {"specular_color", blue}, {"specular_roughness_anisotropy", 0.7}});
  add(" coated", {{"coat_weight", ramp_texture(0.5, 1)},
                  {"coat_color", blue},
                  {"coat_roughness", 0.3},
                  {"base_metalness", 0.4}});
  add(" sharp coat", {{"coat_weight", 1.0}, {"specular_roughness", 0.6}});
  add(" fuzz", {{"fuzz_weight", 0.9}, {"fuzz_color", blue}, {"coat_weight", 0.5}});
  add(" textured", {{"specular_roughness", ramp_texture(0, 1)},
                    {"base_metalness", ramp_texture(0, 1)},
                    {"specular_weight", ramp_texture(0.2, 1)},
                    {"fuzz_weight", ramp_texture(0, 0.5)},
                    {"fuzz_roughness", 0.8}});
  add(" film", {{"thin_film_weight", 0.8}, {"base_metalness", 0.5}, {"specular_roughness", 0.2}});
  add(" glass", {{"transmission_weight", 1.0}, {"transmission_color", blue}}, true);
  add(" half glass",
      {{"transmission_weight", 0.6},
       {"base_metalness", 0.2},
       {"specular_roughness", 0.7},
       {"specular_ior", 1.3},
       {"coat_weight", 0.5},
       {"coat_color", blue},
       {"fuzz_weight", 0.3},
       {"thin_film_weight", 0.5}},
      true);
  add(" bubble", {{"transmission_weight", 1.0}, {"specular_ior", 0.75}}, true);
  add(" wax", {{"subsurface_weight", 0.6}, {"transmission_weight", 0.2}}, true);
  maker.made.back().symmetric =
      false;  // What enters counts subsurface_weight, what leaves does not.
  const std::pair<std::string, Value> thin{"geometry_thin_walled", true};
  add(" sheet", {thin}, true);
  add(" pane",
      {thin, {"transmission_weight", 0.8}, {"transmission_color", blue}, {"coat_weight", 0.4}},
      true);
  add(" leaf",
      {thin,
       {"subsurface_weight", 0.9},
       {"subsurface_scatter_anisotropy", 0.3},
       {"transmission_weight", 0.2},
       {"thin_film_weight", 0.3},
       {"fuzz_weight", 0.4}},
      true);
  add(" veil", {{"geometry_opacity", ramp_texture(0.4, 0.8)}}, true);
}

const BsdfPtr& find(const Maker& maker, const std::string& label) {
  return std::find_if(maker.made.begin(), maker.made.end(),
                      [&](const Case& c) { return c.label == label; })
      ->bsdf;
}

std::vector<Case> make_cases() {
  Maker maker;
  const Value pink = Triple{0.8, 0.3, 0.4};
  maker.add("diffuse", "diffuse", {{"reflectance", pink}}, 0, 1);
  maker.add("minnaert", "minnaert", {{"reflectance", pink}, {"k", 2.5}}, 0, 1);
  maker.add("null", "null", {}, 0, 1, true);
  maker.add("conductor", "conductor", {{"material", "Cu"s}}, 0, 1);
  maker.add("dielectric", "dielectric", {}, 0, 1, true);
  maker.add("dielectric bubble", "dielectric",
            {{"int_ior", "air"s}, {"ext_ior", "water"s}, {"specular_reflectance", 0.5}}, 0, 1,
            true);
  maker.add("plastic", "plastic", {{"diffuse_reflectance", pink}}, 0, gray);
  maker.add("plastic nonlinear", "plastic",
            {{"diffuse_reflectance", pink}, {"nonlinear", true}, {"int_ior", 1.9}}, 0, gray);
  maker.add("phong", "phong", {{"diffuse_reflectance", pink}}, 1, gray * 32 / 31);
  maker.add("phong hemisphere", "phong", {{"exponent", 0.0}, {"diffuse_reflectance", pink}}, 1,
            gray * 2);
  maker.add("phong shiny", "phong",
            {{"exponent", 200.0}, {"specular_reflectance", 0.9}, {"diffuse_reflectance", 0.5}}, 1,
            gray);
  maker.add("twosided", "twosided", {}, 1, gray, true,
            {maker.made.back().bsdf, make_bsdf("roughconductor", {{"alpha", 0.3}})});
  maker.add("twosided plastic", "twosided", {}, 0, gray, true, {make_bsdf("plastic")});
  maker.add("roughdiffuse", "roughdiffuse", {{"reflectance", pink}, {"alpha", 0.7}}, 0, infinity);
  maker.add("roughdiffuse fast", "roughdiffuse",
            {{"reflectance", pink}, {"alpha", ramp_texture(0.2, 1)}, {"use_fast_approx", true}}, 0,
            infinity);
  maker.add("thindielectric", "thindielectric", {{"specular_transmittance", pink}}, 0, gray, true);
  maker.add("mask of phong", "mask", {{"opacity", ramp_texture(0.4, 0.8)}}, 1, gray, true,
            {find(maker, "phong")});
  maker.add("mask of dielectric", "mask", {{"opacity", pink}}, 0, gray, true,
            {find(maker, "dielectric")});
  maker.add("blend", "blendbsdf", {{"weight", ramp_texture(0, 0.6)}}, 1, gray, false,
            {find(maker, "phong"), find(maker, "plastic")});
  maker.add("blend of glass and twosided", "blendbsdf", {{"weight", 0.25}}, 1, gray, true,
            {find(maker, "dielectric"), find(maker, "twosided")});
  maker.add("blend of pane and mask", "blendbsdf", {{"weight", ramp_texture(0.2, 0.6)}}, 1,
            infinity, true, {find(maker, "thindielectric"), find(maker, "mask of phong")});
  maker.add("mixture", "mixturebsdf", {{"weights", "0.3, 0.5 0.1"s}}, 1, gray / 0.9, false,
            {find(maker, "phong"), find(maker, "plastic"), find(maker, "diffuse")});
  for (const char* variant : {"ward", "ward-duer", "balanced"})
    maker.add(
        "ward "s + variant, "ward",
        {{"variant", std::string(variant)}, {"alpha_u", 0.2}, {"alpha_v", ramp_texture(0.3, 0.5)}},
        1, infinity);
  maker.add("coating", "coating", {{"sigma_a", pink}, {"thickness", 0.4}}, 1, infinity, true,
            {make_bsdf("roughconductor", {{"alpha", 0.3}})});
  maker.add("coating of conductor", "coating", {}, 0, gray, true, {find(maker, "conductor")});
  maker.add("coating of twosided", "coating", {{"int_ior", 1.2}}, 1, infinity, true,
            {find(maker, "twosided")});
  maker.add("coating of dielectric", "coating", {{"int_ior", 1.3}}, 1, gray, true,
            {find(maker, "dielectric")});
  maker.add("coating of roughdielectric", "coating", {{"sigma_a", 0.1}}, 1, infinity, true,
            {make_bsdf("roughdielectric", {{"alpha", 0.3}})});
  maker.add("difftrans", "difftrans", {{"transmittance", pink}}, 0, 1, true);
  maker.add("hk", "hk", {{"sigma_s", pink}, {"sigma_a", 0.2}, {"thickness", 0.7}}, 0, infinity,
            true);
  for (const char* distribution : {"beckmann", "ggx"}) {
    const Given rough = {{"distribution", std::string(distribution)}, {"alpha", 0.3}};
    const std::string label = "roughcoating "s + distribution;
    maker.add(label + " of twosided", "roughcoating", rough, 1, infinity, true,
              {find(maker, "twosided")});
    maker.add(label + " of conductor", "roughcoating", rough, 1, infinity, true,
              {find(maker, "conductor")});
    maker.add(label + " of difftrans", "roughcoating", rough, 1, infinity, true,
              {find(maker, "difftrans")});
  }
  add_bent(maker);
  add_principled(maker);
  add_openpbr(maker);
  add_rough(maker, "beckmann");
  add_rough(maker, "ggx");
  return maker.made;
}

}  // namespace

const Schema& bsdf_schema(const std::string& name) { return plugin(name).schema; }

BsdfPtr make_bsdf(const std::string& name, const Given& given, const std::vector<BsdfPtr>& nested) {
  const Plugin& p = plugin(name);
  const Location where{"test.xml", 7};
  Params params(p.schema, where);
  for (const auto& [key, value] : given) params.set(key, value, where);
  for (const BsdfPtr& bsdf : nested) params.add("bsdf", std::const_pointer_cast<Bsdf>(bsdf), where);
  BsdfPtr made = std::dynamic_pointer_cast<const Bsdf>(p.create(params));
  params.expect_all_read();
  return made;
}

ObjectPtr ramp_texture(double low, double high) { return std::make_shared<Ramp>(low, high); }

const std::vector<Case>& cases() {
  static const std::vector<Case> all = make_cases();
  return all;
}

const Case& find_case(const std::string& label) {
  for (const Case& c : cases())
    if (c.label == label) return c;
  throw std::logic_error("no case '" + label + "'");
}

SurfacePoint point() {
  SurfacePoint at;
  at.ng = {0, 0, 1};
  at.shading = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  at.uv = {0.5, 0.5};
  return at;
}

std::vector<Vec3> incident_directions(const Case& test_case) {
  std::vector<Vec3> directions = {normalize(Vec3(0.01, 0.02, 1)), normalize(Vec3(-0.5, 0.6, 0.7)),
                                  normalize(Vec3(0.9, 0.3, 0.1))};
  if (test_case.two_sided)
    for (size_t i = 0; i < 3; ++i) directions.push_back(-directions[i]);
  return directions;
}

Vec3 random_direction(Rng& rng) {
  const double z = 2 * rng.next() - 1, phi = 2 * pi * rng.next();
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Vec3 random_u(Rng& rng) {
  const double x = rng.next(), y = rng.next();
  return {x, y, rng.next()};
}

Spectrum weight_from_light(const Bsdf& bsdf, const Vec3& wl, const BsdfSample& s) {
  const Scattering scattering = bsdf.scattering(point(), wl, s.to, s.lobe);
  const double cosine = s.lobe == Lobe::smooth ? std::abs(s.to.z) : 1;
  return scattering.f * (cosine / scattering.pdf_from_light);
}

}  // namespace test
}  // namespace mlt
