#include "scene/light/light_choice.h"

#include "base/error.h"
#include "scene/mesh/mesh.h"

#include <algorithm>

namespace mlt {
namespace {

/// Up to this number of lights, not counting those at infinity, all points choose by power.
constexpr size_t few = 2;

/// The probabilities of lights, half uniform and half in proportion to power: a weak light may be
/// the only one in a room. The sampling weights are factors of them.
Discrete choose_by_power(const std::vector<EmitterPtr>& lights) {
  std::vector<double> weights;
  double total = 0;
  for (const EmitterPtr& light : lights) {
    weights.push_back(std::max(0.0, target_luminance(light->power())));
    total += weights.back();
  }
  bool any = false;
  for (size_t i = 0; i < weights.size(); ++i) {
    weights[i] = (total > 0 ? weights[i] / total : 0.0) + 1.0 / weights.size();
    weights[i] *= lights[i]->sampling_weight();
    any = any || weights[i] > 0;
  }
  if (!any) throw SceneError("the sampling_weight of every emitter is 0; make one positive");
  return Discrete(weights);
}

/// Sets the cone of the normals of a mesh, if there is a narrower one than all directions.
void bound_normals(const Mesh& mesh, LightBounds& bounds) {
  const auto count = static_cast<uint32_t>(mesh.data().triangles.size());
  Vec3 sum(0);
  for (uint32_t i = 0; i < count; ++i) {
    const auto normal = mesh.bright_side(i);
    if (!normal) return;
    sum += *normal;
  }
  if (!(length(sum) > 0)) return;
  bounds.axis = normalize(sum);
  double cosine = 1;
  for (uint32_t i = 0; i < count; ++i)
    cosine = std::min(cosine, dot(bounds.axis, *mesh.bright_side(i)));
  bounds.cos_normals = std::max(-1.0, cosine - 1e-6);
}

LightBounds bounds_of(const Emitter& light, double open, double close) {
  LightBounds bounds;
  if (light.delta_direction()) return bounds;  // next-event estimation does not find it
  bounds.power = std::max(0.0, target_luminance(light.power())) * light.sampling_weight();
  if (light.glowing()) {
    light.find_box(bounds.low, bounds.high);
    return bounds;
  }
  const auto middle = [&](double time) { return light.sample_position(Vec2(0.5), time).at.p; };
  const Vec3 first = middle(open), last = middle(close);
  if (light.shape() && first == last) {
    light.shape()->bounds(bounds.low, bounds.high);
    bounds.cos_emission = 0;
    if (const Mesh* mesh = light.shape()->as_mesh()) bound_normals(*mesh, bounds);
  } else {
    bounds.low = glm::min(first, last);
    bounds.high = glm::max(first, last);
  }
  return bounds;
}

}  // namespace

LightChoice::LightChoice(const std::vector<EmitterPtr>& lights, double open, double close)
    : by_power_(choose_by_power(lights)), part_of_(lights.size()) {
  std::vector<double> parts;
  std::vector<LightBounds> bounds(lights.size());
  double near = 0, power = 0;
  for (uint32_t i = 0; i < lights.size(); ++i) {
    if (lights[i]->infinite()) {
      infinite_.push_back(i);
      parts.push_back(by_power_.pdf(i));
    } else {
      bounds[i] = bounds_of(*lights[i], open, close);
      near += by_power_.pdf(i);
      power += bounds[i].power;
    }
  }
  if (lights.size() - infinite_.size() <= few || !(power > 0)) return;
  std::fill(part_of_.begin(), part_of_.end(), static_cast<uint32_t>(parts.size()));
  for (uint32_t k = 0; k < infinite_.size(); ++k) part_of_[infinite_[k]] = k;
  parts.push_back(near);
  parts_ = Discrete(parts);
  tree_ = LightTree(bounds);
}

LightIndex LightChoice::choose_in_tree(const Vec3& p, double& u) const {
  const auto [part, remainder] = parts_.sample_reuse(u);
  u = remainder;
  if (part < infinite_.size()) return {infinite_[part], parts_.pdf(part)};
  const LightTree::Choice choice = tree_.sample(p, u);
  u = choice.remainder;
  return {choice.light, parts_.pdf(part) * choice.probability};
}

double LightChoice::probability_for(uint32_t index, const Vec3& p) const {
  if (tree_.empty()) return by_power_.pdf(index);
  const uint32_t part = part_of_[index];
  return parts_.pdf(part) * (part < infinite_.size() ? 1 : tree_.probability(index, p));
}

double LightChoice::invert_for(uint32_t index, const Vec3& p, double v) const {
  if (tree_.empty()) return by_power_.invert(index, v);
  const uint32_t part = part_of_[index];
  return parts_.invert(part, part < infinite_.size() ? v : tree_.invert(index, p, v));
}

}  // namespace mlt
