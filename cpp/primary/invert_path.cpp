#include "primary/invert_path.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstring>

namespace mlt {
namespace {

class PathInverter {
 public:
  PathInverter(const Scene& scene, const Path& path, Rng& rng, PrimarySamples& numbers)
      : scene_(scene), path_(path), any_(rng), numbers_(numbers) {
    numbers.clear();
  }

  bool invert(const Technique& technique) {
    const auto [s, t] = technique;
    if (!invert_camera_walk(t)) return false;
    if (s == 0) return invert_chosen_background();
    if (s == 1 && t > 0) return invert_direct();
    return invert_light_walk(t == 0 ? s - 1 : s, t == 0);
  }

 private:
  /// Adds numbers to a stream, in the order of the members.
  template <class Numbers>
  void write(Stream stream, const Numbers& numbers) {
    double values[count_of<Numbers>];
    std::memcpy(values, &numbers, sizeof values);
    for (const double u : values) numbers_[stream].push_back(glm::clamp(u, 0.0, 1 - 0x1p-53));
  }
  const SurfacePoint& at(int i) const { return path_[i].at; }
  Vec3 direction(int from, int to) const { return mlt::direction(at(from), at(to)); }

  /// Inverts a camera walk with the directions of its first t - 1 vertices.
  bool invert_camera_walk(int t) {
    const Camera& camera = scene_.camera();
    const int k = path_.edges();
    const Shutter& shutter = camera.shutter();
    Vec2 u_raster = any_.next2();
    if (t >= 2) {
      const auto raster = camera.raster_position(at(k), direction(k, k - 1));
      if (!raster || !camera.raster().contains(*raster)) return false;
      u_raster = camera.raster().invert(*raster);
    }
    write(Stream::camera, u_raster);
    LensNumbers u = LensNumbers::draw(any_);
    if (t > 0 && !camera.delta_position()) u.position = camera.invert_position(at(k));
    if (shutter.opens()) u.time = shutter.number(path_.time);
    write(Stream::camera, u);
    if (camera.spectral()) write(Stream::camera, camera.invert_wavelength(path_.wavelength));
    Spectrum likelihood(1);
    for (int i = k - 1; i >= k + 1 - t; --i) {
      invert_leg(Stream::camera, i + 1, i, likelihood);
      if (i > k + 1 - t && !invert_scattering(Stream::camera, i, i + 1, i - 1)) return false;
    }
    return true;
  }

  /// Inverts a light walk with the directions of the vertices after x_0: of all of them if the walk
  /// `goes_on`, or of all but the last.
  bool invert_light_walk(int vertices, bool goes_on) {
    const Emitter& emitter = *scene_.emitters()[path_[0].emitter];
    LightNumbers u = LightNumbers::draw(any_);
    if (!emitter.delta()) u.position = emitter.invert_position(at(0));
    if ((vertices >= 2 || goes_on) && !emitter.delta_direction())
      u.direction = emitter.invert_ray(at(0), at(1).p);
    if (emitter.glowing()) u.choice = emitter.invert_third(at(0));
    u.choice = scene_.light_choice().invert(path_[0].emitter, u.choice);
    write(Stream::light, u);
    Spectrum likelihood(1);
    for (int i = 1; i < vertices; ++i) {
      invert_leg(Stream::light, i - 1, i, likelihood);
      if ((i < vertices - 1 || goes_on) && !invert_scattering(Stream::light, i, i - 1, i + 1))
        return false;
    }
    return true;
  }

  /// Inverts next-event estimation at x_1.
  bool invert_direct() {
    const Emitter& emitter = *scene_.emitters()[path_[0].emitter];
    DirectNumbers u = DirectNumbers::draw(any_);
    if (!emitter.delta()) u.position = emitter.invert_direct(at(1).p, at(0));
    if (emitter.glowing()) u.choice = emitter.invert_third(at(0));
    u.choice = scene_.light_choice().invert_for(path_[0].emitter, at(1).p, u.choice);
    write(Stream::direct, u);
    return true;
  }

  /// Inverts the choice among several lights at infinity by technique s = 0.
  bool invert_chosen_background() {
    const std::vector<uint32_t>& infinite = scene_.infinite_emitters();
    const auto found = std::find(infinite.begin(), infinite.end(), path_[0].emitter);
    if (!at(0).infinite() || found == infinite.end()) return true;
    write(Stream::direct, (static_cast<double>(found - infinite.begin()) + any_.next()) /
                              static_cast<double>(infinite.size()));
    return true;
  }

  /// The numbers of a leg that stops at `to` are those from A P to A, if it passes all before with
  /// the probability A, and the surface of `to` with P; in a medium it is A. The likelihood is that
  /// with which the leg begins, and then ends.
  void invert_leg(Stream stream, int from, int to, Spectrum& likelihood) {
    if (!scene_.has_passages()) return;
    const Vec3 w = direction(from, to);
    const Passage edge = scene_.passage(at(from), at(to), path_.time);
    const double before = edge.probability * mean(likelihood * edge.flight);
    const double stops = at(to).in_medium() ? 0 : scene_.stop_probability(at(to), w);
    likelihood = scene_.arrival(edge, at(to), w).after(likelihood).next_likelihood();
    write(stream, before * (1 - stops + stops * any_.next()));
  }

  bool invert_scattering(Stream stream, int i, int from, int to) {
    const SurfacePoint& x = at(i);
    StepNumbers u = StepNumbers::draw(any_);
    const auto inverted = scene_.bsdf(x).invert(x, x.shading.to_local(direction(i, from)),
                                                x.shading.to_local(direction(i, to)), path_[i].lobe,
                                                u.for_scattering());
    if (!inverted) return false;
    u.lobe = inverted->x;
    u.direction = {inverted->y, inverted->z};
    write(stream, u);
    return true;
  }

  const Scene& scene_;
  const Path& path_;
  RandomSampler any_;  ///< Numbers that the path does not decide.
  PrimarySamples& numbers_;
};

}  // namespace

bool invert_path(const Scene& scene, const Path& path, const Technique& technique, Rng& rng,
                 PrimarySamples& numbers) {
  return PathInverter(scene, path, rng, numbers).invert(technique);
}

}  // namespace mlt
