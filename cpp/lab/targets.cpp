#include "lab/targets.h"

#include "math/vec.h"

namespace mlt::lab {
namespace {

class Parabola final : public Target<Point> {
 public:
  double operator()(const Point& x) const override {
    return x[0] < 0 || x[0] > 1 ? 0 : (x[0] - 0.5) * (x[0] - 0.5);
  }
};

class Table final : public Target<Point> {
 public:
  explicit Table(std::vector<double> values) : values_(std::move(values)) {}
  double operator()(const Point& x) const override {
    const bool inside = x[0] >= 0 && x[0] < static_cast<double>(values_.size());
    return inside ? values_[static_cast<size_t>(x[0])] : 0;
  }

 private:
  std::vector<double> values_;
};

class ImageTarget final : public Target<Point> {
 public:
  ImageTarget(std::vector<double> pixels, size_t width)
      : pixels_(std::move(pixels)), width_(width), height_(pixels_.size() / width) {}
  double operator()(const Point& p) const override {
    const bool inside = p[0] >= 0 && p[0] < static_cast<double>(width_) && p[1] >= 0 &&
                        p[1] < static_cast<double>(height_);
    return inside ? pixels_[static_cast<size_t>(p[1]) * width_ + static_cast<size_t>(p[0])] : 0;
  }

 private:
  std::vector<double> pixels_;
  size_t width_, height_;
};

class Normals final : public Target<Point> {
 public:
  Normals(std::vector<Point> means, std::vector<double> deviations, std::vector<double> weights)
      : means_(std::move(means)),
        deviations_(std::move(deviations)),
        weights_(std::move(weights)) {}
  double operator()(const Point& x) const override {
    double sum = 0;
    for (size_t i = 0; i < means_.size(); ++i) {
      double squares = 0, scale = 1;
      for (size_t d = 0; d < x.size(); ++d) {
        const double z = (x[d] - means_[i][d]) / deviations_[i];
        squares += z * z;
        scale *= deviations_[i] * std::sqrt(2 * pi);
      }
      sum += weights_[i] * std::exp(-0.5 * squares) / scale;
    }
    return sum;
  }

 private:
  std::vector<Point> means_;
  std::vector<double> deviations_, weights_;
};

}  // namespace

TargetPtr parabola() { return std::make_shared<Parabola>(); }

TargetPtr table(std::vector<double> values) { return std::make_shared<Table>(std::move(values)); }

TargetPtr image(std::vector<double> pixels, size_t width) {
  return std::make_shared<ImageTarget>(std::move(pixels), width);
}

TargetPtr normals(std::vector<Point> means, std::vector<double> deviations,
                  std::vector<double> weights) {
  return std::make_shared<Normals>(std::move(means), std::move(deviations), std::move(weights));
}

}  // namespace mlt::lab
