// The film that divides by expected weights: right in the mean everywhere, at the borders of the
// image too; the same bits in any order; and safe against damaged bytes.
#include "filters.h"
#include "image/sample_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <numeric>

#include "base/bytes.h"
#include "base/parallel.h"
#include "base/rng.h"
#include "harness/statistics.h"

namespace mlt {
namespace {

constexpr double alpha = 1e-4;
constexpr int width = 37, height = 34;  // four tiles and more
using FilterPtr = std::shared_ptr<const Filter>;
using Radiance = std::function<Color(const Vec2&)>;

FilterPtr shared(Filter filter) { return std::make_shared<const Filter>(std::move(filter)); }

std::vector<FilterPtr> all_filters() {
  std::vector<FilterPtr> filters;
  for (const Filter& filter : test::default_filters()) filters.push_back(shared(filter));
  filters.push_back(shared(box_filter(1.25)));
  filters.push_back(shared(tent_filter(0.7)));
  return filters;
}

std::string describe(const Filter& filter) {
  return filter.name() + " " + std::to_string(filter.radius());
}

/// One tile with n x n jittered samples in each of its cells that `wanted` names.
template <class Wanted>
SampleFilm::Tile sampled_tile(const SampleFilm& film, int tile, int n, const Radiance& radiance,
                              Rng& rng, const Wanted& wanted) {
  SampleFilm::Tile data = film.begin(tile);
  const PixelRect& cells = data.cells();
  for (int y = cells.y0; y < cells.y1; ++y)
    for (int x = cells.x0; x < cells.x1; ++x) {
      if (!wanted(x, y)) continue;
      for (int i = 0; i < n * n; ++i) {
        const Vec2 at(x + (i % n + rng.next()) / n, y + (i / n + rng.next()) / n);
        data.add(at, radiance(at));
      }
    }
  return data;
}

SampleFilm::Tile sampled_tile(const SampleFilm& film, int tile, int n, const Radiance& radiance,
                              Rng& rng) {
  return sampled_tile(film, tile, n, radiance, rng, [](int, int) { return true; });
}

Color white(const Vec2&) { return Color(1); }

/// Independent images of a scene; `side[tile]`^2 samples in each cell of a tile.
std::vector<Image> images(const FilterPtr& filter, const std::vector<int>& side,
                          const Radiance& radiance, int runs = 16) {
  std::vector<Image> images;
  for (int run = 0; run < runs; ++run) {
    SampleFilm film(width, height, filter, 1);
    Rng rng(61, Purpose::test, static_cast<uint64_t>(run));
    uint64_t order = 0;
    for (int tile = 0; tile < film.tile_count(); ++tile)
      if (const int n = side[tile % side.size()]; n > 0)
        film.commit(0, order++, tile, sampled_tile(film, tile, n, radiance, rng), n * n);
    images.push_back(film.image());
  }
  return images;
}

/// The smallest of Holm's p-values: the mean of each pixel that is `wanted`, and of each side,
/// corner and the middle, against what they should be.
double mean_p_value(
    const std::vector<Image>& images, const std::function<double(int x, int y)>& expected,
    const std::function<bool(int x, int y)>& wanted = [](int, int) { return true; }) {
  std::vector<test::Moments> pixels, regions(9);
  std::vector<double> region_size(9);
  const auto region = [](int x, int y) {
    const auto third = [](int i, int size) { return i < 2 ? 0 : i >= size - 2 ? 2 : 1; };
    return third(x, width) + 3 * third(y, height);
  };
  std::vector<std::vector<double>> region_errors(images.size(), std::vector<double>(9));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (!wanted(x, y)) continue;
      pixels.emplace_back();
      ++region_size[region(x, y)];
      for (size_t i = 0; i < images.size(); ++i) {
        const double error = images[i].at(x, y, 0) - expected(x, y);
        pixels.back().add(error);
        region_errors[i][region(x, y)] += error;
      }
    }
  for (const auto& errors : region_errors)
    for (int r = 0; r < 9; ++r)
      if (region_size[r] > 0) regions[r].add(errors[r] / region_size[r]);
  std::vector<double> p;
  // Where jittered samples meet the edge of a box there is no noise, only the rounding of less than
  // 1024 float additions to each pixel, which a t-test would take for bias.
  for (const auto* family : {&pixels, &regions})
    for (const test::Moments& m : *family)
      if (m.count() > 1)
        p.push_back(std::abs(m.mean()) < 1024 * 0x1p-24 ? 1.0 : test::one_sample_t_test(m).p_value);
  const std::vector<double> adjusted = test::holm_adjusted(p);
  return *std::min_element(adjusted.begin(), adjusted.end());
}

double one(int, int) { return 1; }

// ---- radiance

TEST(SampleFilm, BoxKeepsAConstantExactly) {
  for (const Image& image : images(shared(box_filter()), {3, 1, 2}, white, 2))
    for (const float value : image.data) ASSERT_EQ(value, 1.0f);
}

TEST(SampleFilm, ConstantsStayConstantUpToTheBorders) {
  for (const FilterPtr& filter : all_filters())
    EXPECT_GT(mean_p_value(images(filter, {5}, white), one), alpha) << describe(*filter);
}

TEST(SampleFilm, ConstantsStayConstantWhenTilesHaveDifferentSampleCounts) {
  for (const FilterPtr& filter : all_filters())
    EXPECT_GT(mean_p_value(images(filter, {4, 5, 6, 8, 3}, white), one), alpha)
        << describe(*filter);
}

TEST(SampleFilm, ARampKeepsItsPlace) {
  // A symmetric filter leaves a linear function as it is; cells beyond the border carry it on.
  for (const FilterPtr& filter : all_filters())
    EXPECT_GT(mean_p_value(images(filter, {5}, [](const Vec2& p) { return Color(p.x + 2 * p.y); }),
                           [](int x, int y) { return x + 0.5 + 2 * (y + 0.5); }),
              alpha)
        << describe(*filter);
}

TEST(SampleFilm, TheTestFindsAShiftOfOnePercentOfAPixel) {
  EXPECT_LT(mean_p_value(
                images(shared(tent_filter()), {5}, [](const Vec2& p) { return Color(p.x + 0.01); }),
                [](int x, int) { return x + 0.5; }),
            alpha);
}

TEST(SampleFilm, TheTestFindsCellsBeyondTheBorderThatAreLeftOut) {
  for (const FilterPtr& filter : all_filters()) {
    if (filter_border(*filter) == 0) continue;
    std::vector<Image> clipped;
    for (uint64_t run = 0; run < 16; ++run) {
      SampleFilm film(width, height, filter, 1);
      Rng rng(62, Purpose::test, run);
      for (int tile = 0; tile < film.tile_count(); ++tile)
        film.commit(
            0, static_cast<uint64_t>(tile), tile,
            sampled_tile(film, tile, 5, white, rng,
                         [](int x, int y) { return x >= 0 && y >= 0 && x < width && y < height; }),
            25);
      clipped.push_back(film.image());
    }
    EXPECT_LT(mean_p_value(clipped, one), alpha) << describe(*filter);
  }
}

TEST(SampleFilm, APartOfAPassIsUnbiasedWhereItHasBeen) {
  for (const FilterPtr& filter : all_filters()) {
    SampleFilm film(width, height, filter, 1);
    const PixelRect cells = film.begin(0).cells();
    std::vector<int> side(film.tile_count(), 0);
    side[0] = 5;
    const auto inside = [&](int x, int y) { return x < cells.x1 && y < cells.y1; };
    const std::vector<Image> part = images(filter, side, white);
    EXPECT_GT(mean_p_value(part, one, inside), alpha) << describe(*filter);
    const int reach = cells.x1 + filter_border(*filter);
    for (int y = 0; y < height; ++y)
      for (int x = reach; x < width; ++x) EXPECT_EQ(part[0].at(x, y, 1), 0);
  }
}

TEST(SampleFilm, NothingIsBlack) {
  const SampleFilm film(5, 4, shared(gaussian_filter()), 2);
  for (const float value : film.image().data) EXPECT_EQ(value, 0);
  EXPECT_EQ(film.splat_scale(), 0);
}

TEST(SampleFilm, TheCellsOfAllTilesCoverTheImageAndItsBorderOnce) {
  for (const FilterPtr& filter : all_filters()) {
    const int border = filter_border(*filter);
    EXPECT_GE(border, filter->radius() - 0.5);
    SampleFilm film(width, height, filter, 1);
    std::vector<int> covered((width + 2 * border) * (height + 2 * border));
    for (int tile = 0; tile < film.tile_count(); ++tile) {
      const PixelRect cells = film.begin(tile).cells();
      for (int y = cells.y0; y < cells.y1; ++y)
        for (int x = cells.x0; x < cells.x1; ++x)
          ++covered.at((y + border) * (width + 2 * border) + x + border);
    }
    for (const int count : covered) ASSERT_EQ(count, 1);
  }
}

// ---- groups

TEST(SampleFilm, GroupsAreWeightedByTheirSamples) {
  SampleFilm film(width, height, shared(box_filter()), 2);
  Rng rng(63, Purpose::test, 0);
  for (int tile = 0; tile < film.tile_count(); ++tile) {
    const auto order = static_cast<uint64_t>(tile);
    film.commit(0, order, tile, sampled_tile(film, tile, 1, white, rng), 1);
    film.commit(1, order, tile,
                sampled_tile(film, tile, 2, [](const Vec2&) { return Color(3); }, rng), 4);
  }
  EXPECT_EQ(film.group_count(), 2);
  EXPECT_EQ(film.group_image(0).at(3, 3, 0), 1.0f);
  EXPECT_EQ(film.group_image(1).at(3, 3, 0), 3.0f);
  EXPECT_EQ(film.image().at(3, 3, 0), static_cast<float>((1 + 4 * 3.0) / 5));
}

// ---- splats

int cell_count(const SampleFilm& film) {
  int cells = 0;
  for (int tile = 0; tile < film.tile_count(); ++tile) {
    const PixelRect rect = film.begin(tile).cells();
    cells += rect.width() * rect.height();
  }
  return cells;
}

TEST(SampleFilm, ASplatHasTheShapeOfTheFilterAndIsDividedByTheNumberOfWalks) {
  const Color color(2, 0.5, 8);
  for (const FilterPtr& filter : all_filters())
    for (const Vec2& at :
         {Vec2(17.3, 12.8), Vec2(0.2, 33.9), Vec2(-0.3, 5.5), Vec2(31.99, 32.01)}) {
      SampleFilm film(width, height, filter, 1);
      constexpr int samples = 3;
      for (int tile = 0; tile < film.tile_count(); ++tile) {
        SampleFilm::Tile data = film.begin(tile);
        if (tile == 1) data.splat(at, color);  // from any tile, anywhere
        film.commit(0, static_cast<uint64_t>(tile), tile, std::move(data), samples);
      }
      const double walks = static_cast<double>(samples) * cell_count(film);
      const double scale = width * height / walks;
      EXPECT_DOUBLE_EQ(film.splat_scale(), scale);
      const Image image = film.image();
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          for (int c = 0; c < 3; ++c) {
            const double h = filter->eval(x + 0.5 - at.x) * filter->eval(y + 0.5 - at.y);
            const double expected = color[c] * h * scale;
            ASSERT_NEAR(image.at(x, y, c), expected, 1e-6 * std::abs(expected))
                << describe(*filter);
          }
    }
}

TEST(SampleFilm, WalksThatReachEverythingAlikeMakeAConstant) {
  // Each walk ends at a uniform position over the image and its border, of area A: with importance
  // 1 / (width * height) over the density 1 / A, the contribution is A / (width * height).
  for (const FilterPtr& filter : all_filters()) {
    const double r = filter->radius();
    const Vec2 size(width + 2 * r, height + 2 * r);
    const Color contribution(size.x * size.y / (width * height));
    std::vector<Image> results;
    for (uint64_t run = 0; run < 64; ++run) {
      SampleFilm film(width, height, filter, 1);
      Rng rng(64, Purpose::test, run);
      uint64_t order = 0;
      for (int tile = 0; tile < film.tile_count(); ++tile) {
        SampleFilm::Tile data = film.begin(tile);
        constexpr int samples = 8;
        for (int i = 0; i < samples * data.cells().width() * data.cells().height(); ++i) {
          const double x = rng.next() * size.x - r, y = rng.next() * size.y - r;
          data.splat({x, y}, contribution);
        }
        film.commit(0, order++, tile, std::move(data), samples);
      }
      results.push_back(film.image());
    }
    EXPECT_GT(mean_p_value(results, one), alpha) << describe(*filter);
    EXPECT_LT(mean_p_value(results, [](int, int) { return 1.01; }), alpha) << "no power";
  }
}

TEST(SampleFilm, SamplesAndSplatsAddUp) {
  SampleFilm film(8, 8, shared(box_filter()), 1);
  SampleFilm::Tile data = film.begin(0);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) data.add(Vec2(x + 0.5, y + 0.5), Color(1));
  data.splat({2.5, 3.5}, Color(4));
  film.commit(0, 0, 0, std::move(data), 1);
  EXPECT_EQ(film.image().at(0, 0, 0), 1.0f);
  EXPECT_EQ(film.image().at(2, 3, 0), 5.0f);
}

// ---- order

struct Unit {
  int group;
  uint64_t order;
  int tile;
};

std::vector<Unit> all_units(const SampleFilm& film, int passes) {
  std::vector<Unit> units;
  for (int group = 0; group < film.group_count(); ++group)
    for (int i = 0; i < passes * film.tile_count(); ++i)
      units.push_back({group, static_cast<uint64_t>(i), i % film.tile_count()});
  return units;
}

/// The tile that the unit makes: its numbers depend on group and order alone.
SampleFilm::Tile make(const SampleFilm& film, const Unit& unit) {
  Rng rng(65, Purpose::test, unit.order * 16 + unit.group);
  SampleFilm::Tile data = sampled_tile(
      film, unit.tile, 1,
      [&](const Vec2&) { return Color(rng.next(), 1e3 * rng.next(), rng.next()); }, rng);
  for (int i = 0; i < 50; ++i)
    data.splat({rng.next() * width, rng.next() * height}, Color(rng.next()));
  return data;
}

SampleFilm test_film() { return SampleFilm(width, height, shared(mitchell_filter()), 2); }

std::string bytes_of(const SampleFilm& film) { return film.save(film.everything()); }

void commit(SampleFilm& film, const Unit& unit) {
  film.commit(unit.group, unit.order, unit.tile, make(film, unit), 1);
}

void shuffle(std::vector<Unit>& units, uint64_t stream) {
  Rng rng(66, Purpose::test, stream);
  for (size_t i = units.size(); i > 1; --i) std::swap(units[i - 1], units[rng.below(i)]);
}

TEST(SampleFilm, HasTheSameBitsInAnyOrder) {
  SampleFilm in_order = test_film();
  std::vector<Unit> units = all_units(in_order, 5);
  for (const Unit& unit : units) commit(in_order, unit);
  for (uint64_t stream = 0; stream < 5; ++stream) {
    SampleFilm film = test_film();
    shuffle(units, stream);
    for (const Unit& unit : units) commit(film, unit);
    EXPECT_TRUE(film.image() == in_order.image());
    EXPECT_EQ(bytes_of(film), bytes_of(in_order));
  }
}

TEST(SampleFilm, HasTheSameBitsForAnyNumberOfThreads) {
  SampleFilm in_order = test_film();
  std::vector<Unit> units = all_units(in_order, 5);
  for (const Unit& unit : units) commit(in_order, unit);
  for (const int threads : {1, 2, 3, 4}) {
    SampleFilm film = test_film();
    parallel_for(threads, units.size(), [&](uint64_t i) {
      commit(film, units[i]);
      if (i % 7 == 0) film.image();  // a look in between does no harm
    });
    EXPECT_EQ(bytes_of(film), bytes_of(in_order));
  }
}

TEST(SampleFilm, TheBitsDoDependOnTheOrderThatIsGiven) {
  SampleFilm in_order = test_film(), backwards = test_film();
  const std::vector<Unit> units = all_units(in_order, 5);
  const uint64_t last = units.back().order;
  for (const Unit& unit : units) {
    commit(in_order, unit);
    backwards.commit(unit.group, last - unit.order, unit.tile, make(backwards, unit), 1);
  }
  EXPECT_FALSE(backwards.image() == in_order.image());
}

TEST(SampleFilm, AddsATileWhenAllBeforeItAreThere) {
  SampleFilm film = test_film();
  const Image black = film.image();
  commit(film, {0, 1, 1});
  EXPECT_TRUE(film.image() == black);
  commit(film, {0, 0, 0});
  EXPECT_FALSE(film.image() == black);
  EXPECT_TRUE(film.group_image(1) == black);
}

// ---- bytes

TEST(SampleFilm, GoesOnFromItsBytesAsIfNothingHadHappened) {
  SampleFilm whole = test_film(), first = test_film(), second = test_film();
  const std::vector<Unit> units = all_units(whole, 4);
  for (const Unit& unit : units) commit(whole, unit);
  for (const Unit& unit : units)
    if (unit.order < 7) commit(first, unit);
  second.load(bytes_of(first), second.everything());
  EXPECT_TRUE(second.image() == first.image());
  for (const Unit& unit : units)
    if (unit.order >= 7) commit(second, unit);
  EXPECT_TRUE(second.image() == whole.image());
  EXPECT_EQ(bytes_of(second), bytes_of(whole));
}

TEST(SampleFilm, AnEmptyFilmCanBeSaved) {
  SampleFilm film = test_film();
  film.load(bytes_of(test_film()), film.everything());
  commit(film, {0, 0, 0});
  EXPECT_NE(film.image().at(5, 5, 0), 0);
}

TEST(SampleFilm, IsNotSavedWhileTilesAreMissing) {
  SampleFilm film = test_film();
  commit(film, {0, 1, 1});
  EXPECT_THROW(bytes_of(film), RenderError);
  commit(film, {0, 0, 0});
  EXPECT_NO_THROW(bytes_of(film));
}

TEST(SampleFilm, RefusesDamagedBytesAndStaysAsItWas) {
  SampleFilm saved = test_film(), film = test_film();
  for (const Unit& unit : all_units(saved, 1)) commit(saved, unit);
  commit(film, {0, 0, 0});
  const std::string bytes = bytes_of(saved), before = bytes_of(film);
  const auto refuses = [&](const std::string& damaged) {
    EXPECT_THROW(film.load(damaged, film.everything()), RenderError);
    ASSERT_EQ(bytes_of(film), before);
  };
  refuses("");
  for (size_t size = 0; size < bytes.size(); size += 97) refuses(bytes.substr(0, size));
  refuses(bytes.substr(0, bytes.size() - 1));
  refuses(bytes + '\0');
  refuses(bytes_of(SampleFilm(width + 1, height, shared(mitchell_filter()), 2)));
  refuses(bytes_of(SampleFilm(width, height, shared(mitchell_filter()), 1)));
  refuses(bytes_of(SampleFilm(width, height, shared(mitchell_filter()), 3)));
  // Each count, made too small and much too large.
  const size_t head = sizeof(PixelRect) + sizeof(uint64_t);
  ByteWriter sums_of_tile;
  SampleSums().save(sums_of_tile);
  const size_t sums = saved.tile_count() * sums_of_tile.take().size();
  size_t at = head;
  for (int group = 0; group < 2; ++group, at += sums + head)
    for (const size_t element : {sizeof(float), sizeof(float), sizeof(uint64_t)}) {
      uint64_t size;
      std::memcpy(&size, &bytes[at], sizeof size);
      for (const uint64_t wrong : {size - 1, size + 1, uint64_t{1} << 62}) {
        std::string damaged = bytes;
        std::memcpy(&damaged[at], &wrong, sizeof wrong);
        refuses(damaged);
      }
      at += sizeof size + size * element;
    }
  film.load(bytes, film.everything());
  EXPECT_EQ(bytes_of(film), bytes);
}

}  // namespace
}  // namespace mlt
