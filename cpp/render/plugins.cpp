// Which plug-ins there are: one include for each family's list, and the names of Mitsuba's that are
// refused.
#include "render/plugins.h"

namespace mlt {

// Each list is read twice: to declare the functions that describe the plug-ins, and to call them.
#define MLT_PLUGIN(name) Plugin bsdf_##name();
#include "scene/bsdf/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) Plugin emitter_##name();
#include "scene/emitter/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) Plugin name();
#include "scene/film/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) Plugin name();
#include "scene/film/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) Plugin integrator_##name();
#include "integrator/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) Plugin sensor_##name();
#include "scene/camera/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) Plugin shape_##name();
#include "scene/shape/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) Plugin texture_##name();
#include "scene/texture/list.inc"
#undef MLT_PLUGIN

namespace {

void add_all(Registry& registry) {
#define MLT_PLUGIN(name) registry.add(bsdf_##name());
#include "scene/bsdf/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) registry.add(emitter_##name());
#include "scene/emitter/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) registry.add(name());
#include "scene/film/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) registry.add(name());
#include "scene/film/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) registry.add(integrator_##name());
#include "integrator/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) registry.add(sensor_##name());
#include "scene/camera/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) registry.add(shape_##name());
#include "scene/shape/list.inc"
#undef MLT_PLUGIN
#define MLT_PLUGIN(name) registry.add(texture_##name());
#include "scene/texture/list.inc"
#undef MLT_PLUGIN
}

struct Refusal {
  const char* family;
  const char* reason;
  std::vector<const char*> names;
};

/// The plug-ins of Mitsuba 0.6 and 3. One that exists here after all is found before its refusal.
const std::vector<Refusal>& refusals() {
  static const char* not_yet = "not implemented yet";
  static const char* media = "participating media are not supported";
  static const char* polarised = "polarised rendering is not supported";
  static const char* curves = "hair and curves are not supported";
  static const char* differentiable = "differentiable rendering is not supported";
  static const char* layered = "layered and measured materials are not supported";
  static const std::vector<Refusal> table{
      {"shape",
       not_yet,
       {"instance", "shapegroup", "animatedinstance", "heightfield", "deformable"}},
      {"shape", curves, {"hair", "bsplinecurve", "linearcurve"}},
      {"shape",
       "volumetric primitives are not supported",
       {"sdfgrid", "ellipsoids", "ellipsoidsmesh", "volume"}},
      {"shape", "write the shapes directly into the scene", {"merge"}},
      {"bsdf",
       not_yet,
       {"mask", "bumpmap", "normalmap", "blendbsdf", "mixturebsdf", "principled", "principledthin",
        "thindielectric", "roughdiffuse", "ward", "difftrans"}},
      {"bsdf", polarised, {"pplastic", "polarizer", "retarder", "circular", "measured_polarized"}},
      {"bsdf", layered, {"measured", "coating", "roughcoating", "irawan", "hapke"}},
      {"bsdf", "subsurface scattering is not supported", {"hk", "sss", "dipole"}},
      {"bsdf", curves, {"hair"}},
      {"emitter",
       not_yet,
       {"spot", "projector", "directionalarea", "sunsky", "timed_sunsky", "sun", "sky",
        "collimated"}},
      {"sensor", not_yet, {"orthographic", "telecentric", "spherical", "perspective_rdist"}},
      {"sensor",
       "sensors that measure a single value are not supported",
       {"irradiancemeter", "radiancemeter", "fluencemeter", "distant"}},
      {"sensor", "render the views one by one", {"batch"}},
      {"film", "images are held in memory; use hdrfilm", {"tiledhdrfilm"}},
      {"film", "the command line writes images; use hdrfilm", {"mfilm"}},
      {"film", "spectral rendering is not supported; use hdrfilm", {"specfilm"}},
      {"texture",
       not_yet,
       {"gridtexture", "scale", "wireframe", "curvature", "vertexcolors", "mesh_attribute"}},
      {"texture", media, {"volume"}},
      {"medium", media, {"homogeneous", "heterogeneous"}},
      {"phase",
       media,
       {"hg", "isotropic", "rayleigh", "sggx", "tabphase", "blendphase", "kkay", "microflake"}},
      {"volume", media, {"constvolume", "gridvolume"}},
      {"spectrum",
       "give rgb or wavelength:value pairs",
       {"blackbody", "d65", "uniform", "regular", "irregular", "rawconstant"}},
      {"integrator",
       not_yet,
       {"ptracer", "bdpt", "mlt", "mmlt", "erpt", "ao", "depth", "field", "aov", "moment"}},
      {"integrator", media, {"volpath", "volpath_simple", "volpathmis"}},
      {"integrator",
       "photon mapping and virtual point lights are not supported (they are biased)",
       {"photonmapper", "ppm", "sppm", "vpl", "irrcache"}},
      {"integrator", polarised, {"stokes"}},
      {"integrator",
       differentiable,
       {"prb", "prb_basic", "prb_projective", "prbvolpath", "direct_projective", "emission_reparam",
        "volprim_rf_basic"}},
      {"integrator", "set a time or an error budget instead", {"adaptive"}},
      {"integrator", "render the images one by one", {"multichannel", "motion"}}};
  return table;
}

Registry make_registry() {
  Registry registry;
  add_all(registry);
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
