#include "scene/emitter/environment_map.h"

#include "scene/texture/spectral_color.h"

#include <algorithm>

namespace mlt {
namespace {

/// Polar angle against the y axis over pi, exact near the poles too.
template <class F>
F polar_share(const Vec3Of<F>& d) {
  return 2 * signed_turns(d.y, F(sqrt(sqr(d.x) + sqr(d.z))));
}

/// The direction with this cosine of the polar angle and this azimuth in turns.
template <class F>
Vec3Of<F> direction_of(const F& cos_theta, const F& turns) {
  const F sin_theta = sqrt(max(F(0), (1 - cos_theta) * (1 + cos_theta)));
  const SinCosOf<F> phi = sincos_turns(turns);
  return {sin_theta * phi.sin, cos_theta, -sin_theta * phi.cos};
}

}  // namespace

EnvironmentMap::EnvironmentMap(Image image, const Frame& axes, double scale)
    : axes_(axes),
      scale_(scale),
      width_(image.width),
      height_(image.height),
      channels_(image.channels),
      texels_(std::move(image.data)) {
  tabulate();
}

Spectrum EnvironmentMap::eval(const SurfacePoint& x0, const Vec3&) const {
  const Vec3 d = axes_.to_local(x0.p);
  const Color rgb = radiance_at(column_at(d), polar_share(d));
  return spectrum_of(rgb, RgbMeaning::light, x0.wavelength);
}

Color EnvironmentMap::radiance_at(double column, double polar_share) const {
  const double x = column * width_, y = polar_share * cell_rows();
  const int i = std::min(static_cast<int>(x), width_ - 1);
  const int j = std::min(static_cast<int>(y), cell_rows() - 1);
  return scale_ * corners(i, j).at({x - i, y - j});
}

PositionSample EnvironmentMap::sample_position(const Vec2& u, double time) const {
  PositionSample sample;
  std::optional<Spectrum> radiance;
  const PositionRequest request{u, time, rgb_lanes, &sample, &radiance};
  sample_positions(&request, 1);
  return sample;
}

void EnvironmentMap::sample_positions(const PositionRequest* requests, int count) const {
  constexpr int most = Piecewise2D::most_together;
  for (; count > 0; requests += most, count -= most) {
    const int together = std::min(count, most);
    Vec2 u[most];
    Piecewise2D::Cells cells;
    for (int i = 0; i < together; ++i) u[i] = requests[i].u;
    table_.sample_cells(u, together, cells);
    for (int i = 0; i < together; ++i) {
      const float* corner =
          texel_data(static_cast<int>(cells.column[i]), static_cast<int>(cells.row[i]));
      __builtin_prefetch(corner);
      __builtin_prefetch(corner + size_t(width_) * size_t(channels_));
    }
    for (int i = 0; i < together; i += 4)
      take_four(requests + i, std::min(together - i, 4), cells, i);
  }
}

/// Answers the requests that have sampled four cells, or fewer.
void EnvironmentMap::take_four(const PositionRequest* requests, int count,
                               const Piecewise2D::Cells& cells, int first) const {
  using F = Double4;
  constexpr int size = F::size();
  double column[size], row[size], top[size], bottom[size];
  float texels[4][3][size];
  for (int k = 0; k < size; ++k) {
    const int lane = first + std::min(k, count - 1);
    const int i = static_cast<int>(cells.column[lane]), j = static_cast<int>(cells.row[lane]);
    column[k] = i;
    row[k] = j;
    top[k] = cos_rows_[size_t(j)];
    bottom[k] = cos_rows_[size_t(j) + 1];
    const float* corners[] = {texel_data(i, j), texel_data(i + 1, j), texel_data(i, j + 1),
                              texel_data(i + 1, j + 1)};
    for (int corner = 0; corner < 4; ++corner)
      for (int c = 0; c < 3; ++c) texels[corner][c][k] = corners[corner][channels_ == 1 ? 0 : c];
  }
  const auto lanes = [](const auto* numbers) { return F(numbers, stdx::element_aligned); };
  const auto color = [&](int corner) {
    const auto& [r, g, b] = texels[corner];
    return Vec3Of<F>(lanes(r), lanes(g), lanes(b));
  };
  Cell<F> cell{{lanes(column), lanes(row)},
               {lanes(&cells.x[first]), lanes(&cells.y[first])},
               lanes(top),
               lanes(bottom),
               {color(0), color(1), color(2), color(3)}};
  cell.within = cell.corners.luminances().sample(cell.within);
  const Vec3Of<F> d = direction_to(cell);
  const F pdf = this->pdf(cell, lanes(&cells.probability[first]));
  const F y = min(max(polar_share(d) * F(cell_rows()) - cell.at.y, F(0)), F(1));
  const Vec3Of<F> rgb = F(scale_) * cell.corners.at({cell.within.x, y});
  for (int k = 0; k < count; ++k) {
    const PositionRequest& request = requests[k];
    *request.sample = {point_towards(axes_.to_world({d.x[k], d.y[k], d.z[k]})), pdf[k]};
    request.sample->at.time = request.time;
    request.sample->at.wavelength = request.wavelength;
    *request.radiance =
        spectrum_of({rgb.x[k], rgb.y[k], rgb.z[k]}, RgbMeaning::light, request.wavelength);
  }
}

double EnvironmentMap::pdf_position(const SurfacePoint& x0) const {
  const Cell<double> cell = this->cell(place_of(axes_.to_local(x0.p)));
  return pdf(cell,
             table_.probability(static_cast<size_t>(cell.at.y), static_cast<size_t>(cell.at.x)));
}

/// The cell of a place in the table.
EnvironmentMap::Cell<double> EnvironmentMap::cell(const Vec2& place) const {
  const int i = std::min(static_cast<int>(place.x * width_), width_ - 1), j = row_at(place.y);
  return cell(i, j, {place.x * width_ - i, place.y * cell_rows() - j});
}
EnvironmentMap::Cell<double> EnvironmentMap::cell(int i, int j, const Vec2& within) const {
  return {{i, j}, within, cos_rows_[size_t(j)], cos_rows_[size_t(j) + 1], corners(i, j)};
}

/// The direction of a cell's place, in which y is linear in cos theta; column 0 is the middle of
/// the first column of texels.
template <class F>
Vec3Of<F> EnvironmentMap::direction_to(const Cell<F>& cell) const {
  const F turns = (cell.at.x + cell.within.x + number<F>(0.5)) / F(width_);
  return direction_of(F(cell.top + cell.within.y * (cell.bottom - cell.top)), turns);
}

/// Density in solid angle of a cell's place, by the probability of the cell.
template <class F>
F EnvironmentMap::pdf(const Cell<F>& cell, const F& probability) const {
  return probability * cell.corners.luminances().density(cell.within) /
         solid_angle(cell.top, cell.bottom);
}

Vec2 EnvironmentMap::invert_position(const SurfacePoint& x0) const {
  const Cell<double> cell = this->cell(place_of(axes_.to_local(x0.p)));
  const Vec2 within = cell.corners.luminances().invert(cell.within);
  return table_.invert((cell.at + within) / Vec2(width_, cell_rows()));
}

const float* EnvironmentMap::texel_data(int i, int j) const {
  const size_t index = size_t(j) * size_t(width_) + size_t(i >= width_ ? i - width_ : i);
  return &texels_[index * size_t(channels_)];
}

Color EnvironmentMap::color_of(const float* texel) const {
  return channels_ == 1 ? Color(*texel) : Color(texel[0], texel[1], texel[2]);
}

EnvironmentMap::Corners<double> EnvironmentMap::corners(int i, int j) const {
  const float *left = texel_data(i, j), *right = texel_data(i + 1, j);
  const size_t below = size_t(width_) * size_t(channels_);
  return {color_of(left), color_of(right), color_of(left + below), color_of(right + below)};
}

/// Where all are black, any place is as good.
template <class F>
BilinearPatch<F> EnvironmentMap::Corners<F>::luminances() const {
  const BilinearPatch<F> patch{luminance(c00), luminance(c10), luminance(c01), luminance(c11)};
  const auto black = !(patch.v00 + patch.v10 + patch.v01 + patch.v11 > 0);
  const auto or_one = [&](const F& v) { return select(black, F(1), v); };
  return {or_one(patch.v00), or_one(patch.v10), or_one(patch.v01), or_one(patch.v11)};
}

/// The azimuth of d in turns from the first column; in [0, 1).
double EnvironmentMap::column_at(const Vec3& d) const {
  const double x = turns(-d.z, d.x) - 0.5 / width_;
  return x < 0 ? x + 1 : x;
}

/// The weights of the cells, and the integral of the interpolated radiance over the sphere.
void EnvironmentMap::tabulate() {
  const int w = width_, h = cell_rows();
  std::vector<double> cos_rows;
  for (int j = 0; j <= h; ++j) cos_rows.push_back(std::cos(pi * j / h));
  cos_rows_ = std::move(cos_rows);
  const auto weights_by = [&](auto&& brightness) {
    std::vector<float> weights;
    weights.reserve(pixel_count());
    for (int j = 0; j < h; ++j) {
      const double angle = solid_angle(cos_rows_[size_t(j)], cos_rows_[size_t(j) + 1]);
      for (int i = 0; i < w; ++i) weights.push_back(static_cast<float>(brightness(i, j) * angle));
    }
    return weights;
  };
  std::vector<float> weights =
      weights_by([&](int i, int j) { return luminance(corners(i, j).at(Vec2(0.5))); });
  if (!(*std::max_element(weights.begin(), weights.end()) > 0))
    weights = weights_by([](int, int) { return 1.0; });
  table_ = Piecewise2D(weights, size_t(w), size_t(h));
  integrate();
}

/// The tent of row j in theta, integrated with sin theta: with d the distance of rows it is
/// 2 sin theta_j (1 - cos d) / d inside, and 1 - sin(d) / d at a pole.
void EnvironmentMap::integrate() {
  const double d = pi / cell_rows();
  for (int j = 0; j < height_; ++j) {
    Color row(0);
    for (int i = 0; i < width_; ++i) row += color_of(texel_data(i, j));
    const bool pole = j == 0 || j == cell_rows();
    const double tent = pole ? 1 - std::sin(d) / d : 2 * std::sin(j * d) * (1 - std::cos(d)) / d;
    integral_ += row * (tent * 2 * pi / width_);
  }
}

/// The solid angle of a cell between rows with these cosines.
template <class F>
F EnvironmentMap::solid_angle(const F& top, const F& bottom) const {
  return number<F>(2 * pi / width_) * (top - bottom);
}

// The table's unit square: x is column_at; within each row y is linear in cos theta.
int EnvironmentMap::row_at(double y) const {
  return std::clamp(static_cast<int>(y * cell_rows()), 0, cell_rows() - 1);
}

Vec2 EnvironmentMap::place_of(const Vec3& d) const {
  const int j = row_at(polar_share(d));
  const double top = cos_rows_[size_t(j)], bottom = cos_rows_[size_t(j) + 1];
  const double t = std::clamp((top - d.y) / (top - bottom), 0.0, 1 - 0x1p-40);
  return {column_at(d), (j + t) / cell_rows()};
}

}  // namespace mlt
