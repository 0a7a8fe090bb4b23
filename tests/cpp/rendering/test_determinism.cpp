// The same pixels for any number of threads, and after a render has been saved and resumed.
#include <gtest/gtest.h>

#include "integrator_testing.h"

namespace mlt {
namespace {

using namespace test;

void expect_equal(const Rendering& a, const Rendering& b) {
  EXPECT_TRUE(a.image() == b.image());
  const auto layers_a = a.layers(), layers_b = b.layers();
  ASSERT_EQ(layers_a.size(), layers_b.size());
  for (size_t i = 0; i < layers_a.size(); ++i) {
    EXPECT_EQ(layers_a[i].name, layers_b[i].name);
    EXPECT_TRUE(layers_a[i].image == layers_b[i].image) << layers_a[i].name;
  }
}

TEST(Render, HasTheSameBitsForAnyNumberOfThreads) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    const auto one = rendered(lights_on_tiles(), made, 5, 5, 1);
    for (const int threads : {2, 3})
      expect_equal(*one, *rendered(lights_on_tiles(), made, 5, 5, threads));
    EXPECT_FALSE(one->image() == rendered(lights_on_tiles(), made, 6, 5)->image())
        << "the seed does not matter";
  }
}

TEST(Render, GoesOnAfterItHasBeenSaved) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    const auto straight = prepared(lights_on_tiles(), made, 7);
    const uint64_t units = straight->plan().unit_count(4);
    run_units(*straight, 0, units);
    const auto first = prepared(lights_on_tiles(), made, 7);
    uint64_t done = 0;
    for (const uint64_t stop : {uint64_t{0}, uint64_t{1}, units / 2 + 1, units}) {
      run_units(*first, done, stop);
      done = stop;
      const auto second = made->start(lights_on_tiles(), 7);
      second->load(first->save());
      EXPECT_EQ(second->plan().unit_count(4), units);
      expect_equal(*first, *second);
      run_units(*second, stop, units, 2);
      expect_equal(*straight, *second);
      EXPECT_EQ(second->save(), straight->save());
    }
  }
}

TEST(Render, CountsTheSameRaysForAnyNumberOfThreadsAndNothingInvalid) {
  for (const Algorithm& algorithm : algorithms()) {
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    Stats one, two;
    rendered(lights_on_tiles(), made, 8, 3, 1)->add_stats(one);
    rendered(lights_on_tiles(), made, 8, 3, 2)->add_stats(two);
    EXPECT_GT(one.rays_intersect, 70u * 40u) << algorithm.name;
    EXPECT_EQ(one.rays_intersect, two.rays_intersect) << algorithm.name;
    EXPECT_EQ(one.rays_occluded, two.rays_occluded) << algorithm.name;
    EXPECT_EQ(one.invalid_samples, 0u) << algorithm.name;
  }
}

TEST(Render, RefusesTheStateOfAnotherImage) {
  for (const Algorithm& algorithm : algorithms()) {
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    const ScenePtr other = make_scene("mixed_lights", with_size(30, 20, "gaussian")).scene;
    const std::string saved = rendered(other, made, 7, 1)->save();
    EXPECT_THROW(made->start(lights_on_tiles(), 7)->load(saved), RenderError) << algorithm.name;
    EXPECT_THROW(made->start(other, 7)->load(saved.substr(0, saved.size() / 2)), RenderError)
        << algorithm.name;
  }
}

}  // namespace
}  // namespace mlt
