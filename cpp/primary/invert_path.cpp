#include "primary/invert_path.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstring>

namespace mlt {
namespace {

/// Writes numbers in the order in which a sampler reads them.
class PrimaryWriter {
 public:
  explicit PrimaryWriter(PrimaryNumbers& numbers) : numbers_(&numbers) {}

  void begin(Stream stream) {
    stream_ = stream;
    next_ = 0;
  }
  template <class Numbers>
  void write(const Numbers& numbers) {
    double values[count_of<Numbers>];
    std::memcpy(values, &numbers, sizeof values);
    for (const double u : values) numbers_->set(stream_, next_++, glm::clamp(u, 0.0, 1 - 0x1p-53));
  }

 private:
  PrimaryNumbers* numbers_;
  Stream stream_ = Stream::camera;
  size_t next_ = 0;
};

class PathInverter {
 public:
  PathInverter(const Scene& scene, const Path& path, Rng& rng, PrimaryNumbers& numbers)
      : scene_(scene), path_(path), rng_(rng), out_(numbers) {}

  bool invert(const Technique& technique) {
    const auto [s, t] = technique;
    if (!invert_camera_walk(t)) return false;
    if (s == 0) return invert_chosen_background();
    if (s == 1 && t > 0) return invert_direct();
    return invert_light_walk(t == 0 ? s - 1 : s, t == 0);
  }

 private:
  double any() { return rng_.next(); }
  Vec2 any2() {
    const double x = any();
    return {x, any()};
  }
  const SurfacePoint& at(int i) const { return path_[i].at; }
  Vec3 direction(int from, int to) const { return mlt::direction(at(from), at(to)); }

  /// Inverts a camera walk with the directions of its first t - 1 vertices.
  bool invert_camera_walk(int t) {
    const Camera& camera = scene_.camera();
    const int k = path_.edges();
    const Shutter& shutter = camera.shutter();
    out_.begin(Stream::camera);
    if (t >= 2) {
      const auto raster = camera.raster_position(at(k), direction(k, k - 1));
      if (!raster || !camera.raster().contains(*raster)) return false;
      out_.write(camera.raster().invert(*raster));
    } else {
      out_.write(any2());
    }
    out_.write(LensNumbers{
        t == 0 || camera.delta_position() ? any2() : camera.invert_position(at(k)),
        shutter.close > shutter.open ? (path_.time - shutter.open) / (shutter.close - shutter.open)
                                     : any()});
    for (int i = k - 1; i > k + 1 - t; --i)
      if (!invert_scattering(i, i + 1, i - 1)) return false;
    return true;
  }

  /// Inverts a light walk with the directions of the vertices after x_0: of all of them if the walk
  /// `goes_on`, or of all but the last.
  bool invert_light_walk(int vertices, bool goes_on) {
    const Emitter& emitter = *scene_.emitters()[path_[0].emitter];
    out_.begin(Stream::light);
    out_.write(LightNumbers{emitter.delta() ? any2() : emitter.invert_position(at(0)),
                            vertices >= 2 || goes_on ? emitter.invert_ray(at(0), at(1).p) : any2(),
                            scene_.invert_choice(path_[0].emitter, any())});
    for (int i = 1; i < vertices - (goes_on ? 0 : 1); ++i)
      if (!invert_scattering(i, i - 1, i + 1)) return false;
    return true;
  }

  /// Inverts next-event estimation at x_1.
  bool invert_direct() {
    const Emitter& emitter = *scene_.emitters()[path_[0].emitter];
    out_.begin(Stream::direct);
    out_.write(DirectNumbers{emitter.delta() ? any2() : emitter.invert_direct(at(1).p, at(0)),
                             scene_.invert_choice(path_[0].emitter, any())});
    return true;
  }

  /// Inverts the choice among several lights at infinity by technique s = 0.
  bool invert_chosen_background() {
    const std::vector<uint32_t>& infinite = scene_.infinite_emitters();
    const auto found = std::find(infinite.begin(), infinite.end(), path_[0].emitter);
    if (!at(0).infinite() || found == infinite.end()) return true;
    out_.begin(Stream::direct);
    out_.write((static_cast<double>(found - infinite.begin()) + any()) /
               static_cast<double>(infinite.size()));
    return true;
  }

  bool invert_scattering(int i, int from, int to) {
    const SurfacePoint& x = at(i);
    const Vec3 v(any(), any2());
    const auto u = scene_.bsdf(x).invert(x, x.shading.to_local(direction(i, from)),
                                         x.shading.to_local(direction(i, to)), path_[i].lobe, v);
    if (!u) return false;
    out_.write(StepNumbers{Vec2(u->y, u->z), u->x, any()});
    return true;
  }

  const Scene& scene_;
  const Path& path_;
  Rng& rng_;
  PrimaryWriter out_;
};

}  // namespace

bool invert_path(const Scene& scene, const Path& path, const Technique& technique, Rng& rng,
                 PrimaryNumbers& numbers) {
  return PathInverter(scene, path, rng, numbers).invert(technique);
}

}  // namespace mlt
