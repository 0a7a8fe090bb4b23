#include "scene/emitter/environment_map.h"

#include "scene/spectral_color.h"

namespace mlt {
namespace {

/// Polar angle against the y axis over pi, exact near the poles too.
double polar_share(const Vec3& d) { return 2 * signed_turns(d.y, std::sqrt(sqr(d.x) + sqr(d.z))); }

/// The direction with this cosine of the polar angle and this azimuth in turns.
Vec3 direction_of(double cos_theta, double turns) {
  const double sin_theta = safe_sqrt((1 - cos_theta) * (1 + cos_theta));
  const SinCos phi = sincos_turns(turns);
  return {sin_theta * phi.sin, cos_theta, -sin_theta * phi.cos};
}

/// Directions by their azimuths and y, in loops that the compiler vectorises.
struct Directions {
  static constexpr int most = Piecewise2D::most_together;
  double turns[most], x[most], y[most], z[most];
  double polar[most];  ///< See polar_share().

  Vec3 operator[](int i) const { return {x[i], y[i], z[i]}; }
  [[gnu::flatten]] void find(int count) {
    for (int i = 0; i < count; ++i) {
      const Vec3 d = direction_of(y[i], turns[i]);
      x[i] = d.x;
      z[i] = d.z;
      polar[i] = polar_share(d);
    }
  }
};

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

PositionSample EnvironmentMap::sample_position(const Vec2& u, double) const {
  Piecewise2D::Sample sample = table_.sample(u);
  Cell cell = this->cell(sample.at);
  sample = in_cell(cell, sample);
  const Vec3 d = direction_of(cosine_at(sample.at.y), sample.at.x + 0.5 / width_);
  return {point_towards(axes_.to_world(d)), pdf_of(sample)};
}

void EnvironmentMap::sample_positions(const PositionRequest* requests, int count) const {
  constexpr int most = Directions::most;
  for (; count > 0; requests += most, count -= most) {
    const int together = std::min(count, most);
    Vec2 u[most];
    Piecewise2D::Sample samples[most];
    for (int i = 0; i < together; ++i) u[i] = requests[i].u;
    table_.sample(u, together, samples);
    for (int i = 0; i < together; ++i) {
      const Vec2& at = samples[i].at;
      const float* corner = texel_data(static_cast<int>(at.x * width_), row_at(at.y));
      __builtin_prefetch(corner);
      __builtin_prefetch(corner + size_t(width_) * size_t(channels_));
    }
    Directions towards;
    Cell cells[most];
    for (int i = 0; i < together; ++i) {
      cells[i] = cell(samples[i].at);
      samples[i] = in_cell(cells[i], samples[i]);
      towards.turns[i] = samples[i].at.x + 0.5 / width_;
      towards.y[i] = cosine_at(samples[i].at.y);
    }
    towards.find(together);
    for (int i = 0; i < together; ++i) {
      const PositionRequest& request = requests[i];
      const double y = std::clamp(towards.polar[i] * cell_rows() - cells[i].at.y, 0.0, 1.0);
      const Color rgb = scale_ * cells[i].corners.at({cells[i].within.x, y});
      *request.sample = {point_towards(axes_.to_world(towards[i])), pdf_of(samples[i])};
      request.sample->at.wavelength = request.wavelength;
      *request.radiance = spectrum_of(rgb, RgbMeaning::light, request.wavelength);
    }
  }
}

double EnvironmentMap::pdf_position(const SurfacePoint& x0) const {
  const Vec2 place = place_of(axes_.to_local(x0.p));
  const Cell cell = this->cell(place);
  return pdf_of({place, table_.pdf(place) * cell.corners.luminances().density(cell.within)});
}

/// The cell of a place in the table.
EnvironmentMap::Cell EnvironmentMap::cell(const Vec2& place) const {
  const int i = std::min(static_cast<int>(place.x * width_), width_ - 1), j = row_at(place.y);
  return {{i, j}, {place.x * width_ - i, place.y * cell_rows() - j}, corners(i, j)};
}

Vec2 EnvironmentMap::place_in(const Cell& cell) const {
  return (Vec2(cell.at) + cell.within) / Vec2(width_, cell_rows());
}

/// Moves a sample of the cells within its cell, to one of the interpolated radiance.
Piecewise2D::Sample EnvironmentMap::in_cell(Cell& cell, const Piecewise2D::Sample& sample) const {
  const BilinearPatch luminances = cell.corners.luminances();
  cell.within = luminances.sample(cell.within);
  return {place_in(cell), sample.pdf * luminances.density(cell.within)};
}

double EnvironmentMap::pdf_of(const Piecewise2D::Sample& sample) const {
  const double cells = static_cast<double>(width_) * cell_rows();
  return sample.pdf / (cells * cell_solid_angle(row_at(sample.at.y)));
}

Vec2 EnvironmentMap::invert_position(const SurfacePoint& x0) const {
  Cell cell = this->cell(place_of(axes_.to_local(x0.p)));
  cell.within = cell.corners.luminances().invert(cell.within);
  return table_.invert(place_in(cell));
}

const float* EnvironmentMap::texel_data(int i, int j) const {
  const size_t index = size_t(j) * size_t(width_) + size_t(i >= width_ ? i - width_ : i);
  return &texels_[index * size_t(channels_)];
}

Color EnvironmentMap::color_of(const float* texel) const {
  return channels_ == 1 ? Color(*texel) : Color(texel[0], texel[1], texel[2]);
}

EnvironmentMap::Corners EnvironmentMap::corners(int i, int j) const {
  const float *left = texel_data(i, j), *right = texel_data(i + 1, j);
  const size_t below = size_t(width_) * size_t(channels_);
  return {color_of(left), color_of(right), color_of(left + below), color_of(right + below)};
}

BilinearPatch EnvironmentMap::Corners::luminances() const {
  const BilinearPatch patch{luminance(c00), luminance(c10), luminance(c01), luminance(c11)};
  if (patch.v00 + patch.v10 + patch.v01 + patch.v11 > 0) return patch;
  return {1, 1, 1, 1};
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
  std::vector<float> weights;
  weights.reserve(pixel_count());
  bool black = true;
  for (int j = 0; j < h; ++j)
    for (int i = 0; i < w; ++i) {
      const Color mean = corners(i, j).at(Vec2(0.5));
      weights.push_back(static_cast<float>(luminance(mean) * cell_solid_angle(j)));
      black = black && !(weights.back() > 0);
    }
  if (black)
    for (size_t k = 0; k < weights.size(); ++k)
      weights[k] = static_cast<float>(cell_solid_angle(static_cast<int>(k / size_t(w))));
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

double EnvironmentMap::cell_solid_angle(int row) const {
  return 2 * pi / width_ * (cos_rows_[size_t(row)] - cos_rows_[size_t(row) + 1]);
}

// The table's unit square: x is column_at; within each row y is linear in cos theta.
int EnvironmentMap::row_at(double y) const {
  return std::clamp(static_cast<int>(y * cell_rows()), 0, cell_rows() - 1);
}

double EnvironmentMap::cosine_at(double y) const {
  const int j = row_at(y);
  const double top = cos_rows_[size_t(j)], bottom = cos_rows_[size_t(j) + 1];
  return top + (y * cell_rows() - j) * (bottom - top);
}

Vec2 EnvironmentMap::place_of(const Vec3& d) const {
  const int j = row_at(polar_share(d));
  const double top = cos_rows_[size_t(j)], bottom = cos_rows_[size_t(j) + 1];
  const double t = std::clamp((top - d.y) / (top - bottom), 0.0, 1 - 0x1p-40);
  return {column_at(d), (j + t) / cell_rows()};
}

}  // namespace mlt
