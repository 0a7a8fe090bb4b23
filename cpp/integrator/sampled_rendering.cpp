#include "integrator/sampled_rendering.h"

#include "base/bytes.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace mlt {

SampledRendering::SampledRendering(ScenePtr scene, uint64_t seed, bool splats)
    : scene_(std::move(scene)),
      seed_(seed),
      splats_(splats),
      film_(scene_->camera().raster().size.x, scene_->camera().raster().size.y,
            scene_->film().filter, groups, splats) {}

uint64_t SampledRendering::unit_count(double spp) const {
  return static_cast<uint64_t>(std::ceil(spp)) * film_.tile_count();
}

double SampledRendering::spp_done(uint64_t units) const {
  return static_cast<double>(units) / film_.tile_count();
}

SampledRendering::Place SampledRendering::place_of(uint64_t pass) {
  const uint64_t block = pass / passes_of_block;
  return {static_cast<int>(block % groups),
          block / groups * passes_of_block + pass % passes_of_block};
}

PixelSampler SampledRendering::sampler(int x, int y, uint64_t pass) const {
  const uint64_t cell = (uint64_t(uint32_t(y)) << 32) | uint32_t(x);
  const Place place = place_of(pass);
  const uint64_t stream = mix_bits(mix_bits(mix_bits(seed_) ^ cell) + place.group);
  return {stream, static_cast<uint32_t>(place.index)};
}

Replay SampledRendering::replay(const Vec2i& pixel, uint64_t sample) {
  Replay replay;
  uint64_t invalid = 0;
  RayCounts rays;
  Sink sink(replay, invalid);
  PixelSampler numbers = sampler(pixel.x, pixel.y, sample);
  replay.raster = Vec2(pixel) + numbers.next2();
  make_worker()->sample(replay.raster, numbers, sink, rays);
  return replay;
}

void SampledRendering::run_unit(uint64_t unit) {
  const uint64_t tiles = film_.tile_count(), pass = unit / tiles;
  const int tile_index = static_cast<int>(unit % tiles);
  const Place place = place_of(pass);
  const uint64_t order = place.index * tiles + tile_index;
  if (film_.has(place.group, order, tile_index)) return;
  SampleFilm::Tile tile = film_.begin(tile_index);
  const PixelRect cells = tile.cells();
  RayCounts rays;
  uint64_t invalid = 0;
  Sink sink(tile, invalid);
  const std::unique_ptr<Worker> worker = make_worker();
  for (int y = cells.y0; y < cells.y1; ++y)
    for (int x = cells.x0; x < cells.x1; ++x) {
      PixelSampler numbers = sampler(x, y, pass);
      const Vec2 raster = Vec2(x, y) + numbers.next2();
      worker->sample(raster, numbers, sink, rays);
    }
  film_.commit(place.group, order, tile_index, std::move(tile), 1);
  invalid_ += invalid;
  intersect_ += rays.intersect;
  occluded_ += rays.occluded;
}

void SampledRendering::add_stats(Stats& stats) const {
  stats.rays_intersect = intersect_;
  stats.rays_occluded = occluded_;
  stats.invalid_samples = invalid_;
}

std::string SampledRendering::save() const {
  ByteWriter bytes;
  bytes.write(film_.save());
  save_counts(bytes);
  return bytes.take();
}

void SampledRendering::load(const std::string& saved) {
  ByteReader bytes(saved);
  std::string film;
  bytes.read(film);
  const Counts counts = bytes.read<Counts>();
  bytes.finish();
  film_.load(film);
  intersect_ = counts[0];
  occluded_ = counts[1];
  invalid_ = counts[2];
}

void SampledRendering::save_counts(ByteWriter& bytes) const {
  bytes.write(Counts{intersect_, occluded_, invalid_});
}

uint64_t SampledRendering::share_of(uint64_t unit) const {
  const uint64_t tiles = film_.tile_count();
  return film_.share_of(place_of(unit / tiles).group, static_cast<int>(unit % tiles));
}

uint64_t SampledRendering::units_per_step() const {
  return splats_ ? groups * units_per_share() : film_.tile_count();
}

std::vector<Part> SampledRendering::parts(int wanted) const {
  const uint64_t shares = share_count();
  const uint64_t pieces = splats_ ? shares : std::clamp<uint64_t>(wanted, 1, shares);
  std::vector<Part> parts;
  for (uint64_t i = 0; i < pieces; ++i)
    parts.push_back({shares * i / pieces, shares * (i + 1) / pieces});
  return parts;
}

/// Those of the passes that the work begins, ends or goes through.
std::vector<int> SampledRendering::groups_of(const Work& work) const {
  const uint64_t tiles = film_.tile_count();
  std::set<int> found;
  for (uint64_t pass = work.from / tiles; pass * tiles < work.to && found.size() < groups; ++pass)
    found.insert(place_of(pass).group);
  return {found.begin(), found.end()};
}

std::string SampledRendering::lend(const Work& work) const {
  const std::vector<int> groups = groups_of(work);
  ByteWriter bytes;
  for (uint64_t share = work.part.first; share < work.part.last; ++share)
    bytes.write(film_.save_share(static_cast<int>(share), groups));
  return bytes.take();
}

void SampledRendering::load_shares(const Work& work, ByteReader& bytes) {
  const std::vector<int> groups = groups_of(work);
  std::string share;
  for (uint64_t i = work.part.first; i < work.part.last; ++i) {
    bytes.read(share);
    film_.load_share(static_cast<int>(i), groups, share);
  }
}

void SampledRendering::borrow(const Work& work, const std::string& lent) {
  ByteReader bytes(lent);
  load_shares(work, bytes);
  bytes.finish();
}

std::string SampledRendering::give_back(const Work& work) const {
  ByteWriter bytes;
  save_counts(bytes);
  return bytes.take() + lend(work);
}

void SampledRendering::take_back(const Work& work, const std::string& given_back) {
  ByteReader bytes(given_back);
  const Counts counts = bytes.read<Counts>();
  load_shares(work, bytes);
  bytes.finish();
  intersect_ += counts[0];
  occluded_ += counts[1];
  invalid_ += counts[2];
}

}  // namespace mlt
