#include "integrator/tours/path_tours.h"

#include "rendering/beside_chains.h"
#include "wave/bidirectional_wave.h"

#include <algorithm>

namespace mlt {
namespace {

/// The numbers of the plastic number's sequence in two dimensions (M. Roberts, "The unreasonable
/// effectiveness of quasirandom sequences", 2018), a Kronecker sequence.
constexpr double kill_turn = 0.7548776662466927, copies_turn = 0.5698402909980532;
/// From one tour of a path to the next, and from one path to the next: the golden ratio, and pi.
constexpr double tour_turn = 0.6180339887498949, path_turn = 0.14159265358979312;

double fraction(double turns) { return turns - std::floor(turns); }

/// Samples of a wave are those that are drawn alone, up to rounding: so much more is drawn again.
constexpr double rounding = 1.001;

}  // namespace

PathTours::PathTours(const PathTarget& target, const PathMixture& mixture, const ChainId& id,
                     const TourRules& rules)
    : target_(&target),
      rules_(rules),
      seeds_(target),
      in_waves_(BidirectionalWave::supports(target.scene(), PathSeeds::settings(target))),
      chain_(PathKernel(target, mixture, id), id, {}),
      id_(id),
      stream_(mix_bits(mix_bits(id.seed ^ mix_bits(uint64_t(id.purpose))) + id.group)),
      due_(chain_.rng().next()) {
  Rng rng(stream_, id.purpose, 0);
  first_chances_.kill = rng.next();
  first_chances_.copies = rng.next();
}

void PathTours::advance(uint64_t steps, ChainRecorder& recorder) {
  due_ += static_cast<double>(steps) / rules_.steps_per_start;
  auto samples = static_cast<uint64_t>(due_);
  due_ -= static_cast<double>(samples);
  if (in_waves_)
    draw_side_by_side(samples, recorder);
  else
    for (; samples > 0; --samples) draw(in_group(count_++), recorder);
  continue_tours(recorder);
}

void PathTours::draw_side_by_side(uint64_t samples, ChainRecorder& recorder) {
  const Scene& scene = target_->scene();
  const Raster& raster = scene.camera().raster();
  const BidirectionalSettings settings = PathSeeds::settings(*target_);
  PathTargeting targeting(*target_, BidirectionalEstimator(scene, settings).own_scale());
  BidirectionalWave wave(scene, settings);
  wave.set_cell(raster.sample(Vec2(1)) - raster.sample(Vec2(0)));
  RayCounts rays;
  while (samples > 0) {
    wave.clear();
    const uint64_t first = count_;
    for (; samples > 0 && !wave.full(); --samples)
      wave.add(stream_, static_cast<uint32_t>(in_group(count_++)), raster.sample(Vec2(0)));
    wave.trace(rays);
    for (int i = 0; i < wave.size(); ++i) {
      const uint64_t sample = in_group(first + i);
      const Chances chances = this->chances(sample);
      SampleWeights sum;
      bool starts = false;
      wave.show_lights(i, [&](const FoundLight& light) {
        targeting.add(light, [&](const FoundLight& found) {
          if (!found.valid()) return;
          sum.add(found, target_->weights());
          choose(chances.of(found.joint), rounding * bound(found.target_over_density),
                 rounding / found.over_density, [&](double) { starts = true; });
        });
      });
      add(sum);
      if (starts) start_tours(sample, recorder, nullptr);
    }
  }
  chain_.count(rays);
}

void PathTours::draw(uint64_t sample, ChainRecorder& recorder) {
  SampleWeights sum;
  start_tours(sample, recorder, &sum);
  add(sum);
}

/// Draws a sample, sums up its light and starts the tours. A path that roulette has let through
/// with probability q starts r / q tours in the mean, times found_again where the probability of
/// finding it is estimated.
void PathTours::start_tours(uint64_t sample, ChainRecorder& recorder, SampleWeights* sum) {
  const Chances chances = this->chances(sample);
  PixelSampler sampler(stream_, static_cast<uint32_t>(sample));
  const Vec2 raster = target_->scene().camera().raster().sample(sampler.next2());
  seeds_.draw(raster, sampler, [&](const Connection& c, double weight) {
    FoundLight light;
    light.rgb = c.contribution * c.weight;
    light.weight = weight;
    light.target_over_density = weight / c.weight * c.own_share;
    if (sum) sum->add(light, target_->weights());
    bool assembled = false;
    choose(chances.of(joint_number(c.s, c.t)), bound(light.target_over_density),
           c.found_again / c.survival, [&](double u) {
             if (!assembled) seeds_.assemble(c, start_);
             assembled = true;
             if (start_.target > 0 && survival(start_) > u) start_tour(u, recorder);
           });
  });
  chain_.count(seeds_.take_rays());
}

/// T' / S of a path with this T / S, or a bound of it: where the samples of the image have other
/// techniques, it takes the path to tell.
double PathTours::bound(double over_starts) const {
  if (target_->techniques() != SampleTechniques::all) return over_starts;
  return over_starts * target_->weights().of_chain(over_starts);
}

/// Calls start(u) for each tour from a path that stands for this number of paths, if that may
/// survive its first state.
template <class Start>
void PathTours::choose(const Chances& chances, double over_starts, double paths,
                       Start&& start) const {
  if (!(over_starts > 0) || !std::isfinite(over_starts)) return;
  const double survival = rules_.rate.survival(over_starts),
               count = std::floor(rules_.rate.starts(over_starts) * paths + chances.copies);
  for (double i = 0; i < count; ++i)
    if (const double u = fraction(chances.kill + i * tour_turn); survival > u) start(u);
}

/// The chances of paths of one technique.
PathTours::Chances PathTours::Chances::of(int joint) const {
  return {fraction(kill + joint * path_turn), fraction(copies + joint * path_turn)};
}

PathTours::Chances PathTours::chances(uint64_t sample) const {
  const auto i = static_cast<double>(sample);
  return {fraction(first_chances_.kill + i * kill_turn),
          fraction(first_chances_.copies + i * copies_turn)};
}

/// The weights of a sample are those of all techniques.
void PathTours::add(const SampleWeights& sum) {
  samples_.brightness.add(sum.brightness);
  samples_.classes.add(sum.brightness);
  if (target_->techniques() == SampleTechniques::all) samples_.of_chains.add(sum.of_chains);
}

void PathTours::start_tour(double u, ChainRecorder& recorder) {
  Tour tour{u};
  steps_.clear();
  if (!go_on(start_, tour, recorder)) waiting_.push_back({chain_.state(), tour, steps_});
}

void PathTours::continue_tours(ChainRecorder& recorder) {
  const auto dead = [&](Waiting& waiting) {
    if (!waiting.steps.has_room(waiting.state.raster, most_in_pixel())) return false;
    steps_ = std::move(waiting.steps);
    if (go_on(waiting.state, waiting.tour, recorder)) return true;
    waiting.state = chain_.state();
    waiting.steps = std::move(steps_);
    return false;
  };
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), dead), waiting_.end());
}

/// Goes on with a tour until it dies or must wait. Returns whether it is dead.
bool PathTours::go_on(const PathState& start, Tour& tour, ChainRecorder& recorder) {
  chain_.restart(start);
  StepRecorder<PathKernel> record = chain_.begin(recorder);
  const PathState& x = chain_.state();
  const double most = most_in_pixel();
  const bool dead = run_tour(
      tour, [&] { return std::isinf(most) || steps_.count(x.raster, most); },
      [&] { return survival(x); }, [&] { chain_.step(record); });
  record.finish();
  chain_.count_tour(tour.steps, dead);
  return dead;
}

/// All chains have drawn about as many samples as this one.
double PathTours::most_in_pixel() const {
  const double chains = static_cast<double>(id_.count) * Rendering::group_count,
               samples = static_cast<double>(count_) * chains,
               pixels = target_->scene().camera().raster().pixels();
  return most_steps_in_pixel(rules_.steps_in_pixel, samples / pixels);
}

double PathTours::light_due() const {
  double sum = 0;
  for (const auto& [x, tour, steps] : waiting_)
    sum += rules_.rate.steps(target_->over_starts(x)) * target_luminance(x.rgb) / x.target *
           target_->weights().of_chain(target_->over_density(x));
  return sum;
}

void PathTours::save(ByteWriter& bytes) const {
  chain_.save_progress(bytes);
  chain_.kernel().save_progress(bytes);
  samples_.save(bytes);
  bytes.write(count_);
  bytes.write(due_);
  bytes.write<uint64_t>(waiting_.size());
  for (const Waiting& waiting : waiting_) {
    bytes.write(waiting.tour);
    waiting.steps.save(bytes);
    chain_.kernel().save(bytes, waiting.state);
  }
}

void PathTours::load(ByteReader& bytes) {
  chain_.load_progress(bytes);
  chain_.kernel().load_progress(bytes);
  samples_.load(bytes);
  bytes.read(count_);
  bytes.read(due_);
  if (!(0 <= due_ && due_ < 1)) throw RenderError("the saved state owes more than a sample");
  waiting_.clear();
  for (auto left = bytes.read<uint64_t>(); left > 0; --left) {
    Waiting& waiting = waiting_.emplace_back();
    bytes.read(waiting.tour);
    waiting.steps.load(bytes);
    chain_.kernel().load(bytes, waiting.state);
  }
}

}  // namespace mlt
