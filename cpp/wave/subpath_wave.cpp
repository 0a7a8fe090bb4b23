#include "wave/subpath_wave.h"

#include "base/whole_vectors.h"

namespace mlt {

SubpathWave::SubpathWave(const Scene& scene, const PathRules& rules, Subpath::From from,
                         Heuristic heuristic, bool light_image)
    : scene_(&scene),
      rules_(rules),
      from_light_(from == Subpath::From::light),
      light_image_(light_image),
      meets_lens_(from_light_ && light_image && scene.camera().can_be_hit()),
      beta_(heuristic) {}

void SubpathWave::clear() {
  for (int i = 0; i < blocks; ++i) longest_[i] = 0;
  last_place_ = live_ = 0;
  hits_.clear();
  singles_.clear();
}

inline void SubpathWave::set(int walk, const Step& step) {
  sample_[walk] = step.sample;
  previous_[walk] = step.p;
  p_.set(walk, Vec3f(step.p));
  o_.set(walk, step.o);
  d_.set(walk, step.w);
  cosine_[walk] = step.cosine;
  pdf_[walk] = step.pdf;
  forward_[walk] = step.forward;
  sums_[walk] = step.sums;
  throughput_[walk] = step.throughput;
  survival_[walk] = step.survival;
  certainty_[walk] = step.certainty;
  delta_[walk] = step.delta;
  dispersed_[walk] = step.dispersed;
  near_[walk] = 1;
  stops_back_[walk] = 1;
  medium_[walk] = step.medium;
  exact_[walk] = false;
}

inline void SubpathWave::set(int walk, const Ray& ray) {
  ray_[walk] = ray;
  medium_[walk] = ray.medium;
  exact_[walk] = true;
}

inline void SubpathWave::start(const Step& first, double time, double wavelength) {
  set(live_, first);
  start_forward_[first.sample] = first.forward;
  time_[first.sample] = time;
  wavelength_[first.sample] = wavelength;
}

void SubpathWave::start(const Step& first, const Ray& ray) {
  start(first, ray.time, ray.wavelength);
  set(live_++, ray);
}

void SubpathWave::start(const Step& first, double time, double wavelength, uint32_t light,
                        uint32_t triangle) {
  start(first, time, wavelength);
  light_[live_] = light;
  triangle_[live_] = triangle;
  single_light_[live_] = nullptr;
  if (meets_lens_) hit_lens(live_, 0);
  ++live_;
}

void SubpathWave::start(const Step& first, const Ray& ray, const SingleWalkVertex& light) {
  start(first, ray.time, ray.wavelength);
  set(live_, ray);
  near_[live_] = light.x.vertex.at.infinite() ? 0 : 1;
  set_back(live_, light.x.vertex.at);
  single_light_[live_] = &light;
  if (meets_lens_) hit_lens(live_, 0);
  ++live_;
}

const Ray& SubpathWave::exact_ray(int walk) {
  Ray& ray = ray_[walk];
  if (!exact_[walk]) {
    ray = {Vec3(o_[walk]), Vec3(d_[walk]), time_[sample_[walk]]};
    ray.wavelength = wavelength_[sample_[walk]];
    ray.medium = medium_[walk];
    if (ray.medium != no_medium) ray.before = dot(ray.o - previous_[walk], ray.d);
  }
  exact_[walk] = true;
  return ray;
}

void SubpathWave::walk(const WaveNumbers& numbers, int most, RayCounts& rays) {
  numbers_ = numbers;
  for (int i = 0; i < live_; ++i) numbers_.move(i, sample_[i]);
  for (int place = 1; live_ > 0 && place < most; ++place) {
    open(place);
    find_hits(place == 1 && !from_light_, rays);
    next_ = 0;
    if (scene_->has_passages()) leg_ = numbers_.places().next();
    at_ = decltype(at_)::draw(numbers_.places());
    if (scene_->has_passages()) follow_legs(rays);
    for (begin_ = 0; begin_ < live_; begin_ += block_size) {
      count_ = std::min(block_size, live_ - begin_);
      shade(place, place + 1 < most || meets_lens_, rays);
    }
    live_ = next_;
  }
}

/// Makes room for the vertices at a place, where nothing is joined yet.
void SubpathWave::open(int place) {
  last_place_ = place;
  joints_.reserve(size_t{32} * blocks);  // reserves address space alone
  if (joints_.size() < size_t(place + 1) * blocks) joints_.resize(size_t(place + 1) * blocks);
  for (int block = 0; block < blocks; ++block) at(place, block).cosine = {};
}

void SubpathWave::find_hits(bool coherent, RayCounts& rays) {
  find_wave_hits(
      scene_->accel(), live_, o_, d_, [&](int i) -> const Ray& { return exact_ray(i); },
      [&](int i) { return time_[sample_[i]]; }, coherent, found_);
  rays.count_intersect(live_);
}

void SubpathWave::shade(int place, bool goes_on, RayCounts& rays) {
  if (goes_on)
    numbers_.read2(at_.direction, begin_, count_, &lambertian_.u_x[0], &lambertian_.u_y[0]);
  passed_.clear();
  find_vertices(place);
  lambertian_.find_reflectances();
  lambertian_.find_points(count_, &d_.x[begin_], &d_.y[begin_], &d_.z[begin_],
                          rules_.strict_normals);
  if (goes_on) lambertian_.sample_directions(count_, rules_.strict_normals);
  find_techniques(place);
  arrive();
  if (scene_->has_media()) arrive_alone();
  for (int i = 0; i < count_; ++i) {
    if (cosine_to_previous_[i] == 0) continue;
    if (lambertian_.f[i])
      keep_lambertian(i, place);
    else if (single_[i])
      keep_other(i, place);
  }
  if (goes_on) take_steps(place, rays);
}

/// Finds how often the technique with its joint before the vertex counts (TechniqueSums), if a path
/// is joined there.
void SubpathWave::find_techniques(int place) {
  for (int i = 0; i < count_; ++i) technique_[i] = can_join_before(begin_ + i, place) ? 1 : 0;
  if (!(from_light_ && place == 1)) return;
  SurfacePoint from;
  for (int i = 0; i < count_; ++i) {
    if (!lambertian_.f[i] && !single_[i]) continue;
    from.p = single_[i] ? single_[i]->x.vertex.at.p : Vec3(lambertian_.p[i]);
    technique_[i] = direct_technique(begin_ + i, from);
  }
}

/// Computes the densities with which the two walks make the vertex and the one before it.
void SubpathWave::arrive() {
  const int end = whole_vectors(count_);
  for (int i = 0; i < end; ++i) {
    const int k = begin_ + i;
    const Vec3f w = d_[k], between = lambertian_.p[i] - p_[k], ng = lambertian_.surface.ng[i];
    const float cosine = -dot(lambertian_.n[i], w);
    const auto [geometric, quotient, ok] = lambertian_edge(
        ng, lambertian_.n[i], -w, scatters(cosine, lambertian_.back[i] > 0) ? cosine : 0,
        rules_.strict_normals);
    const double per_distance2 = 1 / double{near_[k] * dot(between, between) + (1 - near_[k])};
    const double previous = cosine_[k] * per_distance2;
    const double reverse = ok ? lambertian_pdf(double{cosine}) * previous * stops_back_[k] : 0;
    cosine_to_previous_[i] = ok ? cosine : 0;
    forward_here_[i] = pdf_[k] * geometric * per_distance2;
    sums_here_[i] = technique_[i] + beta_.over(sums_[k], reverse / forward_[k]);
    G_[i] = geometric * previous;
    light_factor_[i] = quotient;
    next_cosine_[i] = std::fabs(dot(ng, lambertian_.w[i]));
  }
}

/// The joints of the sample of a walk, in its lane.
inline JointLanes& SubpathWave::joint(int i, int place, int lane) {
  const int block = sample_[begin_ + i] / JointLanes::size;
  JointLanes& x = at(place, block);
  longest_[block] = place;
  x.p.set(lane, lambertian_.p[i]);
  x.cosine[lane] = cosine_to_previous_[i];
  x.forward[lane] = forward_here_[i];
  x.survival[lane] = survival_[begin_ + i];
  x.dispersed[lane] = dispersed_[begin_ + i];
  x.single[lane] = single_[i];
  return x;
}

/// Stores the vertex of a walk for joints.
inline void SubpathWave::keep_lambertian(int i, int place) {
  const int lane = sample_[begin_ + i] % JointLanes::size;
  JointLanes& x = joint(i, place, lane);
  x.ng.set(lane, lambertian_.surface.ng[i]);
  x.n.set(lane, lambertian_.n[i]);
  x.extent[lane] = lambertian_.surface.extent[i];
  x.sums[lane] = sums_here_[i];
  x.medium[lane] = medium_[begin_ + i];
  x.value.set(lane, throughput_[begin_ + i] * *lambertian_.f[i] *
                        (from_light_ ? double{light_factor_[i]} : 1.0));
}

/// Stores a vertex that is not Lambertian for joints.
void SubpathWave::keep_other(int i, int place) {
  SingleWalkVertex& single = *single_[i];
  single.x.forward = forward_here_[i];
  single.x.G = G_[i];
  single.x.passes_back = stops_back_[begin_ + i];
  single.technique = technique_[i];
  single.sums_before = sums_[begin_ + i];
  single.forward_before = forward_[begin_ + i];
  if (BsdfAt(*scene_, single.x.vertex.at).has_smooth())
    joint(i, place, sample_[begin_ + i] % JointLanes::size);
}

/// See Subpath::scatter.
void SubpathWave::take_steps(int place, RayCounts& rays) {
  for (int i = 0; i < count_; ++i) {
    if (cosine_to_previous_[i] == 0) continue;
    const int next = next_;
    if (lambertian_.f[i])
      scatter_lambertian(i, place);
    else if (single_[i])
      scatter_other(i, place, rays);
    if (next_ == next) continue;
    if (meets_lens_) hit_lens(next, place);
    if (vanishes(throughput_[next] * start_forward_[sample_[next]])) next_ = next;
  }
}

inline void SubpathWave::scatter_lambertian(int i, int place) {
  const int k = begin_ + i;
  const float pdf = lambertian_.scatter_pdf[i];
  if (!(pdf > 0 && next_cosine_[i] > 0) || is_black(*lambertian_.f[i])) return;
  Spectrum ratio = *lambertian_.f[i] * pi;
  if (from_light_) ratio *= light_factor_[i] * next_cosine_[i] / (pdf * pi);
  const double survival =
      survive(i, place, max_component(scene_->has_passages() ? transmitted_[i] * ratio : ratio));
  if (survival == 0) return;
  numbers_.move(next_, k);
  set(next_++,
      {sample_[k], Vec3(lambertian_.p[i]), lambertian_.o[i], lambertian_.w[i], next_cosine_[i], pdf,
       forward_here_[i], sums_here_[i], throughput_[k] * (ratio / survival),
       survival_[k] * survival, 0, false, dispersed_[k], medium_[k]});
}

void SubpathWave::scatter_other(int i, int place, RayCounts& rays) {
  const int k = begin_ + i;
  WalkVertex& x = single_[i]->x;
  const Walker walker{*scene_, time_[sample_[k]], rays};
  const StepNumbers u{{lambertian_.u_x[i], lambertian_.u_y[i]},
                      numbers_.read(at_.lobe, k),
                      place < rules_.rr_depth ? 0 : numbers_.read(at_.roulette, k)};
  const auto from = from_light_ ? Subpath::From::light : Subpath::From::camera;
  const auto back = scatter(walker, rules_, from, u, place, x);
  if (!back) return;
  const Ray ray = walker.leave(x.vertex.at, x.towards_next);
  const double cosine = abs_cos(x.vertex.at, ray.d);
  const bool delta = x.vertex.delta();
  const double chance = from_light_ ? *back * x.passes_back : x.next_coefficient;
  numbers_.move(next_, k);
  set(next_, {sample_[k], x.vertex.at.p, Vec3f(ray.o), Vec3f(ray.d), static_cast<float>(cosine),
              static_cast<float>(x.next_coefficient * cosine), forward_here_[i],
              single_[i]->walk_sums(beta_, *back), x.next_throughput, x.next_survival,
              delta ? certainty_[k] * chance : 0, delta, x.next_dispersed});
  set(next_, ray);
  if (scene_->has_passages()) set_back(next_, x.vertex.at);
  ++next_;
}

/// The probability of surviving Russian roulette; 0 ends the walk.
inline double SubpathWave::survive(int i, int place, double ratio) {
  if (place < rules_.rr_depth) return 1;
  const double survival = PathRules::survival(ratio);
  return numbers_.read(at_.roulette, begin_ + i) < survival ? survival : 0;
}

}  // namespace mlt
