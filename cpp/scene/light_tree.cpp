#include "scene/light_tree.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mlt {
namespace {

/// Deeper nodes are halved by number, so that a way down fits into 64 bits.
constexpr int deepest_by_cost = 32;
constexpr int buckets = 12;

double sin_of(double cosine) { return std::sqrt(std::max(0.0, 1 - cosine * cosine)); }

/// The smallest cone that contains both, each given by its axis and the cosine of its half angle.
void enclose(Vec3& axis, double& cosine, const Vec3& other, double other_cosine) {
  const double between = std::acos(std::clamp(dot(axis, other), -1.0, 1.0));
  const double a = std::acos(cosine), b = std::acos(other_cosine);
  if (between + b <= a) return;
  if (between + a <= b) {
    axis = other;
    cosine = other_cosine;
    return;
  }
  const double angle = (a + b + between) / 2;
  const Vec3 away = other - dot(axis, other) * axis;
  if (angle >= pi || !(length(away) > 1e-9)) {
    cosine = -1;
    return;
  }
  const double turn = angle - a;
  axis = normalize(std::cos(turn) * axis + std::sin(turn) * normalize(away));
  cosine = std::cos(std::min(pi, angle + 1e-9));
}

LightBounds together(const LightBounds& a, const LightBounds& b) {
  if (a.power == 0) return b;
  if (b.power == 0) return a;
  LightBounds both = a;
  both.low = glm::min(a.low, b.low);
  both.high = glm::max(a.high, b.high);
  enclose(both.axis, both.cos_normals, b.axis, b.cos_normals);
  both.cos_emission = std::min(a.cos_emission, b.cos_emission);
  both.power = a.power + b.power;
  return both;
}

Vec3 centre(const LightBounds& bounds) { return 0.5 * (bounds.low + bounds.high); }

/// Conty Estevez & Kulla 2018, eq. 1, with the solid angle of their sec. 4.1: what a node costs, up
/// to a factor.
double cost(const LightBounds& bounds) {
  if (bounds.power == 0) return 0;
  const double normals = std::acos(bounds.cos_normals);
  const double all = std::min(normals + std::acos(bounds.cos_emission), pi);
  const double solid_angle = 2 * pi * (1 - bounds.cos_normals) +
                             pi / 2 *
                                 (2 * all * std::sin(normals) - std::cos(normals - 2 * all) -
                                  2 * normals * std::sin(normals) + bounds.cos_normals);
  const Vec3 d = bounds.high - bounds.low;
  return bounds.power * solid_angle * (d.x * d.y + d.y * d.z + d.z * d.x);
}

using Place = std::vector<uint32_t>::iterator;

/// The place between two buckets along one axis where the children cost least; `last` if all are in
/// one bucket.
Place split_by_cost(const std::vector<LightBounds>& lights, Place first, Place last,
                    const Vec3& low, const Vec3& high) {
  int best_axis = -1, best_bucket = 0;
  double least = infinity;
  const auto bucket_of = [&](uint32_t light, int axis) {
    const double x = (centre(lights[light])[axis] - low[axis]) / (high[axis] - low[axis]);
    return std::clamp(static_cast<int>(x * buckets), 0, buckets - 1);
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (!(high[axis] > low[axis])) continue;
    LightBounds in_bucket[buckets], above[buckets];
    for (Place i = first; i != last; ++i) {
      LightBounds& bucket = in_bucket[bucket_of(*i, axis)];
      bucket = together(bucket, lights[*i]);
    }
    for (int b = buckets - 2; b >= 0; --b) above[b] = together(above[b + 1], in_bucket[b + 1]);
    LightBounds below;
    for (int b = 0; b < buckets - 1; ++b) {
      below = together(below, in_bucket[b]);
      const double both = cost(below) + cost(above[b]);
      if (below.power > 0 && above[b].power > 0 && both < least) {
        least = both;
        best_axis = axis;
        best_bucket = b;
      }
    }
  }
  if (best_axis < 0) return last;
  return std::partition(first, last,
                        [&](uint32_t light) { return bucket_of(light, best_axis) <= best_bucket; });
}

/// Halves lights along the longest side of the box of their centres.
Place split_by_number(const std::vector<LightBounds>& lights, Place first, Place last,
                      const Vec3& low, const Vec3& high) {
  const Vec3 d = high - low;
  const int axis = d.x > d.y && d.x > d.z ? 0 : d.y > d.z ? 1 : 2;
  const Place middle = first + (last - first) / 2;
  std::nth_element(first, middle, last, [&](uint32_t a, uint32_t b) {
    return centre(lights[a])[axis] < centre(lights[b])[axis];
  });
  return middle;
}

}  // namespace

LightTree::Node::Node(const LightBounds& bounds)
    : centre(mlt::centre(bounds)),
      axis(bounds.axis),
      radius2(0.25 * length_squared(bounds.high - bounds.low)),
      cos_normals(bounds.cos_normals),
      sin_normals(sin_of(bounds.cos_normals)),
      cos_emission(bounds.cos_emission),
      power(bounds.power) {}

double LightTree::Node::importance(const Vec3& p) const {
  const Vec3 between = p - centre;
  const double distance2 = length_squared(between);
  if (distance2 <= radius2) return power / std::max(radius2, 1e-100);
  const double most = power / distance2;
  if (cos_emission <= -1) return most;
  const double cosine = dot(axis, between) / std::sqrt(distance2);
  if (cosine >= cos_normals) return most;
  const double sine = sin_of(cosine);
  // The angle beyond the cone of the normals, less that of the box as p sees it: the least angle
  // between p and a normal, as seen from a light.
  const double beyond = cosine * cos_normals + sine * sin_normals;
  const double sin2_box = radius2 / distance2, cos_box = std::sqrt(1 - sin2_box);
  if (beyond >= cos_box) return most;
  const double least =
      beyond * cos_box + (sine * cos_normals - cosine * sin_normals) * std::sqrt(sin2_box);
  return least > cos_emission ? most * least : 0;
}

LightTree::LightTree(const std::vector<LightBounds>& lights)
    : turns_(lights.size()), has_(lights.size()) {
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < lights.size(); ++i)
    if (lights[i].power > 0) order.push_back(i);
  if (order.empty()) throw UsageError("no light has any power");
  nodes_.reserve(2 * order.size() - 1);
  build(lights, order.begin(), order.end(), 0, 0);
}

uint32_t LightTree::build(const std::vector<LightBounds>& lights, Place first, Place last,
                          uint64_t turns, int depth) {
  LightBounds all;
  Vec3 low(infinity), high(-infinity);
  for (Place i = first; i != last; ++i) {
    all = together(all, lights[*i]);
    low = glm::min(low, centre(lights[*i]));
    high = glm::max(high, centre(lights[*i]));
  }
  const auto index = static_cast<uint32_t>(nodes_.size());
  nodes_.emplace_back(all);
  if (last - first == 1) {
    nodes_[index].light = *first;
    turns_[*first] = turns;
    has_[*first] = true;
    return index;
  }
  Place middle = depth < deepest_by_cost ? split_by_cost(lights, first, last, low, high) : last;
  if (middle == last) middle = split_by_number(lights, first, last, low, high);
  build(lights, first, middle, turns, depth + 1);
  const uint32_t second = build(lights, middle, last, turns | (uint64_t{1} << depth), depth + 1);
  nodes_[index].second = second;
  return index;
}

double LightTree::first_share(const Node& node, const Vec3& p) const {
  const double first = (&node + 1)->importance(p);
  return first / (first + nodes_[node.second].importance(p));
}

LightTree::Choice LightTree::sample(const Vec3& p, double u) const {
  const Node* node = &nodes_[0];
  double probability = 1;
  while (node->second) {
    const double share = first_share(*node, p);
    if (!(share >= 0)) return {0, 0, u};
    const bool second = !(u < share);
    const double own = second ? 1 - share : share;
    u = std::min((second ? u - share : u) / own, 1 - 0x1p-53);
    probability *= own;
    node = second ? &nodes_[node->second] : node + 1;
  }
  return {node->light, probability, u};
}

template <class Visit>
void LightTree::descend(uint32_t light, const Vec3& p, Visit&& visit) const {
  const Node* node = &nodes_[0];
  for (uint64_t turns = turns_[light]; node->second; turns >>= 1) {
    const bool second = turns & 1;
    visit(second, first_share(*node, p));
    node = second ? &nodes_[node->second] : node + 1;
  }
}

double LightTree::probability(uint32_t light, const Vec3& p) const {
  if (!has_[light]) return 0;
  double probability = 1;
  descend(light, p, [&](bool second, double share) { probability *= second ? 1 - share : share; });
  return probability >= 0 ? probability : 0;
}

double LightTree::invert(uint32_t light, const Vec3& p, double remainder) const {
  double low = 0, width = 1;
  descend(light, p, [&](bool second, double share) {
    if (second) low += width * share;
    width *= second ? 1 - share : share;
  });
  return low + remainder * width;
}

}  // namespace mlt
