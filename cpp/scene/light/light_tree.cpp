#include "scene/light/light_tree.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace mlt {
namespace {

/// Deeper nodes are halved by number, which bounds the depth of the tree.
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

using Iterator = std::vector<uint32_t>::iterator;

/// Some of the lights, by their indices.
struct Range {
  Iterator first, last;
  Iterator begin() const { return first; }
  Iterator end() const { return last; }
};

/// The place between two buckets along one axis where the children cost least; the end if all are
/// in one bucket.
Iterator split_by_cost(const std::vector<LightBounds>& lights, const Range& range, const Vec3& low,
                       const Vec3& high) {
  int best_axis = -1, best_bucket = 0;
  double least = infinity;
  const auto bucket_of = [&](uint32_t light, int axis) {
    const double x = (centre(lights[light])[axis] - low[axis]) / (high[axis] - low[axis]);
    return std::clamp(static_cast<int>(x * buckets), 0, buckets - 1);
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (!(high[axis] > low[axis])) continue;
    LightBounds in_bucket[buckets], above[buckets];
    for (const uint32_t i : range) {
      LightBounds& bucket = in_bucket[bucket_of(i, axis)];
      bucket = together(bucket, lights[i]);
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
  if (best_axis < 0) return range.last;
  return std::partition(range.first, range.last,
                        [&](uint32_t light) { return bucket_of(light, best_axis) <= best_bucket; });
}

/// Halves lights along the longest side of the box of their centres.
Iterator split_by_number(const std::vector<LightBounds>& lights, const Range& range,
                         const Vec3& low, const Vec3& high) {
  const Vec3 d = high - low;
  const int axis = d.x > d.y && d.x > d.z ? 0 : d.y > d.z ? 1 : 2;
  const Iterator middle = range.first + (range.last - range.first) / 2;
  std::nth_element(range.first, middle, range.last, [&](uint32_t a, uint32_t b) {
    return centre(lights[a])[axis] < centre(lights[b])[axis];
  });
  return middle;
}

}  // namespace

/// A node of the tree while it is built, with two children or, as a leaf, a light.
struct LightTree::Binary {
  LightBounds bounds;
  uint32_t first = 0, second = 0;  ///< Indices of the children; 0: a leaf.
  uint32_t light = 0;

  static uint32_t build(const std::vector<LightBounds>& lights, Range range, int depth,
                        std::vector<Binary>& nodes);
};

uint32_t LightTree::Binary::build(const std::vector<LightBounds>& lights, Range range, int depth,
                                  std::vector<Binary>& nodes) {
  const auto index = static_cast<uint32_t>(nodes.size());
  nodes.emplace_back();
  LightBounds all;
  Vec3 low(infinity), high(-infinity);
  for (const uint32_t i : range) {
    all = together(all, lights[i]);
    low = glm::min(low, centre(lights[i]));
    high = glm::max(high, centre(lights[i]));
  }
  nodes[index].bounds = all;
  nodes[index].light = *range.first;
  if (range.last - range.first == 1) return index;
  Iterator middle = depth < deepest_by_cost ? split_by_cost(lights, range, low, high) : range.last;
  if (middle == range.last) middle = split_by_number(lights, range, low, high);
  const uint32_t first = build(lights, {range.first, middle}, depth + 1, nodes);
  const uint32_t second = build(lights, {middle, range.last}, depth + 1, nodes);
  nodes[index].first = first;
  nodes[index].second = second;
  return index;
}

LightTree::LightTree(const std::vector<LightBounds>& lights) : places_(lights.size()) {
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < lights.size(); ++i)
    if (lights[i].power > 0) order.push_back(i);
  if (order.empty()) throw UsageError("no light has any power");
  std::vector<Binary> binary;
  Binary::build(lights, {order.begin(), order.end()}, 0, binary);
  flatten(binary, 0, {});
}

/// Makes one node of a node of the binary tree and of those below it, the most important ones
/// first, until it has as many children as fit.
uint32_t LightTree::flatten(const std::vector<Binary>& binary, uint32_t root, const Place& above) {
  std::vector<uint32_t> children{root};
  const auto worth = [&](uint32_t i) { return binary[i].first ? cost(binary[i].bounds) : -1; };
  while (children.size() < width) {
    const auto next = std::max_element(children.begin(), children.end(),
                                       [&](uint32_t a, uint32_t b) { return worth(a) < worth(b); });
    if (!binary[*next].first) break;
    const Binary& parent = binary[*next];
    *next = parent.first;
    children.push_back(parent.second);
  }
  const auto index = static_cast<uint32_t>(nodes_.size());
  nodes_.emplace_back();
  nodes_[index].above = above;
  for (int lane = 0; lane < static_cast<int>(children.size()); ++lane) {
    const Binary& child = binary[children[lane]];
    const bool is_light = !child.first;
    const Place here{index, lane};
    const uint32_t below = is_light ? child.light : flatten(binary, children[lane], here);
    if (is_light) places_[child.light] = here;
    nodes_[index].set(lane, child.bounds);
    nodes_[index].child[lane] = below;
    nodes_[index].is_light[lane] = is_light;
  }
  return index;
}

void LightTree::Node::set(int lane, const LightBounds& bounds) {
  const Vec3 middle = centre(bounds);
  x[lane] = static_cast<float>(middle.x);
  y[lane] = static_cast<float>(middle.y);
  z[lane] = static_cast<float>(middle.z);
  radius2[lane] = static_cast<float>(0.25 * length_squared(bounds.high - bounds.low));
  axis_x[lane] = static_cast<float>(bounds.axis.x);
  axis_y[lane] = static_cast<float>(bounds.axis.y);
  axis_z[lane] = static_cast<float>(bounds.axis.z);
  cos_normals[lane] = static_cast<float>(bounds.cos_normals);
  sin_normals[lane] = static_cast<float>(sin_of(bounds.cos_normals));
  cos_emission[lane] = static_cast<float>(bounds.cos_emission);
  power[lane] = static_cast<float>(bounds.power);
}

/// With the angle of p beyond the cone of the normals, less that of the box as p sees it: the least
/// angle between p and a normal, as seen from a light. In a loop without branches, which the
/// compiler vectorises.
void LightTree::Node::find_importances(const Vec3f& p, Importances& __restrict found) const {
  for (int i = 0; i < width; ++i) {
    const float dx = p.x - x[i], dy = p.y - y[i], dz = p.z - z[i];
    const float r2 = std::max(radius2[i], 1e-30f);
    const float distance2 = std::max(dx * dx + dy * dy + dz * dz, r2);
    const float cosine = (axis_x[i] * dx + axis_y[i] * dy + axis_z[i] * dz) / std::sqrt(distance2);
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    const float beyond = cosine * cos_normals[i] + sine * sin_normals[i];
    const float sin2_box = r2 / distance2, cos_box = std::sqrt(1 - sin2_box);
    const float less =
        beyond * cos_box + (sine * cos_normals[i] - cosine * sin_normals[i]) * std::sqrt(sin2_box);
    const bool facing = (cosine >= cos_normals[i]) | (beyond >= cos_box);
    const float least = facing ? 1.0f : less;
    const float all_round = cos_emission[i] <= -1 ? 1.0f : least;
    found[i] = all_round > cos_emission[i] ? power[i] / distance2 * all_round : 0.0f;
  }
}

LightTree::Choice LightTree::sample(const Vec3& p, double u) const {
  uint32_t index = 0;
  for (double probability = 1;;) {
    const Node& node = nodes_[index];
    Importances found;
    node.find_importances(Vec3f(p), found);
    double sums[width + 1] = {0};
    for (int i = 0; i < width; ++i) sums[i + 1] = sums[i] + double{found[i]};
    if (!(sums[width] > 0)) return {0, 0, u};
    const double at = u * sums[width];
    int lane = 0;
    for (int i = 1; i < width; ++i) lane += at >= sums[i];
    while (!(found[lane] > 0)) --lane;  // u was rounded past the last one
    u = std::clamp((at - sums[lane]) / found[lane], 0.0, 1 - 0x1p-53);
    probability *= found[lane] / sums[width];
    index = node.child[lane];
    if (node.is_light[lane]) return {index, probability, u};
  }
}

template <class Visit>
void LightTree::climb(uint32_t light, const Vec3& p, Visit&& visit) const {
  for (Place at = places_[light]; at.lane >= 0; at = nodes_[at.node].above) {
    Importances found;
    nodes_[at.node].find_importances(Vec3f(p), found);
    double below = 0, sum = 0;
    for (int i = 0; i < width; ++i) {
      below += i < at.lane ? double{found[i]} : 0;
      sum += double{found[i]};
    }
    visit(below / sum, found[at.lane] / sum);
  }
}

double LightTree::probability(uint32_t light, const Vec3& p) const {
  if (places_[light].lane < 0) return 0;
  double probability = 1;
  climb(light, p, [&](double, double share) { probability *= share; });
  return probability > 0 ? probability : 0;
}

double LightTree::invert(uint32_t light, const Vec3& p, double remainder) const {
  climb(light, p, [&](double below, double share) { remainder = below + remainder * share; });
  return remainder;
}

}  // namespace mlt
