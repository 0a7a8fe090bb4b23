// The laboratory: its targets, its moves, and chains of mixtures of these against closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/moves.h"
#include "lab/targets.h"
#include "markov/lecture_examples.h"

namespace mlt {
namespace {

using lab::Point;
using Moves = lab::Prototypes<Point>;
using testing::HasSubstr;

constexpr double alpha = 1e-5;

// ---- targets

TEST(LabTarget, ParabolaIsZeroOutsideOfItsInterval) {
  const auto f = lab::parabola();
  EXPECT_DOUBLE_EQ((*f)({0}), 0.25);
  EXPECT_DOUBLE_EQ((*f)({0.75}), 0.0625);
  EXPECT_EQ((*f)({-1e-9}), 0);
  EXPECT_EQ((*f)({1 + 1e-9}), 0);
}

TEST(LabTarget, TableHoldsItsValues) {
  const auto f = lab::table({9, 1});
  EXPECT_EQ((*f)({0}), 9);
  EXPECT_EQ((*f)({1}), 1);
}

TEST(LabTarget, ImageHoldsItsPixelsRowByRow) {
  const auto f = lab::image({1, 2, 3, 4, 5, 6}, 3);
  EXPECT_EQ((*f)({0.5, 0.5}), 1);
  EXPECT_EQ((*f)({2.5, 0.5}), 3);
  EXPECT_EQ((*f)({0.5, 1.5}), 4);
  EXPECT_EQ((*f)({3.5, 0.5}), 0);
  EXPECT_EQ((*f)({0.5, -0.5}), 0);
}

TEST(LabTarget, NormalsIntegrateToTheirWeights) {
  const auto f = lab::normals({{0.3, 0}, {-1, 0.5}}, {0.5, 0.25}, {1, 2});
  double sum = 0;
  constexpr double h = 0.02;
  for (double x = -4; x < 4; x += h)
    for (double y = -4; y < 4; y += h) sum += (*f)({x, y}) * h * h;
  EXPECT_NEAR(sum, 3, 1e-6);
}

// ---- moves

/// Where a move goes from x, in `count` tries.
std::vector<Point> proposals(const lab::MovePtr& move, const Point& x, int count) {
  const auto own = move->clone();
  Rng rng(3, Purpose::test, 0);
  std::vector<Point> found;
  for (int i = 0; i < count; ++i) {
    Point y;
    if (own->propose(x, y, rng)) found.push_back(y);
  }
  return found;
}

TEST(LabMove, UniformFillsItsBoxEvenly) {
  const Point low = {-1, 2}, high = {1, 3};
  std::vector<double> counts(16);
  for (const Point& y : proposals(lab::uniform(low, high), {0, 0}, 20000)) {
    ASSERT_TRUE(y[0] >= -1 && y[0] < 1 && y[1] >= 2 && y[1] < 3);
    counts[static_cast<size_t>((y[0] + 1) * 2) * 4 + static_cast<size_t>((y[1] - 2) * 4)] += 1;
  }
  EXPECT_GT(test::chi_square_counts(counts, std::vector<double>(16, 1250)).p_value, alpha);
}

TEST(LabMove, DiscreteFollowsItsMatrix) {
  const std::vector<std::vector<double>> T = {{0.2, 0.5, 0.3}, {0, 0.5, 0.5}, {1, 0, 0}};
  const auto move = lab::discrete(T);
  for (size_t x = 0; x < 3; ++x) {
    std::vector<double> counts(3), expected;
    for (const double p : T[x]) expected.push_back(p * 20000);
    for (const Point& y : proposals(move, {double(x)}, 20000)) counts[size_t(y[0])] += 1;
    for (size_t y = 0; y < 3; ++y) {
      EXPECT_DOUBLE_EQ(move->density({double(x)}, {double(y)}), T[x][y]);
      EXPECT_TRUE(T[x][y] > 0 || counts[y] == 0);
    }
    if (x == 0) {
      EXPECT_GT(test::chi_square_counts(counts, expected).p_value, alpha);
    }
  }
}

TEST(LabMove, RandomWalkStepsUniformlyOrNormally) {
  test::Moments uniform, normal;
  for (const Point& y : proposals(lab::random_walk({0.2}, lab::WalkShape::uniform), {5}, 20000)) {
    ASSERT_LE(std::abs(y[0] - 5), 0.1);
    uniform.add((y[0] - 5) * (y[0] - 5));
  }
  for (const Point& y : proposals(lab::random_walk({0.2}, lab::WalkShape::normal), {5}, 20000))
    normal.add((y[0] - 5) * (y[0] - 5));
  EXPECT_GT(test::one_sample_t_test(uniform, 0.04 / 12).p_value, alpha);
  EXPECT_GT(test::one_sample_t_test(normal, 0.04).p_value, alpha);
}

TEST(LabMove, AdaptiveWalkLearnsInACopyOfItsOwn) {
  const auto prototype = lab::adaptive_walk({0.5}, lab::WalkShape::normal, {});
  const auto shrinks = prototype->clone(), grows = prototype->clone();
  Rng rng(1, Purpose::test, 0);
  Point y;
  for (int i = 0; i < 50; ++i)
    for (const auto& [move, acceptance] : {std::pair(&shrinks, 0.0), std::pair(&grows, 1.0)}) {
      (*move)->propose({0}, y, rng);
      (*move)->adapt(acceptance);
    }
  EXPECT_DOUBLE_EQ(prototype->size(), 0.5);
  EXPECT_LT(shrinks->size(), 0.1);
  EXPECT_GT(grows->size(), 2);
}

// ---- chains

/// Steps whose size depends on where it is, so that they are not symmetric.
class Growing : public lab::Move<Point> {
 public:
  explicit Growing(bool forgets_density) : forgets_density_(forgets_density) {}
  std::shared_ptr<Move> clone() const override { return std::make_shared<Growing>(*this); }
  bool propose(const Point& x, Point& y, Rng& rng) override {
    y = {x[0] + size_at(x) * (rng.next() - 0.5)};
    return true;
  }
  double density(const Point& x, const Point& y) const override {
    if (forgets_density_) return 1;
    return std::abs(y[0] - x[0]) <= 0.5 * size_at(x) ? 1 / size_at(x) : 0;
  }

 private:
  static double size_at(const Point& x) { return 0.2 + 0.8 * std::abs(x[0]); }
  bool forgets_density_;
};

/// A uniform move that suits some states more than others.
class Picky : public lab::Move<Point> {
 public:
  std::shared_ptr<Move> clone() const override { return std::make_shared<Picky>(*this); }
  double suitability(const Point& x) const override { return x[0] < 0.3 ? 0 : x[0]; }
  bool propose(const Point&, Point& y, Rng& rng) override {
    y = {rng.next()};
    return true;
  }
};

lab::MovePtr anywhere() { return lab::uniform({0}, {1}); }
lab::MovePtr nearby() { return lab::random_walk({0.1}, lab::WalkShape::uniform); }

/// Of the last states of chains that start from the parabola's own distribution.
double p_value(const Moves& moves) {
  const auto f = lab::parabola();
  std::vector<double> states;
  for (uint64_t c = 0; c < 20000; ++c) {
    Rng rng(5, Purpose::test, c);
    const Point start = {test::Parabola::sample(rng.next())};
    lab::Chain<Point> chain(start, (*f)(start), moves, 7, c);
    for (int i = 0; i < 20; ++i) chain.step(*f, [](const Point&, double, bool) {});
    states.push_back(chain.state().x[0]);
  }
  return test::parabola_p_value(states);
}

TEST(LabChain, LeavesTheParabolaUnchanged) {
  EXPECT_GT(p_value({{anywhere(), 0.1}, {nearby(), 0.9}}), alpha);
  EXPECT_GT(p_value({{std::make_shared<Growing>(false), 1}}), alpha);
}

TEST(LabChain, DoesNotWhenADensityIsForgotten) {
  EXPECT_LT(p_value({{std::make_shared<Growing>(true), 1}}), alpha);
}

TEST(LabChain, CountsTheProbabilityOfTheChoice) {
  EXPECT_GT(p_value({{std::make_shared<Picky>(), 1}, {nearby(), 1}}), alpha);
}

TEST(LabChain, AcceptsOneNinthInTheLectureExample) {
  const auto f = lab::table({9, 1});
  lab::Chain<Point> chain({0}, 9, {{lab::discrete({{0.5, 0.5}, {0.5, 0.5}}), 1}}, 1, 0);
  for (int i = 0; i < 200; ++i) {
    const double from = chain.state().x[0];
    double to = from, sum = 0;
    const StepResult result = chain.step(*f, [&](const Point& x, double weight, bool proposal) {
      if (proposal) to = x[0];
      sum += weight;
    });
    EXPECT_DOUBLE_EQ(sum, 1);
    EXPECT_DOUBLE_EQ(result.acceptance, from == 0 && to == 1 ? 1. / 9 : 1);
  }
}

// ---- what makes no sense

std::string message(const std::function<void()>& act) {
  try {
    act();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

lab::Chain<Point> chain_with(double target, const lab::MovePtr& move = anywhere()) {
  return {{0.25}, target, {{move, 1}}, 1, 0};
}

TEST(LabChain, RefusesAStartThatItCannotLeaveFairly) {
  EXPECT_THAT(message([] { chain_with(0); }), HasSubstr("the target is 0 at the start x = 0.25"));
  EXPECT_THAT(message([] { chain_with(-1); }), HasSubstr("the target is -1 at x = 0.25"));
  EXPECT_THAT(message([] { chain_with(std::nan("")); }),
              HasSubstr("the target is nan at x = 0.25"));
}

TEST(LabChain, RefusesADensityOfWhatItHasProposed) {
  class Impossible : public Picky {
   public:
    std::shared_ptr<Move> clone() const override { return std::make_shared<Impossible>(*this); }
    double suitability(const Point&) const override { return 1; }
    double density(const Point&, const Point&) const override { return 0; }
  };
  auto chain = chain_with(1, std::make_shared<Impossible>());
  EXPECT_THAT(message([&] { chain.step(*lab::parabola(), [](const Point&, double, bool) {}); }),
              HasSubstr("but its density q(x -> y) is 0"));
}

TEST(LabChain, RefusesATargetThatTurnsNegative) {
  auto chain = chain_with(1);
  EXPECT_THAT(message([&] {
                chain.step(*lab::normals({{0.5}}, {1}, {-1}), [](const Point&, double, bool) {});
              }),
              HasSubstr("it must be a finite number that is not negative"));
}

TEST(LabChain, StaysWhereNoMoveSuits) {
  lab::Chain<Point> chain({0.25}, 1, {{std::make_shared<Picky>(), 1}}, 1, 0);
  const StepResult result = chain.step(*lab::parabola(), [](const Point&, double, bool) {});
  EXPECT_EQ(result.acceptance, 0);
  EXPECT_EQ(chain.state().x, Point{0.25});
  EXPECT_FALSE(chain.kernel().suited());
}

}  // namespace
}  // namespace mlt
