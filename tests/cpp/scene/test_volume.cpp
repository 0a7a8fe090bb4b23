// Grids: their values, what lies along a line through them, and where a flight ends.
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/rng.h"
#include "scene/volume/grid_volume.h"
#include "scene/volume/grid_walk.h"
#include "scene/volume/vol_file.h"
#include "shape_testing.h"

#include <algorithm>
#include <cstring>

namespace mlt {
namespace {

using shape_testing::error_of;

/// Values of which most are 0, in clusters, some of which end where a brick does.
GridData sparse_grid(std::array<int, 3> size, int channels, uint64_t seed) {
  Rng rng(seed, Purpose::test, 0);
  GridData grid{size, channels, {}};
  for (int z = 0; z < size[2]; ++z)
    for (int y = 0; y < size[1]; ++y)
      for (int x = 0; x < size[0]; ++x)
        for (int c = 0; c < channels; ++c) {
          const bool full = x % 12 < 4 && y % 13 < 6 && z % 9 < 4;
          grid.values.push_back(full ? static_cast<float>(rng.next()) : 0.0f);
        }
  return grid;
}

/// A value by its definition: value (i, j, k) is that at (i, j, k) + 1/2.
Color naive_value(const GridData& grid, bool nearest, const Vec3& x) {
  const auto stored = [&](int i, int j, int k) {
    const auto clamped = [&](int n, int axis) { return std::clamp(n, 0, grid.size[axis] - 1); };
    const size_t at =
        (size_t(clamped(k, 2)) * grid.size[1] + clamped(j, 1)) * grid.size[0] + clamped(i, 0);
    Color value;
    for (int c = 0; c < 3; ++c) value[c] = grid.values[at * grid.channels + c % grid.channels];
    return value;
  };
  for (int axis = 0; axis < 3; ++axis)
    if (x[axis] < 0 || x[axis] > grid.size[axis]) return Color(0);
  if (nearest) return stored(int(x.x), int(x.y), int(x.z));
  const Vec3 low = glm::floor(x - 0.5), f = x - 0.5 - low;
  Color sum(0);
  for (int i = 0; i < 8; ++i)
    sum += stored(int(low.x) + (i & 1), int(low.y) + (i >> 1 & 1), int(low.z) + (i >> 2 & 1)) *
           ((i & 1 ? f.x : 1 - f.x) * (i & 2 ? f.y : 1 - f.y) * (i & 4 ? f.z : 1 - f.z));
  return sum;
}

struct Case {
  std::array<int, 3> size;
  int channels;
  bool nearest;
};

class GridOf : public testing::TestWithParam<Case> {
 protected:
  GridData data() const { return sparse_grid(GetParam().size, GetParam().channels, 1); }
  /// Its box is that of its values, so that lengths are those of cells.
  GridVolume volume() const {
    const auto& n = GetParam().size;
    Mat4 to_world(1);
    for (int axis = 0; axis < 3; ++axis) to_world[axis][axis] = n[axis];
    return GridVolume(Grid(data(), GetParam().nearest, "a grid"), to_world);
  }
  /// A ray from outside of the grid or from within it.
  Ray ray(Rng& rng) const {
    const auto& n = GetParam().size;
    const Vec3 size(n[0], n[1], n[2]);
    const auto point = [&] {
      return size * (Vec3(rng.next(), rng.next(), rng.next()) * 1.6 - 0.3);
    };
    Ray ray{point(), {0, 0, 1}};
    Vec3 d = point() - ray.o;
    if (const int kind = static_cast<int>(8 * rng.next()); kind < 3) {  // along an axis
      d = Vec3(0);
      d[kind] = rng.next() < 0.5 ? -1 : 1;
    }
    ray.d = normalize(d);
    return ray;
  }
};

TEST_P(GridOf, HasItsValues) {
  const GridVolume volume = this->volume();
  const GridData data = this->data();
  Rng rng(2, Purpose::test, 0);
  for (int i = 0; i < 5000; ++i) {
    const auto& n = data.size;
    const Vec3 x = Vec3(n[0], n[1], n[2]) * (Vec3(rng.next(), rng.next(), rng.next()) * 1.2 - 0.1);
    const Color expected = naive_value(data, GetParam().nearest, x),
                found = volume.at(x, rgb_lanes).rgb();
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], expected[c], 1e-12);
  }
}

/// The sum over many short steps, in whose middles the value is read. Where the line crosses a
/// border of values, or of the grid, it is wrong by half a step times their difference at most.
TEST_P(GridOf, IsIntegratedAlongLines) {
  const GridVolume volume = this->volume();
  const GridData data = this->data();
  Rng rng(3, Purpose::test, 0);
  constexpr double distance = 60, step = 1. / 128;
  constexpr int lines = 30, steps = int(distance / step);
  int lit = 0;
  for (int i = 0; i < lines; ++i) {
    const Ray ray = this->ray(rng);
    Color sum(0), last(0), variation(0);
    for (int k = 0; k < steps; ++k) {
      const Color value = naive_value(data, GetParam().nearest, ray.o + (k + 0.5) * step * ray.d);
      sum += step * value;
      variation += glm::abs(value - last);
      last = value;
    }
    const Flight flight = volume.fly(ray, {distance}, 2);
    EXPECT_FALSE(flight.stops);
    EXPECT_EQ(flight.distance, distance);
    lit += sum.x > 0;
    for (int c = 0; c < 3; ++c) {
      const double borders = GetParam().nearest ? variation[c] / 2 : 1;  // in or out of the grid
      ASSERT_NEAR(flight.depth[c], 2 * sum[c], 2 * step * borders + 1e-3) << i;
    }
  }
  EXPECT_GT(lit, lines / 4);
}

TEST_P(GridOf, StopsFlightsWhereEnoughIsLost) {
  const GridVolume volume = this->volume();
  Rng rng(4, Purpose::test, 0);
  int stopped = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray = this->ray(rng);
    const Spectrum before(Color(0.2 + rng.next(), 0.2 + rng.next(), 0.2 + rng.next()));
    const FlightLimit limit{infinity, before, mean(before) * rng.next()};
    const Flight flight = volume.fly(ray, limit, 3);
    const Spectrum all = volume.fly(ray, {infinity}, 3).depth;
    ASSERT_EQ(flight.stops, limit.ends(all));
    if (!flight.stops) continue;
    ++stopped;
    EXPECT_NEAR(mean(before * exp(-flight.depth)), limit.left, 1e-12);
    const Spectrum depth = volume.fly(ray, {flight.distance}, 3).depth;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(flight.depth[c], depth[c], 1e-10);
    EXPECT_GT(max_component(volume.at(ray.o + flight.distance * ray.d, rgb_lanes)), 0);
  }
  EXPECT_GT(stopped, 300);
}

/// The cells of a line, one after the other, without gaps; those that are left out are empty.
TEST_P(GridOf, IsWalkedThroughInOrder) {
  const GridData data = this->data();
  const Grid grid(data, GetParam().nearest, "a grid");
  Rng rng(5, Purpose::test, 0);
  for (int i = 0; i < 500; ++i) {
    const Ray ray = this->ray(rng);
    double last = 0;
    GridWalk(grid, ray.o + grid.low(), ray.d, infinity)
        .run([&](const Grid::Index& cell, double from, double to) {
          EXPECT_LE(last, from);
          EXPECT_LT(from, to);
          const Vec3 middle = ray.o + 0.5 * (from + to) * ray.d;
          for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(middle[axis], cell[axis] - grid.low() - 1e-9);
            EXPECT_LE(middle[axis], cell[axis] - grid.low() + 1 + 1e-9);
          }
          for (double t = last + 1e-6; t < from - 1e-6; t += 0.5)
            EXPECT_TRUE(is_black(naive_value(data, GetParam().nearest, ray.o + t * ray.d)));
          last = to;
          return true;
        });
  }
}

INSTANTIATE_TEST_SUITE_P(Grids, GridOf,
                         testing::Values(Case{{40, 27, 33}, 1, false}, Case{{40, 27, 33}, 1, true},
                                         Case{{19, 1, 23}, 3, false}, Case{{9, 20, 2}, 3, true},
                                         Case{{1, 1, 1}, 1, false}));

/// A few values far from each other, and the larger cubes that are empty around them.
class GridOfFewValues : public testing::TestWithParam<bool> {
 protected:
  bool nearest() const { return GetParam(); }
  const GridData& data() const { return data_; }
  Grid grid() const { return Grid(data_, nearest(), "a grid"); }

 private:
  static GridData few_values() {
    GridData data{{70, 45, 50}, 1, std::vector<float>(70 * 45 * 50)};
    const Grid::Index places[] = {{3, 41, 5}, {32, 31, 15}, {63, 16, 40}, {50, 7, 31}};
    for (const auto& [x, y, z] : places)
      for (int i = 0; i < 3; ++i) data.values[(z * 45 + y) * 70 + x + i] = 5;
    return data;
  }
  GridData data_ = few_values();
};

TEST_P(GridOfFewValues, KnowsItsLargestEmptyCubes) {
  const Grid grid = this->grid();
  std::vector<bool> is_empty;  // of each cell: whether the values around it are 0
  for (int z = 0; z < grid.cells(2); ++z)
    for (int y = 0; y < grid.cells(1); ++y)
      for (int x = 0; x < grid.cells(0); ++x) {
        const Vec3 cell(x, y, z);
        double sum = 0;
        for (int i = 0; i < (nearest() ? 1 : 8); ++i) {
          const Vec3 value = cell - Vec3(i & 1, i >> 1 & 1, i >> 2 & 1);
          sum += naive_value(data(), true, value + 0.5).x;
        }
        is_empty.push_back(sum == 0);
      }
  const auto cube_is_empty = [&](const Grid::Index& in, int edge) {
    Grid::Index begin, end;
    for (int axis = 0; axis < 3; ++axis) {
      begin[axis] = in[axis] / edge * edge;
      end[axis] = std::min(begin[axis] + edge, grid.cells(axis));
    }
    for (int z = begin[2]; z < end[2]; ++z)
      for (int y = begin[1]; y < end[1]; ++y)
        for (int x = begin[0]; x < end[0]; ++x)
          if (!is_empty[(z * grid.cells(1) + y) * grid.cells(0) + x]) return false;
    return true;
  };
  std::array<int, 33> found{};
  for (int z = 0; z < grid.cells(2); z += 4)
    for (int y = 0; y < grid.cells(1); y += 4)
      for (int x = 0; x < grid.cells(0); x += 4) {
        int edge = 32;
        while (edge >= 4 && !cube_is_empty({x, y, z}, edge)) edge /= 2;
        if (edge < 4) edge = 0;
        EXPECT_EQ(grid.empty_cube({x, y, z}), edge) << x << " " << y << " " << z;
        ++found[edge];
      }
  for (const int edge : {0, 4, 8, 16, 32}) EXPECT_GT(found[edge], 0) << edge;
}

/// The sum over short steps along lines that pass near a value.
TEST_P(GridOfFewValues, LosesNothingBetweenEmptyCubes) {
  Mat4 to_world(1);
  for (int axis = 0; axis < 3; ++axis) to_world[axis][axis] = data().size[axis];
  const GridVolume volume(grid(), to_world);
  Rng rng(6, Purpose::test, 0);
  constexpr double step = 1. / 128, distance = 180;
  const auto uniform = [&] { return Vec3(rng.next(), rng.next(), rng.next()); };
  for (int i = 0; i < 40; ++i) {
    const Vec3 targets[] = {{4, 41, 5}, {33, 31, 15}, {64, 16, 40}, {51, 7, 31}};
    const Vec3 to = targets[i % 4] + Vec3(0.5) + 0.5 * (uniform() - 0.5);
    Ray ray{Vec3(70, 45, 50) * (1.6 * uniform() - 0.3), {0, 0, 1}};
    ray.d = normalize(to - ray.o);
    double sum = 0;
    for (int k = 0; k < int(distance / step); ++k)
      sum += step * naive_value(data(), nearest(), ray.o + (k + 0.5) * step * ray.d).x;
    EXPECT_GT(sum, 0.5);
    EXPECT_NEAR(volume.fly(ray, {distance}, 1).depth[0], sum, nearest() ? 10 * step : 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Grids, GridOfFewValues, testing::Bool());

TEST(Grid, SkipsAllOfAGridOfNothing) {
  const GridVolume volume(Grid({{3, 4, 5}, 1, std::vector<float>(60)}, false, "smoke"), Mat4(1));
  const Ray ray{{0.5, 0.4, -1}, {0, 0, 1}};
  EXPECT_EQ(volume.fly(ray, {infinity}, 1).depth[0], 0);
  EXPECT_FALSE(volume.fly(ray, {infinity, Spectrum(1), 1e-9}, 1).stops);
}

TEST(Grid, RefusesWhatIsNoExtinction) {
  GridData grid = sparse_grid({4, 5, 6}, 1, 1);
  grid.values[(3 * 5 + 2) * 4 + 1] = -1;
  EXPECT_NE(error_of([&] {
              Grid(grid, false, "smoke");
            }).find("smoke: the value at x = 1, y = 2, z = 3 is -1"),
            std::string::npos);
  grid.values[(3 * 5 + 2) * 4 + 1] = std::nanf("");
  EXPECT_NE(error_of([&] { Grid(grid, false, "smoke"); }).find("x = 1, y = 2, z = 3 is nan"),
            std::string::npos);
}

TEST(Grid, TakesSubnormalValuesAsNothing) {
  GridData data{{2, 1, 1}, 1, {-1e-45f, 3e-39f}};
  const GridVolume volume(Grid(data, true, "smoke"), Mat4(1));
  EXPECT_EQ(volume.maximum(), Color(0));
  for (const double x : {0.2, 0.7}) EXPECT_EQ(volume.at({x, 0.5, 0.5}, mlt::rgb_lanes)[0], 0);
  data.values = {-1e-37f, 0};
  EXPECT_NE(error_of([&] { Grid(data, true, "smoke"); }).find("not negative"), std::string::npos);
  data.values = {0, std::numeric_limits<float>::infinity()};
  EXPECT_NE(error_of([&] { Grid(data, true, "smoke"); }).find("x = 1, y = 0, z = 0 is inf"),
            std::string::npos);
}

TEST(Grid, RefusesAPlaceThatHasNoVolume) {
  const Grid grid(sparse_grid({4, 5, 6}, 1, 1), false, "smoke");
  for (const double scale : {0.0, 1e-40, 1e200 * 1e200, double{std::nanf("")}})
    EXPECT_NE(error_of([&] { GridVolume(grid, Mat4(scale)); }).find("is flat"), std::string::npos);
}

std::string vol(int version, int32_t encoding, std::array<int32_t, 4> size,
                const std::string& data) {
  std::string bytes = "VOL";
  bytes += static_cast<char>(version);
  const float box[] = {0, 0, 0, 1, 2, 3};
  bytes.append(reinterpret_cast<const char*>(&encoding), 4);
  bytes.append(reinterpret_cast<const char*>(size.data()), 16);
  bytes.append(reinterpret_cast<const char*>(box), 24);
  return bytes + data;
}

TEST(VolFile, HoldsFloatsHalvesAndBytes) {
  const float floats[] = {0, 0.25f, 0.5f, 1, 2, 3};
  const VolFile file = parse_vol(
      vol(3, 1, {3, 2, 1, 1}, std::string(reinterpret_cast<const char*>(floats), 24)), "a file");
  EXPECT_EQ(file.grid.size, (std::array<int, 3>{3, 2, 1}));
  EXPECT_EQ(file.grid.values, std::vector<float>(floats, floats + 6));
  EXPECT_EQ(file.high, Vec3(1, 2, 3));
  const uint16_t halves[] = {0x3c00, 0x4000, 0x3800};  // 1, 2 and 1/2
  EXPECT_EQ(
      parse_vol(vol(3, 2, {1, 1, 1, 3}, std::string(reinterpret_cast<const char*>(halves), 6)),
                "a file")
          .grid.values,
      (std::vector<float>{1, 2, 0.5f}));
  EXPECT_EQ(parse_vol(vol(3, 3, {1, 2, 1, 1}, std::string("\xff\0", 2)), "a file").grid.values,
            (std::vector<float>{1, 0}));
}

TEST(VolFile, RefusesWhatItIsNot) {
  const auto refusal = [](const std::string& bytes) {
    return error_of([&] { parse_vol(bytes, "smoke.vol"); });
  };
  EXPECT_NE(refusal("VOL").find("is no volume"), std::string::npos);
  EXPECT_NE(refusal(std::string(100, 'x')).find("is no volume"), std::string::npos);
  EXPECT_NE(refusal(vol(2, 1, {1, 1, 1, 1}, "1234")).find("version 2"), std::string::npos);
  EXPECT_NE(refusal(vol(3, 4, {1, 1, 1, 1}, "1234")).find("encoding 4"), std::string::npos);
  EXPECT_NE(
      refusal(vol(3, 1, {2, 1, 1, 1}, "1234")).find("has 52 bytes, but its header promises 56"),
      std::string::npos);
  EXPECT_NE(refusal(vol(3, 1, {1, 1, 1, 2}, "12345678")).find("2 channels"), std::string::npos);
  EXPECT_NE(refusal(vol(3, 1, {-1, 1, 1, 1}, "")).find("-1 x 1 x 1"), std::string::npos);
  // 2^31 values, before any memory is asked for
  EXPECT_NE(refusal(vol(3, 1, {2048, 1024, 1024, 1}, "")).find("fewer than 2^31"),
            std::string::npos);
  EXPECT_NE(refusal(vol(3, 1, {2147483647, 2147483647, 2147483647, 3}, "")).find("fewer than 2^31"),
            std::string::npos);
}

}  // namespace
}  // namespace mlt
