#include "math/distribution.h"

#include "base/error.h"

#include <fmt/format.h>

namespace mlt {

namespace {

void check_weight(double weight, size_t index) {
  if (!(weight >= 0) || !std::isfinite(weight))
    throw UsageError(fmt::format(
        "a distribution needs weights that are finite and not negative; weight {} is {}", index,
        weight));
}

/// Finds where each weight's share of [0, full] begins. Every positive weight gets one unit and its
/// part of the rest, so none is lost to rounding; a weight of zero gets exactly nothing.
void fill_row(const float* weights, size_t n, double total, uint32_t full, uint32_t* starts) {
  uint32_t positive = 0;
  for (size_t i = 0; i < n; ++i) positive += weights[i] > 0;
  const double divisible = full - positive;
  double sum = 0;
  uint32_t units = 0;
  for (size_t i = 0; i < n; ++i) {
    starts[i] = units + static_cast<uint32_t>(sum / total * divisible);
    sum += weights[i];
    units += weights[i] > 0;
  }
}

}  // namespace

Discrete::Discrete(const std::vector<double>& weights) {
  if (weights.empty()) throw UsageError("a distribution needs at least one weight");
  std::vector<double> cdf;
  cdf.reserve(weights.size() + 1);
  cdf.push_back(0);
  size_t last_positive = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    check_weight(weights[i], i);
    if (weights[i] > 0) last_positive = i;
    total_ += weights[i];
    cdf.push_back(total_);
  }
  if (!(total_ > 0)) throw UsageError("a distribution needs at least one weight above zero");
  if (!std::isfinite(total_)) throw UsageError("the weights of a distribution overflow their sum");
  for (double& c : cdf) c /= total_;
  for (size_t i = last_positive + 1; i < cdf.size(); ++i) cdf[i] = 1;
  if (const size_t n = weights.size(); n > few) starts_ = {{cdf.begin(), cdf.end() - 1}, n, 1};
  cdf_ = std::move(cdf);
}

Piecewise2D::Piecewise2D(const std::vector<float>& weights, size_t width, size_t height)
    : width_(width), height_(height) {
  if (width == 0 || height == 0 || weights.size() != width * height)
    throw UsageError(fmt::format("a {} x {} table needs {} weights, not {}", width, height,
                                 width * height, weights.size()));
  std::vector<double> sums(height, 0.0);
  for (size_t i = 0; i < weights.size(); ++i) {
    check_weight(weights[i], i);
    sums[i / width] += weights[i];
  }
  rows_ = Discrete(sums);
  integral_ = rows_.total() / (static_cast<double>(width) * static_cast<double>(height));

  std::vector<uint32_t> starts(weights.size());
  for (size_t y = 0; y < height; ++y) {
    if (sums[y] == 0) continue;
    fill_row(weights.data() + y * width, width, sums[y], full, starts.data() + y * width);
  }
  starts_ = {std::move(starts), width, full};
}

// Within a row, the numbers of a column are those from its start on, over `full`.

void Piecewise2D::sample_cells(const Vec2* u, int count, Cells& cells) const {
  uint32_t shares[most_together];
  for (int i = 0; i < count; ++i) {
    cells.row[i] = rows_.sample(u[i].y);
    cells.x[i] = u[i].x * full;
    shares[i] = static_cast<uint32_t>(cells.x[i]);
  }
  starts_.last_up_to(cells.row, shares, count, cells.column);
  double size[2][most_together];
  for (int i = 0; i < count; ++i) {
    const size_t row = cells.row[i], column = cells.column[i];
    const double low = starts_.at(row, column);
    cells.x[i] -= low;
    size[0][i] = starts_.at(row, column + 1) - low;
    cells.y[i] = u[i].y - rows_.begin(row);
    size[1][i] = rows_.pdf(row);
  }
  for (int i = 0; i < count; ++i) {
    cells.x[i] = std::min(cells.x[i] / size[0][i], 1 - 0x1p-53);
    cells.y[i] = std::min(cells.y[i] / size[1][i], 1 - 0x1p-53);
    cells.probability[i] = size[1][i] * (size[0][i] / full);
  }
}

Piecewise2D::Sample Piecewise2D::sample(const Vec2& u) const {
  Cells cell;
  sample_cells(&u, 1, cell);
  return {{(static_cast<double>(cell.column[0]) + cell.x[0]) / static_cast<double>(width_),
           (static_cast<double>(cell.row[0]) + cell.y[0]) / static_cast<double>(height_)},
          cell.probability[0] * cells()};
}

double Piecewise2D::probability(size_t row, size_t column) const {
  const double low = starts_.at(row, column), high = starts_.at(row, column + 1);
  return rows_.pdf(row) * ((high - low) / full);
}

Piecewise2D::Place Piecewise2D::locate(const Vec2& p) const {
  const double x = std::min(std::max(p.x, 0.0), 1.0) * static_cast<double>(width_);
  const double y = std::min(std::max(p.y, 0.0), 1.0) * static_cast<double>(height_);
  const size_t column = std::min(static_cast<size_t>(x), width_ - 1);
  const size_t row = std::min(static_cast<size_t>(y), height_ - 1);
  return {row, column, y - static_cast<double>(row), x - static_cast<double>(column)};
}

double Piecewise2D::pdf(const Vec2& p) const {
  const Place place = locate(p);
  return probability(place.row, place.column) * cells();
}

Vec2 Piecewise2D::invert(const Vec2& p) const {
  const Place at = locate(p);
  const double low = starts_.at(at.row, at.column), high = starts_.at(at.row, at.column + 1);
  return {(low + at.x * (high - low)) / full, rows_.invert(at.row, at.y)};
}

}  // namespace mlt
