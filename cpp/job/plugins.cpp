// The list of plug-ins: one include for each family's list, and the names of Mitsuba's that are
// refused.
#include "job/plugins.h"

namespace mlt {

/// MLT_PLUGIN(family, name) declares the function that describes the plug-in, and calls it. (Not in
/// the unnamed namespace below: it would be taken to define those functions.)
static void add_all(Registry& registry) {
#define MLT_PLUGIN(family, name)     \
  {                                  \
    extern Plugin family##_##name(); \
    registry.add(family##_##name()); \
  }
#include "integrator/list.inc"
#include "scene/bsdf/list.inc"
#include "scene/camera/list.inc"
#include "scene/emitter/list.inc"
#include "scene/film/list.inc"
#include "scene/medium/list.inc"
#include "scene/phase/list.inc"
#include "scene/shape/list.inc"
#include "scene/texture/list.inc"
#include "scene/volume/list.inc"
#undef MLT_PLUGIN
}

namespace {

struct Refusal {
  const char* family;
  const char* reason;
  std::vector<const char*> names;
};

/// The plug-ins of Mitsuba 0.6 and 3 that do not exist here.
const std::vector<Refusal>& refusals() {
  static const char* not_yet = "not implemented yet";
  static const char* polarised = "polarised rendering is not supported";
  static const char* curves = "hair and curves are not supported";
  static const std::vector<Refusal> table{
      {"shape", not_yet, {"animatedinstance", "heightfield", "deformable"}},
      {"shape", curves, {"hair", "bsplinecurve", "linearcurve"}},
      {"shape",
       "volumetric primitives are not supported",
       {"sdfgrid", "ellipsoids", "ellipsoidsmesh", "volume"}},
      {"shape", "write the shapes directly into the scene", {"merge"}},
      {"bsdf", polarised, {"pplastic", "polarizer", "retarder", "circular", "measured_polarized"}},
      {"bsdf", "layered and measured materials are not supported", {"measured", "irawan", "hapke"}},
      {"bsdf", "subsurface scattering is not supported", {"sss", "dipole"}},
      {"bsdf", curves, {"hair"}},
      {"emitter", not_yet, {"timed_sunsky"}},
      {"emitter",
       "a beam has a width here: put a directionalarea emitter into a small disk",
       {"collimated"}},
      {"sensor", not_yet, {"telecentric", "perspective_rdist"}},
      {"sensor",
       "sensors in volumes are not supported; irradiancemeter measures on a shape",
       {"fluencemeter"}},
      {"sensor", "put it at the top of the scene, with other sensors inside", {"batch"}},
      {"film", "images are held in memory; use hdrfilm", {"tiledhdrfilm"}},
      {"film", "the command line writes images; use hdrfilm", {"mfilm"}},
      {"film", "spectral rendering is not supported; use hdrfilm", {"specfilm"}},
      {"texture", not_yet, {"gridtexture", "wireframe", "curvature", "vertexcolors"}},
      {"texture", "textures of volumes are not supported", {"volume"}},
      {"phase", not_yet, {"sggx", "tabphase", "kkay", "microflake"}},
      {"integrator", not_yet, {"ao", "field", "moment"}},
      {"integrator",
       "photon mapping and virtual point lights are not supported (they are biased)",
       {"photonmapper", "ppm", "sppm", "vpl", "irrcache"}},
      {"integrator", polarised, {"stokes"}},
      {"integrator",
       "differentiable rendering is not supported",
       {"prb", "prb_basic", "prb_projective", "prbvolpath", "direct_projective", "emission_reparam",
        "volprim_rf_basic"}},
      {"integrator", "set a time or an error budget instead", {"adaptive"}},
      {"integrator", "render the images one by one", {"multichannel", "motion"}}};
  return table;
}

Registry make_registry() {
  Registry registry;
  add_all(registry);
  for (const char* name : {"volpath", "volpath_simple", "volpathmis"})
    registry.alias("integrator", name, "path");
  for (const Refusal& refusal : refusals())
    for (const char* name : refusal.names) registry.refuse(refusal.family, name, refusal.reason);
  return registry;
}

}  // namespace

const Registry& plugins() {
  static const Registry registry = make_registry();
  return registry;
}

}  // namespace mlt
