#include "rendering/cryptomatte.h"

#include "base/murmur3.h"
#include "rendering/alpha.h"
#include "rendering/matte_samples.h"
#include "rendering/ranked_coverage.h"

#include <fmt/format.h>

#include <cstring>
#include <set>

namespace mlt {
namespace {

const std::vector<std::string>& all_names(AovKind kind, const SurfaceNames& names) {
  return kind == AovKind::cryptomatte_object ? names.objects : names.materials;
}

/// One Cryptomatte.
class Matte {
 public:
  Matte(const Aov& aov, const SurfaceNames& names, const Vec2i& size) : kind_(aov.kind) {
    for (const std::string& name : all_names(kind_, names))
      ids_.push_back(as_pixel(cryptomatte_id(name)));
    for (std::string& name : cryptomatte_layers(aov))
      layers_.push_back({std::move(name), Image(size.x, size.y, 4)});
  }

  float id_of(const SeenSurface& seen) const {
    return ids_[kind_ == AovKind::cryptomatte_object ? seen.object : seen.shape];
  }
  void set(int x, int y, const std::vector<IdCoverage>& ranks) {
    for (size_t rank = 0; rank < std::min(ranks.size(), 2 * layers_.size()); ++rank) {
      Image& image = layers_[rank / 2].image;
      const int channel = rank % 2 == 0 ? 0 : 2;
      image.at(x, y, channel) = ranks[rank].id;
      image.at(x, y, channel + 1) = static_cast<float>(ranks[rank].coverage);
    }
  }
  std::vector<NamedImage>& layers() { return layers_; }

 private:
  AovKind kind_;
  std::vector<float> ids_;  ///< By place in Scene::shapes().
  std::vector<NamedImage> layers_;
};

/// The pixels of one tile.
class MatteTile {
 public:
  MatteTile(const Scene& scene, const PixelRect& pixels) : scene_(scene), pixels_(pixels) {}

  void render(std::vector<Matte>& mattes, uint64_t seed) const {
    const int border = filter_border(filter());
    MatteSamples samples(scene_, {pixels_.x0 - border, pixels_.y0 - border, pixels_.x1 + border,
                                  pixels_.y1 + border});
    samples.take(seed, fewest_alpha_samples);
    if (!samples.are_equal()) samples.take(seed, alpha_samples);
    for (Matte& matte : mattes) samples.are_equal() ? fill(matte, samples) : add(matte, samples);
  }

 private:
  const Filter& filter() const { return *scene_.film().filter; }

  void fill(Matte& matte, const MatteSamples& samples) const {
    RankedCoverage seen;
    for (const SeenSurface& one : samples.first()) seen.add(matte.id_of(one), one.share);
    const std::vector<IdCoverage> ranks = seen.ranked(1);
    for (int y = pixels_.y0; y < pixels_.y1; ++y)
      for (int x = pixels_.x0; x < pixels_.x1; ++x) matte.set(x, y, ranks);
  }

  void add(Matte& matte, const MatteSamples& samples) const {
    struct Pixel {
      RankedCoverage seen;
      double weight = 0;
    };
    std::vector<Pixel> sums(size_t(pixels_.width()) * pixels_.height());
    const auto sum_at = [&](int x, int y) -> Pixel& {
      return sums[size_t(y - pixels_.y0) * pixels_.width() + (x - pixels_.x0)];
    };
    samples.for_each([&](const Vec2& raster, const SeenSurface* seen, const SeenSurface* end) {
      const auto weigh = [&](int x, int y, int count, const double* values, double weight) {
        for (int i = 0; i < count / 3; ++i) {
          Pixel& pixel = sum_at(x + i, y);
          const double w = values[3 * i] * weight;
          pixel.weight += w;
          for (const SeenSurface* one = seen; one != end; ++one)
            pixel.seen.add(matte.id_of(*one), w * one->share);
        }
      };
      splat(filter(), raster, Color(1), pixels_, weigh);
    });
    for (int y = pixels_.y0; y < pixels_.y1; ++y)
      for (int x = pixels_.x0; x < pixels_.x1; ++x)
        matte.set(x, y, sum_at(x, y).seen.ranked(sum_at(x, y).weight));
  }

  const Scene& scene_;
  PixelRect pixels_;
};

}  // namespace

uint32_t cryptomatte_id(const std::string& name) {
  const uint32_t hash = murmur3(name);
  const uint32_t exponent = std::clamp(hash >> 23 & 255u, 1u, 254u);
  return (hash & 0x807fffffu) | exponent << 23;
}

float as_pixel(uint32_t id) {
  float pixel;
  std::memcpy(&pixel, &id, sizeof(pixel));
  return pixel;
}

std::vector<std::string> cryptomatte_layers(const Aov& aov) {
  std::vector<std::string> names;
  for (int first = 0; first < aov.levels; first += 2)
    names.push_back(fmt::format("{}{:02}", aov.name, first / 2));
  return names;
}

std::vector<std::string> cryptomatte_names(AovKind kind, const SurfaceNames& names) {
  std::vector<std::string> unique;
  std::set<std::string> seen{""};
  for (const std::string& name : all_names(kind, names))
    if (seen.insert(name).second) unique.push_back(name);
  return unique;
}

std::vector<NamedImage> render_cryptomattes(const Scene& scene, const std::vector<Aov>& aovs,
                                            const SurfaceNames& names, uint64_t seed, int threads) {
  const Vec2i size = scene.camera().raster().size;
  std::vector<Matte> mattes;
  for (const Aov& aov : aovs)
    if (is_cryptomatte(aov.kind)) mattes.emplace_back(aov, names, size);
  if (mattes.empty()) return {};
  constexpr int side = SampleFilm::tile_size;
  const uint64_t columns = (size.x + side - 1) / side, rows = (size.y + side - 1) / side;
  parallel_for(threads, columns * rows, [&](uint64_t tile) {
    const int x = static_cast<int>(tile % columns) * side;
    const int y = static_cast<int>(tile / columns) * side;
    const PixelRect pixels{x, y, std::min(x + side, size.x), std::min(y + side, size.y)};
    MatteTile(scene, pixels).render(mattes, seed);
  });
  std::vector<NamedImage> layers;
  for (Matte& matte : mattes)
    for (NamedImage& layer : matte.layers()) layers.push_back(std::move(layer));
  return layers;
}

}  // namespace mlt
