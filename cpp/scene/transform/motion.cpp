#include "scene/transform/motion.h"

#include "scene/mesh/mesh_data.h"
#include "scene/texture/texture.h"
#include "scene/transform/matrix_rows.h"
#include "scene/transform/transform_params.h"

#include <glm/gtc/quaternion.hpp>

namespace mlt {
namespace {

constexpr int most_steps = 128;
constexpr double tolerance = 1e-4;
/// Largest scale of an animation: the accelerator's rays in object space stay within its floats.
constexpr double most_scale = 1e9;

double largest_entry(const Mat3& m) {
  return std::max({max_component(glm::abs(m[0])), max_component(glm::abs(m[1])),
                   max_component(glm::abs(m[2]))});
}

/// The orthogonal factor of a matrix with a positive determinant: Newton's iteration of Higham
/// 1986, "Computing the polar decomposition, with applications".
Mat3 nearest_rotation(const Mat3& m) {
  Mat3 q = m * (1 / std::cbrt(glm::determinant(m)));
  for (int i = 0; i < 100; ++i) {
    const Mat3 next = 0.5 * (q + glm::inverse(glm::transpose(q)));
    const double change = largest_entry(next - q);
    q = next;
    if (change < 1e-15) break;
  }
  return q;
}

/// The parts of M = T Q S. If M mirrors, the stretch is negative, so that Q is always a rotation.
struct Parts {
  Vec3 translation;
  glm::dquat rotation;
  Mat3 stretch;

  explicit Parts(const Mat4& m) : translation(m[3]) {
    const Mat3 linear(m);
    const Mat3 q = nearest_rotation(linear * std::copysign(1.0, glm::determinant(linear)));
    rotation = glm::quat_cast(q);
    stretch = glm::transpose(q) * linear;
  }
};

/// The animation itself.
class KeyframeCurve {
 public:
  explicit KeyframeCurve(const Animation& keys) : keys_(keys) {
    for (const Keyframe& key : keys) parts_.emplace_back(from_rows(key.transform));
  }

  Mat4 at(double time) const {
    size_t i = 0;
    while (i < keys_.size() && keys_[i].time < time) ++i;
    if (i == keys_.size()) return from_rows(keys_.back().transform);
    if (i == 0 || keys_[i].time == time || keys_[i].transform == keys_[i - 1].transform)
      return from_rows(keys_[i].transform);
    return between(i - 1, i, (time - keys_[i - 1].time) / (keys_[i].time - keys_[i - 1].time));
  }
  /// The time at this share of the way from the first key to the last one.
  double time(double share) const {
    return keys_.front().time * (1 - share) + keys_.back().time * share;
  }

 private:
  Mat4 between(size_t i, size_t j, double b) const {
    const Parts &x = parts_[i], &y = parts_[j];
    Mat4 m(glm::mat3_cast(glm::slerp(x.rotation, y.rotation, b)) *
           (x.stretch * (1 - b) + y.stretch * b));
    m[3] = Vec4(x.translation * (1 - b) + y.translation * b, 1);
    return m;
  }

  const Animation& keys_;
  std::vector<Parts> parts_;
};

/// Whether linear motion in these steps is close to the curve, relative to its size and length: in
/// the middle of each step, and at the keys.
bool is_near(const KeyframeCurve& curve, const Motion& motion, const Animation& keys) {
  double size = 0, way = 0, turned = 0, moved = 0;
  const auto compare = [&](double time) {
    const Mat4 m = curve.at(time), error = motion.at(time) - m;
    size = std::max(size, largest_entry(Mat3(m)));
    way = std::max(way, length(Vec3(m[3] - motion.steps()[0][3])));
    turned = std::max(turned, largest_entry(Mat3(error)));
    moved = std::max(moved, length(Vec3(error[3])));
  };
  const auto n = static_cast<double>(motion.steps().size() - 1);
  for (int i = 0; i < n; ++i) compare(curve.time((i + 0.5) / n));
  for (const Keyframe& key : keys) compare(key.time);
  return turned <= tolerance * size && moved <= tolerance * way;
}

}  // namespace

std::string animation_problem(const Animation& animation) {
  if (animation.size() < 2)
    return fmt::format("has {} transform{}, but an animation needs two or more", animation.size(),
                       animation.size() == 1 ? "" : "s");
  const auto mirrors = [](const Keyframe& key) {
    return glm::determinant(Mat3(from_rows(key.transform))) < 0;
  };
  for (size_t i = 0; i < animation.size(); ++i) {
    const Keyframe& key = animation[i];
    const Mat4 m = from_rows(key.transform);
    if (i > 0 && !(key.time > animation[i - 1].time))
      return fmt::format("has a transform at time {:g} after one at time {:g}; times must increase",
                         key.time, animation[i - 1].time);
    if (!is_affine(m) || is_singular(m))
      return fmt::format("is singular or has a perspective at time {:g}", key.time);
    if (!(std::max({largest_entry(Mat3(m)), max_component(glm::abs(Vec3(m[3]))),
                    largest_entry(glm::inverse(Mat3(m)))}) < most_scale))
      return fmt::format("moves or scales by more than {:g} at time {:g}", most_scale, key.time);
    if (mirrors(key) != mirrors(animation[0]))
      return fmt::format("mirrors at one of the times {:g} and {:g}, but not at both",
                         animation[0].time, key.time);
  }
  return "";
}

Value during(const Animation& animation, const Shutter& shutter) {
  const KeyframeCurve curve(animation);
  const auto key_at = [&](double time) { return Keyframe{time, to_rows(curve.at(time))}; };
  Animation keys = {key_at(shutter.open)};
  for (const Keyframe& key : animation)
    if (key.time > shutter.open && key.time < shutter.close) keys.push_back(key);
  if (shutter.close > shutter.open) keys.push_back(key_at(shutter.close));
  if (std::all_of(keys.begin(), keys.end(),
                  [&](const Keyframe& key) { return key.transform == keys[0].transform; }))
    return keys[0].transform;
  return keys;
}

Mat4 at_rest(const Animation& animation) {
  Mat4 rest(1);
  if (glm::determinant(Mat3(from_rows(animation[0].transform))) < 0) rest[2].z = -1;
  return rest;
}

Motion::Motion(const Animation& animation) : open_(animation.front().time) {
  if (animation.size() == 1) {
    steps_ = {from_rows(animation[0].transform)};
    return;
  }
  const KeyframeCurve curve(animation);
  for (int n = 1; n <= most_steps; n *= 2) {
    steps_.clear();
    for (int i = 0; i <= n; ++i) steps_.push_back(curve.at(curve.time(1.0 * i / n)));
    steps_per_time_ = n / (animation.back().time - open_);
    if (is_near(curve, *this, animation)) break;
  }
}

Mat4 Motion::at(double time) const {
  if (!moves()) return steps_[0];
  const auto last = static_cast<double>(steps_.size() - 1);
  const double x = std::min(std::max(0.0, (time - open_) * steps_per_time_), last);
  const auto i = static_cast<size_t>(std::min(std::floor(x), last - 1));
  const double b = x - static_cast<double>(i);
  return steps_[i] * (1 - b) + steps_[i + 1] * b;
}

Motion Motion::after(const Mat4& before) const {
  Motion motion = *this;
  for (Mat4& step : motion.steps_) step = step * before;
  return motion;
}

const Animation* animation_param(Params& params, const std::string& name) {
  return params.has(name) ? std::get_if<Animation>(&params.value(name)) : nullptr;
}

Motion motion_param(Params& params, const std::string& name) {
  if (const Animation* animation = animation_param(params, name)) return Motion(*animation);
  return Motion(matrix_param(params, name));
}

Motion motion_param(Params& params, const std::string& name, const Shutter& shutter) {
  const Animation* animation = animation_param(params, name);
  if (!animation) return Motion(matrix_param(params, name));
  const Value seen = during(*animation, shutter);
  if (const auto* moving = std::get_if<Animation>(&seen)) return Motion(*moving);
  return Motion(from_rows(std::get<Matrix>(seen)));
}

}  // namespace mlt
