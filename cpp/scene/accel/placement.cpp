#include "scene/accel/placement.h"

#include "scene/accel/instance.h"

#include <algorithm>
#include <map>

namespace mlt {
namespace {

PlacedForm form_of(const ShapePtr& shape) {
  const BsdfPtr& bsdf = shape->bsdf_ptr();
  return {shape->form() ? shape->form() : shape, bsdf && bsdf->has_passage()};
}

std::vector<PlacedForm> forms_of(const std::vector<ShapePtr>& shapes) {
  std::vector<PlacedForm> forms;
  for (const ShapePtr& shape : shapes) forms.push_back(form_of(shape));
  return forms;
}

}  // namespace

Placements::Placements(const std::vector<ShapePtr>& shapes) {
  std::map<const ShapeGroup*, size_t> met;
  for (const ShapePtr& shape : shapes) {
    const Instance* instance = shape->as_instance();
    if (!instance) {
      all.push_back({form_of(shape), 0, {}});
      continue;
    }
    const auto [group, is_new] = met.emplace(&instance->group(), groups.size());
    if (is_new) groups.push_back(forms_of(instance->group().shapes()));
    all.push_back({{}, group->second, instance->motion().steps()});
  }
}

bool Placements::moves() const {
  return std::any_of(all.begin(), all.end(),
                     [](const Placement& placement) { return placement.steps.size() > 1; });
}

}  // namespace mlt
