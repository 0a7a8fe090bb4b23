// Ear clipping (Meisters 1975, "Polygons have ears"; Eberly 2008, "Triangulation by ear clipping"):
// an ear is a convex corner whose triangle, with its two neighbours, holds no other corner. Only
// reflex corners can lie in it, and cutting it off changes its neighbours alone. Here the reflex
// corners are sorted along the polygon's longer side, and those beside the triangle are not looked
// at. A polygon of 100,000 corners takes seconds, at worst ten.
#include "scene/shape/polygons.h"

#include <algorithm>
#include <deque>

namespace mlt {
namespace {

/// A polygon of more keeps its fan: the time grows with the square of their number.
constexpr size_t most_corners = 1u << 18;

class EarClipper {
  struct Reflex {
    Vec2 point;
    uint32_t corner;
  };

 public:
  explicit EarClipper(MeshData& mesh) : mesh_(mesh) {}

  /// Takes the polygon of a fan; false if it has too many corners, or one that does not exist.
  bool take(const Fan& fan) {
    if (fan.triangles > most_corners) return false;
    to_ = &mesh_.triangles[fan.first];
    corners_ = {to_[0][0], to_[0][1]};
    for (size_t i = 0; i < fan.triangles; ++i) corners_.push_back(to_[i][2]);
    const uint32_t most = *std::max_element(corners_.begin(), corners_.end());
    if (most >= mesh_.positions.size()) return false;
    project();
    return true;
  }

  /// Whether no triangle of the fan is turned around, by more than rounding.
  bool fan_is_right() const {
    double area = 0, least = 0;
    for (size_t i = 2; i < corners_.size(); ++i) {
      const double part = turn(0, i - 1, i);
      area += part;
      least = std::min(least, part);
    }
    return !(area > 0 && least < -1e-6 * area);
  }

  void run() {
    link();
    for (const bool strict : {true, false}) {
      std::deque<uint32_t> left;
      for (uint32_t i = next_[last_]; left.size() < count_; i = next_[i]) left.push_back(i);
      while (!left.empty() && count_ > 2) {
        const uint32_t i = left.front(), after = next_[i];
        left.pop_front();
        if (is_cut(i) || !is_ear(i, strict)) continue;
        left.push_back(previous_[i]);
        left.push_back(after);
        // Its turn comes later: triangles that do not all have one corner are rounder.
        if (left.front() == after) left.pop_front();
        cut(i);
      }
    }
    while (count_ > 2) cut(next_[last_]);
  }

 private:
  Vec3 position(size_t corner) const { return Vec3(mesh_.positions[corners_[corner]]); }

  /// Projects the corners along the axis nearest to Newell's normal, which rounds nothing.
  void project() {
    Vec3 normal(0);
    const Vec3 origin = position(0);
    for (size_t i = 2; i < corners_.size(); ++i)
      normal += cross(position(i - 1) - origin, position(i) - origin);
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (std::fabs(normal[k]) > std::fabs(normal[axis])) axis = k;
    const int s = (axis + 1) % 3, t = (axis + 2) % 3;
    points_.clear();
    for (size_t i = 0; i < corners_.size(); ++i) {
      const Vec3 p = position(i);
      points_.push_back(normal[axis] < 0 ? Vec2(p[t], p[s]) : Vec2(p[s], p[t]));
    }
  }

  /// Twice the area of a triangle, positive if it turns as the polygon does.
  static double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 u = b - a, v = c - a;
    return u.x * v.y - u.y * v.x;
  }
  double turn(size_t a, size_t b, size_t c) const {
    return twice_area(points_[a], points_[b], points_[c]);
  }

  void link() {
    const auto n = static_cast<uint32_t>(corners_.size());
    count_ = n;
    last_ = n - 1;
    previous_.clear();
    next_.clear();
    reflex_.clear();
    Vec2 low = points_[0], high = points_[0];
    for (uint32_t i = 0; i < n; ++i) {
      previous_.push_back((i + n - 1) % n);
      next_.push_back((i + 1) % n);
      low = glm::min(low, points_[i]);
      high = glm::max(high, points_[i]);
    }
    tidy_at_ = n / 2;
    side_ = high.x - low.x < high.y - low.y;
    for (uint32_t i = 0; i < n; ++i)
      if (is_reflex(i)) reflex_.push_back({points_[i], i});
    std::sort(reflex_.begin(), reflex_.end(),
              [&](const Reflex& a, const Reflex& b) { return a.point[side_] < b.point[side_]; });
  }

  bool is_cut(uint32_t i) const { return next_[i] == i; }
  bool is_reflex(uint32_t i) const { return !(turn(previous_[i], i, next_[i]) > 0); }

  /// Without `strict` also a corner on a line with its neighbours, or one whose triangle has others
  /// on its edges.
  bool is_ear(uint32_t b, bool strict) const {
    const uint32_t a = previous_[b], c = next_[b];
    const double area = turn(a, b, c);
    if (!(area > 0)) return !strict && area == 0;
    const Vec2 &p = points_[a], &q = points_[b], &r = points_[c];
    const Vec2 low = glm::min(glm::min(p, q), r), high = glm::max(glm::max(p, q), r);
    auto at = std::lower_bound(
        reflex_.begin(), reflex_.end(), low[side_],
        [&](const Reflex& corner, double value) { return corner.point[side_] < value; });
    for (; at != reflex_.end() && at->point[side_] <= high[side_]; ++at) {
      const Vec2& x = at->point;
      if (x[1 - side_] < low[1 - side_] || x[1 - side_] > high[1 - side_]) continue;
      const double least =
          std::min({twice_area(p, q, x), twice_area(q, r, x), twice_area(r, p, x)});
      if ((strict ? least >= 0 : least > 0) && x != p && x != q && x != r && !is_cut(at->corner) &&
          is_reflex(at->corner))
        return false;
    }
    return true;
  }

  void cut(uint32_t i) {
    const uint32_t a = previous_[i], c = next_[i];
    *to_++ = {corners_[a], corners_[i], corners_[c]};
    next_[a] = c;
    previous_[c] = a;
    next_[i] = i;
    if (i == last_) last_ = a;
    if (--count_ == tidy_at_) tidy();
  }

  /// Forgets corners that are no longer reflex; half of all corners are left each time.
  void tidy() {
    tidy_at_ = count_ / 2;
    reflex_.erase(
        std::remove_if(reflex_.begin(), reflex_.end(),
                       [&](const Reflex& r) { return is_cut(r.corner) || !is_reflex(r.corner); }),
        reflex_.end());
  }

  MeshData& mesh_;
  std::array<uint32_t, 3>* to_ = nullptr;  ///< Where the next triangle goes.
  std::vector<uint32_t> corners_;          ///< Vertices of the mesh.
  std::vector<Vec2> points_;
  std::vector<uint32_t> previous_, next_;
  uint32_t count_ = 0, last_ = 0;  ///< How many corners are left, and one of them.
  int side_ = 0;                   ///< The axis that reflex corners are sorted along.
  std::vector<Reflex> reflex_;     ///< And those on a line with their neighbours.
  uint32_t tidy_at_ = 0;
};

}  // namespace

void triangulate(MeshData& mesh, const std::vector<Fan>& fans) {
  EarClipper clipper(mesh);
  for (const Fan& fan : fans)
    if (clipper.take(fan) && !clipper.fan_is_right()) clipper.run();
}

void warn_of_short_faces(MeshData& mesh, size_t count) {
  if (count > 0)
    mesh.warnings.push_back(
        fmt::format("{} left out: fewer than three corners",
                    count == 1 ? "a face is" : fmt::format("{} faces are", count)));
}

}  // namespace mlt
