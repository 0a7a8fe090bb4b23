#include "wave/walk_wave.h"

namespace mlt {
namespace {

/// The image position, the lens and the time; in spectral scenes the wavelength comes after them.
constexpr size_t of_camera = count_of<Vec2> + count_of<LensNumbers>;
/// Where light passes surfaces or media; see Walker::draw_leg().
constexpr size_t of_leg = 1;

/// Reads numbers one after the other.
struct Reader {
  const double* u;

  double next() { return *u++; }
  Vec2 next2() {
    const double x = next();
    return {x, next()};
  }
};

}  // namespace

WalkWave::WalkWave(const Scene& scene, const PathRules& rules, const SmallStep& small_step)
    : scene_(&scene), small_step_(small_step), wave_(scene, rules) {
  wave_.numbers().set_source(*this);
}

template <size_t numbers, class Get>
void WalkWave::draw(int count, size_t first, Get&& get) {
  Block<int> row;
  rows_.begin(first);
  for (int i = 0; i < count; ++i) {
    const Proposal& proposal = get(i);
    row[i] = rows_.add<numbers>(proposal.key, proposal.from);
  }
  rows_.draw(small_step_);
  for (int i = 0; i < count; ++i) {
    std::vector<double>& y = get(i).numbers();
    get(i).length = first + numbers;
    if (y.size() < first + numbers) y.resize(first + numbers);
    std::copy_n(rows_[row[i]], numbers, &y[first]);
  }
}

void WalkWave::draw(const int* paths, int count, size_t first, bool leg_alone,
                    const double** numbers) {
  const auto get = [&](int i) -> Proposal& { return proposals_[paths[i]]; };
  if (leg_alone)
    draw<of_leg>(count, first, get);
  else if (scene_->has_passages())
    draw<of_leg + count_of<VertexNumbers>>(count, first, get);
  else
    draw<count_of<VertexNumbers>>(count, first, get);
  for (int i = 0; i < count; ++i) numbers[i] = get(i).numbers().data();
}

void WalkWave::leave_camera() {
  const Camera& camera = scene_->camera();
  const int all = static_cast<int>(proposals_.size());
  for (int begin = 0; begin < all; begin += block_size) {
    const int count = std::min(block_size, all - begin);
    const auto get = [&](int i) -> Proposal& { return proposals_[begin + i]; };
    if (camera.spectral())
      draw<of_camera + 1>(count, 0, get);
    else
      draw<of_camera>(count, 0, get);
  }
  rasters_.clear();
  for (const Proposal& proposal : proposals_) {
    Reader numbers{proposal.numbers().data()};
    rasters_.push_back(camera.raster().sample(numbers.next2()));
    wave_.numbers().add();
    wave_.add(camera_ray(camera, rasters_.back(), numbers).ray);
  }
  wave_.numbers().places() = {of_camera + (camera.spectral() ? 1 : 0)};
}

void WalkWave::trace() {
  leave_camera();
  RayCounts all;
  wave_.trace(all, false);
  const Raster& image = scene_->camera().raster();
  const double scale = image.sampled_area() / image.pixels();
  for (size_t i = 0; i < proposals_.size(); ++i) {
    PrimaryState& y = *proposals_[i].y;
    proposals_[i].numbers().resize(proposals_[i].length);
    y.light.clear();
    if (!is_black(wave_.radiance(i))) y.light.push_back({rasters_[i], wave_.radiance(i) * scale});
    y.find_target();
    *proposals_[i].rays += wave_.rays(i);
  }
  wave_.clear();
  proposals_.clear();
}

}  // namespace mlt
