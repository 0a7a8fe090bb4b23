#include "io/material_parts.h"

namespace mlt {

MediumPtr medium_inside(const Bsdf& bsdf, const Registry& registry, const Location& where) {
  const auto triple = [](const Color& c) { return Triple{c.x, c.y, c.z}; };
  const SolidInside& inside = *bsdf.inside();
  const Plugin &hg = registry.find("phase", "hg", where),
               &homogeneous = registry.find("medium", "homogeneous", where);
  Params phase(hg.schema, where), medium(homogeneous.schema, where);
  phase.set("g", inside.g, where);
  medium.set("sigma_s", triple(inside.scattering), where);
  medium.set("sigma_a", triple(inside.absorption), where);
  medium.add("phase", make_object(hg, phase), where);
  return std::dynamic_pointer_cast<const Medium>(make_object(homogeneous, medium));
}

EmitterPtr light_of(const Bsdf& bsdf, const Registry& registry, const Location& where) {
  const Plugin& area = registry.find("emitter", "area", where);
  Params params(area.schema, where);
  params.set("radiance", bsdf.glow(), where);
  return std::dynamic_pointer_cast<Emitter>(make_object(area, params));
}

}  // namespace mlt
