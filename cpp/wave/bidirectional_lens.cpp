// The vertices of a bidirectional wave that are on the lens, and its walks from there.
#include "wave/bidirectional_wave.h"

namespace mlt {

/// See BidirectionalSampler::walk_from_camera.
void BidirectionalWave::walk_from_camera(RayCounts& rays) {
  const Camera& camera = scene_->camera();
  for (int i = 0; i < size(); ++i) {
    const WalkVertex& lens = this->lens(i).x;
    SurfacePoint at = lens.vertex.at;
    at.wavelength = wavelength_[i];
    const Ray ray = camera_ray(camera, at, rasters_[i]);
    const auto projection = camera.project(at, ray.d);
    if (!projection) continue;
    const double cosine = abs_cos(at, ray.d);
    camera_.start({i, at.p, Vec3f(ray.o), Vec3f(ray.d), static_cast<float>(cosine),
                   static_cast<float>(projection->pdf_direction * cosine), lens.forward,
                   this->lens(i).technique,
                   lens.throughput * (projection->importance / projection->pdf_direction)},
                  ray);
  }
  camera_.walk(numbers_, settings_.rules.most_edges() + 1, rays);
}

/// See sample_lens() of walk.h. What the camera does not ask for keeps other numbers.
void BidirectionalWave::draw_lens() {
  const Camera& camera = scene_->camera();
  numbers_.places() = numbers_.places().begin(Stream::camera);
  const auto at = LensNumbersOf<WaveNumbers::Place>::draw(numbers_.places());
  if (!one_lens_) {
    numbers_.read2(at.position, 0, size(), &u_x_[0], &u_y_[0]);
    numbers_.read(at.time, 0, size(), &u_time_[0]);
  }
  if (camera.spectral()) numbers_.read(numbers_.places().next(), 0, size(), &u_choice_[0]);
  for (int i = 0; i < size(); ++i) wavelength_[i] = camera.wavelength([&] { return u_choice_[i]; });
  const int count = one_lens_ ? 1 : size();
  for (int i = 0; i < count; ++i) {
    const PositionSample lens =
        one_lens_ ? camera.sample_position({0.5, 0.5}, camera.shutter().open)
                  : camera.sample_position({u_x_[i], u_y_[i]}, camera.time(u_time_[i]));
    lenses_[i].x.vertex = camera_vertex(lens.at);
    lenses_[i].x.forward = lens.pdf;
    lenses_[i].x.throughput = Spectrum(1 / lens.pdf);
    lenses_[i].technique = camera.can_be_hit() && settings_.light_image ? 1 : 0;
  }
}

/// The lens, as vertices of eight samples.
const JointLanes& BidirectionalWave::lens_joints(int block) {
  for (int lane = 0; lane < JointLanes::size; ++lane) {
    const SingleWalkVertex& lens = this->lens(block * JointLanes::size + lane);
    lens_joints_.single[lane] = &lens;
    lens_joints_.forward[lane] = lens.x.forward;
    lens_joints_.survival[lane] = 1;
    lens_joints_.dispersed[lane] = false;
  }
  return lens_joints_;
}

}  // namespace mlt
