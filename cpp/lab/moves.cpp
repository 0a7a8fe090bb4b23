#include "lab/moves.h"

#include "math/vec.h"
#include "math/warp.h"

namespace mlt::lab {
namespace {

/// A normally distributed number (Box & Muller 1958).
double sample_normal(Rng& rng) {
  const double r = std::sqrt(-2 * std::log(1 - rng.next()));
  return r * sincos_turns(rng.next()).cos;
}

class RandomWalk : public Move<Point> {
 public:
  RandomWalk(std::vector<double> size, WalkShape shape) : size_(std::move(size)), shape_(shape) {}

  std::shared_ptr<Move> clone() const override { return std::make_shared<RandomWalk>(*this); }

  bool propose(const Point& x, Point& y, Rng& rng) override {
    y.resize(x.size());
    for (size_t i = 0; i < x.size(); ++i) {
      const double size = scale_ * size_[size_.size() == 1 ? 0 : i];
      y[i] = x[i] + size * (shape_ == WalkShape::uniform ? rng.next() - 0.5 : sample_normal(rng));
    }
    return true;
  }

 protected:
  double scale_ = 1;
  std::vector<double> size_;

 private:
  WalkShape shape_;
};

class AdaptiveWalk final : public RandomWalk {
 public:
  AdaptiveWalk(std::vector<double> size, WalkShape shape, const Adaptation& adaptation)
      : RandomWalk(std::move(size), shape), adaptation_(adaptation) {}

  std::shared_ptr<Move> clone() const override { return std::make_shared<AdaptiveWalk>(*this); }
  double size() const override { return scale_ * size_[0]; }

  void adapt(double acceptance) override {
    ++proposals_;
    const double gain = adaptation_.rate * std::pow(proposals_, -adaptation_.decay);
    scale_ *= std::exp(gain * (acceptance - adaptation_.goal));
  }

 private:
  Adaptation adaptation_;
  double proposals_ = 0;
};

class Uniform final : public Move<Point> {
 public:
  Uniform(Point low, Point high) : low_(std::move(low)), high_(std::move(high)) {}

  std::shared_ptr<Move> clone() const override { return std::make_shared<Uniform>(*this); }

  bool propose(const Point&, Point& y, Rng& rng) override {
    y.resize(low_.size());
    for (size_t i = 0; i < y.size(); ++i) y[i] = low_[i] + rng.next() * (high_[i] - low_[i]);
    return true;
  }

  /// The density, times the volume of the box; a state outside of it cannot be proposed.
  double density(const Point&, const Point& y) const override {
    for (size_t i = 0; i < y.size(); ++i)
      if (!(y[i] >= low_[i] && y[i] <= high_[i])) return 0;
    return 1;
  }

 private:
  Point low_, high_;
};

class Discrete final : public Move<Point> {
 public:
  explicit Discrete(std::vector<std::vector<double>> matrix) : matrix_(std::move(matrix)) {}

  std::shared_ptr<Move> clone() const override { return std::make_shared<Discrete>(*this); }

  bool propose(const Point& x, Point& y, Rng& rng) override {
    const std::vector<double>& row = row_of(x);
    double u = rng.next();
    size_t i = 0;
    while (i + 1 < row.size() && (u -= row[i]) >= 0) ++i;
    while (i > 0 && row[i] == 0) --i;  // u was rounded past the last entry
    y.assign(1, static_cast<double>(i));
    return true;
  }

  double density(const Point& x, const Point& y) const override {
    return row_of(x)[static_cast<size_t>(y[0])];
  }

 private:
  const std::vector<double>& row_of(const Point& x) const {
    if (!(x[0] >= 0 && x[0] < static_cast<double>(matrix_.size())))
      throw UsageError("state " + describe(x) + " has no row in T, whose states are 0 to " +
                       std::to_string(matrix_.size() - 1));
    return matrix_[static_cast<size_t>(x[0])];
  }

  std::vector<std::vector<double>> matrix_;
};

}  // namespace

MovePtr random_walk(std::vector<double> size, WalkShape shape) {
  return std::make_shared<RandomWalk>(std::move(size), shape);
}

MovePtr adaptive_walk(std::vector<double> size, WalkShape shape, const Adaptation& adaptation) {
  return std::make_shared<AdaptiveWalk>(std::move(size), shape, adaptation);
}

MovePtr uniform(Point low, Point high) {
  return std::make_shared<Uniform>(std::move(low), std::move(high));
}

MovePtr discrete(const std::vector<std::vector<double>>& matrix) {
  return std::make_shared<Discrete>(matrix);
}

}  // namespace mlt::lab
