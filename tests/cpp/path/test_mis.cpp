// Sums of density quotients that grow along a path, against the densities of all techniques.
#include "path/mis.h"

#include "base/rng.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace mlt {
namespace {

constexpr Heuristic heuristics[] = {Heuristic::balance, Heuristic::power, Heuristic::maximum};

/// Densities of the vertices 0 ... k made by walks from both ends, and how often technique
/// s = 0 ... k + 1 counts.
struct Techniques {
  std::vector<double> from_light, from_camera, count;

  int edges() const { return static_cast<int>(from_light.size()) - 1; }
  double density(int s) const {
    double p = count[s];
    for (int i = 0; i <= edges(); ++i) p *= i < s ? from_light[i] : from_camera[i];
    return p;
  }
  MisWeights weights(int s, Heuristic heuristic) const {
    TechniqueSums below, above;
    for (int i = 0; i < s; ++i) below = below.with(count[i]).over(from_camera[i] / from_light[i]);
    for (int i = edges(); i >= s; --i)
      above = above.with(count[i + 1]).over(from_light[i] / from_camera[i]);
    return mis_weights(count[s], below, above, heuristic);
  }
};

/// One technique in four cannot make the path, and s = 1 chooses x_0 in its own way.
Techniques random_techniques(int edges, Rng& rng) {
  Techniques t;
  const auto density = [&] { return std::exp(20 * (rng.next() - 0.5)); };
  for (int i = 0; i <= edges; ++i) {
    t.from_light.push_back(density());
    t.from_camera.push_back(density());
  }
  for (int s = 0; s <= edges + 1; ++s) t.count.push_back(rng.next() < 0.25 ? 0 : 1);
  if (t.count[1] > 0) t.count[1] = density();
  return t;
}

TEST(Mis, SumsThatGrowAlongAPathGiveTheWeightsOfAllDensities) {
  Rng rng(1, Purpose::test, 0);
  int tested = 0;
  for (int n = 0; n < 2000; ++n) {
    const int edges = 1 + static_cast<int>(rng.below(12));
    const Techniques t = random_techniques(edges, rng);
    std::vector<double> p;
    for (int s = 0; s <= edges + 1; ++s) p.push_back(t.density(s));
    const double sum = std::accumulate(p.begin(), p.end(), 0.0);
    const double squares = std::inner_product(p.begin(), p.end(), p.begin(), 0.0);
    const auto largest = std::max_element(p.begin(), p.end()) - p.begin();
    for (int s = 0; s <= edges + 1; ++s) {
      if (p[s] == 0) continue;
      ++tested;
      EXPECT_NEAR(t.weights(s, Heuristic::balance).chosen / (p[s] / sum), 1, 1e-12);
      EXPECT_NEAR(t.weights(s, Heuristic::power).chosen / (p[s] * p[s] / squares), 1, 1e-12);
      EXPECT_EQ(t.weights(s, Heuristic::maximum).chosen, s == largest ? 1 : 0);
      for (const Heuristic heuristic : heuristics)
        EXPECT_NEAR(t.weights(s, heuristic).balance / (p[s] / sum), 1, 1e-12);
    }
  }
  EXPECT_GT(tested, 5000);
}

TEST(Mis, OfEqualTechniquesTheMaximumHeuristicTakesTheFirst) {
  const Techniques t{{1, 1, 1}, {1, 1, 1}, {0, 1, 1, 1}};
  for (int s = 1; s <= 3; ++s)
    EXPECT_EQ(t.weights(s, Heuristic::maximum).chosen, s == 1 ? 1 : 0) << s;
}

TEST(Mis, WalksThatCannotBeLeaveTheOtherTechniques) {
  // No camera walk comes beyond x_2, and no light walk beyond x_1.
  const Techniques t{{1, 1, 0, 1}, {1, 0, 1, 1}, {1, 1, 1, 1, 1}};
  for (const Heuristic heuristic : heuristics) {
    EXPECT_EQ(t.weights(2, heuristic).chosen, 1);
    EXPECT_EQ(t.weights(2, heuristic).balance, 1);
  }
  // A technique that cannot be counts for nothing, even over a walk that is impossible.
  const TechniqueSums none = TechniqueSums().with(0).over(infinity);
  EXPECT_EQ(none.sum, 0);
  EXPECT_EQ(none.squares, 0);
  EXPECT_EQ(none.largest, 0);
}

}  // namespace
}  // namespace mlt
