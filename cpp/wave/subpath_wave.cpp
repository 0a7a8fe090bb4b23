#include "wave/subpath_wave.h"

#include "base/whole_vectors.h"

namespace mlt {

SubpathWave::SubpathWave(const Scene& scene, const PathRules& rules, Subpath::From from,
                         Heuristic heuristic, bool light_image)
    : scene_(&scene),
      rules_(rules),
      from_light_(from == Subpath::From::light),
      light_image_(light_image),
      beta_(heuristic) {}

void SubpathWave::clear(int count) {
  for (int i = 0; i < count; ++i) fell_back_[i] = false;
  for (int i = 0; i < blocks; ++i) longest_[i] = 0;
  last_place_ = live_ = 0;
  hits_.clear();
}

void SubpathWave::start(int sample, const Start& start) {
  const int i = live_++;
  sample_[i] = sample;
  o_.set(i, start.o);
  d_.set(i, start.w);
  p_.set(i, start.p);
  cosine_[i] = start.cosine;
  pdf_[i] = start.pdf;
  forward_[i] = start.forward;
  sums_[i] = start.sums;
  survival_[i] = 1;
  throughput_[i] = start.throughput;
  wavelength_[i] = start.wavelength;
  light_[i] = start.light;
  triangle_[i] = start.triangle;
}

void SubpathWave::fall_back(int sample) {
  fell_back_[sample] = true;
  for (int place = 1; place <= last_place_; ++place)
    at(place, sample / JointLanes::size).cosine[sample % JointLanes::size] = 0;
}

void SubpathWave::walk(const WaveNumbers& numbers, int most, RayCounts& rays) {
  numbers_ = numbers;
  for (int i = 0; i < live_; ++i) numbers_.move(i, sample_[i]);
  for (int place = 1; live_ > 0 && place < most; ++place) {
    if (place == most_vertices) {
      for (int i = 0; i < live_; ++i) fell_back_[sample_[i]] = true;
      return;
    }
    open(place);
    find_hits(place == 1 && !from_light_, rays);
    next_ = 0;
    at_ = decltype(at_)::draw(numbers_.places());
    for (begin_ = 0; begin_ < live_; begin_ += block_size) {
      count_ = std::min(block_size, live_ - begin_);
      shade(place, place + 1 == most);
    }
    live_ = next_;
  }
}

/// Makes room for the vertices at a place, where nothing is joined yet.
void SubpathWave::open(int place) {
  last_place_ = place;
  joints_.reserve(size_t{most_vertices} * blocks);  // reserves address space alone
  if (joints_.size() < size_t(place + 1) * blocks) joints_.resize(size_t(place + 1) * blocks);
  for (int block = 0; block < blocks; ++block) at(place, block).cosine = {};
}

void SubpathWave::find_hits(bool coherent, RayCounts& rays) {
  for (int begin = 0; begin < live_; begin += RayPacket::size) {
    RayPacket packet(std::min(RayPacket::size, live_ - begin));
    packet.set_lines(&o_.x[begin], &o_.y[begin], &o_.z[begin], &d_.x[begin], &d_.y[begin],
                     &d_.z[begin]);
    packet.set_endless();
    scene_->accel().intersect(packet, nullptr, coherent, found_[begin / RayPacket::size]);
  }
  rays.count_intersect(live_);
}

void SubpathWave::shade(int place, bool last) {
  if (!last)
    numbers_.read2(at_.direction, begin_, count_, &lambertian_.u_x[0], &lambertian_.u_y[0]);
  for (int i = 0; i < count_; ++i) find_vertex(i);
  lambertian_.find_reflectances();
  lambertian_.find_points(count_, &d_.x[begin_], &d_.y[begin_], &d_.z[begin_],
                          rules_.strict_normals);
  if (!last) lambertian_.sample_directions(count_, rules_.strict_normals);
  find_techniques(place);
  arrive();
  for (int i = 0; i < count_; ++i) {
    if (!lambertian_.f[i]) continue;
    if (emits_[i] && !from_light_ && rules_.wants(place)) hit_light(i, place);
    keep(i, place);
  }
  if (!last) take_steps(place);
}

inline void SubpathWave::find_vertex(int i) {
  const PacketHits& found = found_[(begin_ + i) / RayPacket::size];
  const int lane = i % RayPacket::size;
  lambertian_.f[i] = nullptr;
  if (found.shape[lane] == SurfacePoint::no_shape) return;
  const LambertianMesh& shape = scene_->lambertian_mesh(found.shape[lane]);
  if (!shape.mesh) {
    fell_back_[sample_[begin_ + i]] = true;
    return;
  }
  emits_[i] = shape.emits;
  lambertian_.set(i, shape, found.primitive[lane], found.u[lane], found.v[lane],
                  wavelength_[begin_ + i]);
}

/// How often next-event estimation at p counts as technique s = 1 with x_0 on this triangle
/// (TechniqueSums): its density over that of a walk.
double SubpathWave::direct_technique(uint32_t light, uint32_t triangle, const Vec3f& p) const {
  double quotient = 1;
  if (scene_->light_choice().depends_on_point())
    quotient *=
        scene_->emitter_probability_for(light, Vec3(p)) / scene_->emitter_probability(light);
  if (const Mesh& mesh = *scene_->mesh_light(light).mesh; mesh.chooses_by_point())
    quotient *= mesh.direct_density(triangle, Vec3(p)) * mesh.area();
  return quotient;
}

/// Finds how often the technique with its joint before the vertex counts (TechniqueSums).
void SubpathWave::find_techniques(int place) {
  const double all = from_light_ || place > 1 || light_image_ ? 1 : 0;
  for (int i = 0; i < whole_vectors(count_); ++i) technique_[i] = all;
  for (int i = 0; from_light_ && place == 1 && i < count_; ++i)
    if (const int k = begin_ + i; lambertian_.f[i])
      technique_[i] = beta_.raise(direct_technique(light_[k], triangle_[k], lambertian_.p[i]));
}

/// Computes the densities with which the two walks make the vertex and the one before it. A
/// scattered direction has the density |w.ns| / pi in solid angle.
void SubpathWave::arrive() {
  const int end = whole_vectors(count_);
  for (int i = 0; i < end; ++i) {
    const int k = begin_ + i;
    const Vec3f w = d_[k], between = lambertian_.p[i] - p_[k], ng = lambertian_.surface.ng[i];
    const float cosine = -dot(lambertian_.n[i], w);
    const auto [geometric, quotient, ok] = lambertian_edge(
        ng, lambertian_.n[i], -w, scatters(cosine, lambertian_.back[i] > 0) ? cosine : 0,
        rules_.strict_normals);
    const double per_distance2 = 1 / double{dot(between, between)};
    const double previous = cosine_[k] * per_distance2;
    const double reverse = ok ? std::fabs(cosine) * inv_pi * previous : 0;
    cosine_to_previous_[i] = ok ? cosine : 0;
    forward_here_[i] = pdf_[k] * geometric * per_distance2;
    sums_here_[i] = technique_[i] + beta_.over(sums_[k], reverse / forward_[k]);
    reverse_emission_[i] = geometric * inv_pi * previous;
    light_factor_[i] = quotient;
    next_cosine_[i] = std::fabs(dot(ng, lambertian_.w[i]));
  }
}

/// See BidirectionalSampler::evaluate_hit_light.
void SubpathWave::hit_light(int i, int place) {
  const int k = begin_ + i;
  if (!(dot(lambertian_.surface.ng[i], d_[k]) < 0)) return;
  const PacketHits& found = found_[k / RayPacket::size];
  const int lane = k % RayPacket::size;
  const uint32_t shape = found.shape[lane];
  const uint32_t index = scene_->shapes()[shape]->emitter()->index();
  const MeshLight& light = scene_->mesh_light(index);
  const Spectrum radiance = light.radiance_at(wavelength_[k]);
  const double direct =
      technique_[i] * beta_.raise(direct_technique(index, found.primitive[lane], p_[k]));
  const double above =
      beta_.over(direct + beta_.over(sums_[k], reverse_emission_[i] / forward_[k]),
                 scene_->emitter_probability(index) / light.mesh->area() / forward_here_[i]);
  hits_.push_back({sample_[k], place, throughput_[k] * radiance / (1 + above), survival_[k]});
}

/// Stores the vertex of a walk for joints.
inline void SubpathWave::keep(int i, int place) {
  if (cosine_to_previous_[i] == 0) return;
  const int sample = sample_[begin_ + i], block = sample / JointLanes::size;
  const int lane = sample % JointLanes::size;
  JointLanes& x = at(place, block);
  longest_[block] = place;
  x.p.set(lane, lambertian_.p[i]);
  x.ng.set(lane, lambertian_.surface.ng[i]);
  x.n.set(lane, lambertian_.n[i]);
  x.extent[lane] = lambertian_.surface.extent[i];
  x.cosine[lane] = cosine_to_previous_[i];
  x.forward[lane] = forward_here_[i];
  x.sums[lane] = sums_here_[i];
  x.survival[lane] = survival_[begin_ + i];
  x.value.set(lane, throughput_[begin_ + i] * *lambertian_.f[i] *
                        (from_light_ ? double{light_factor_[i]} : 1.0));
}

/// See Subpath::scatter.
void SubpathWave::take_steps(int place) {
  for (int i = 0; i < count_; ++i) {
    const int k = begin_ + i;
    if (!lambertian_.f[i] || cosine_to_previous_[i] == 0) continue;
    const float pdf = lambertian_.scatter_pdf[i];
    if (!(pdf > 0 && next_cosine_[i] > 0) || is_black(*lambertian_.f[i])) continue;
    Spectrum ratio = *lambertian_.f[i] * pi;
    if (from_light_) ratio *= light_factor_[i] * next_cosine_[i] / (pdf * pi);
    const double survival = survive(i, place, max_component(ratio));
    if (survival == 0) continue;
    const int n = next_++;
    sample_[n] = sample_[k];
    o_.set(n, lambertian_.o[i]);
    d_.set(n, lambertian_.w[i]);
    p_.set(n, lambertian_.p[i]);
    cosine_[n] = next_cosine_[i];
    pdf_[n] = pdf;
    forward_[n] = forward_here_[i];
    sums_[n] = sums_here_[i];
    throughput_[n] = throughput_[k] * (ratio / survival);
    survival_[n] = survival_[k] * survival;
    wavelength_[n] = wavelength_[k];
    numbers_.move(n, k);
  }
}

/// The probability of surviving Russian roulette; 0 ends the walk.
inline double SubpathWave::survive(int i, int place, double ratio) {
  if (place < rules_.rr_depth) return 1;
  const double survival = PathRules::survival(ratio);
  return numbers_.read(at_.roulette, begin_ + i) < survival ? survival : 0;
}

}  // namespace mlt
