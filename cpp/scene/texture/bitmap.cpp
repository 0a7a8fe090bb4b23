// An image as a texture. Conventions are Mitsuba 3's: row 0 of the image is at v = 0, the centre of
// texel (i, j) is at u = (i + 1/2) / width, v = (j + 1/2) / height.
#include "base/registry.h"
#include "scene/texture/load_texels.h"
#include "scene/texture/texture.h"
#include "scene/texture/uv_transform.h"

namespace mlt {
namespace {

/// The continuation outside of the unit interval.
enum class Wrap { repeat, mirror, clamp, zero, one };

/// An equivalent coordinate close to [0, 1], so that texel indices stay small.
double reduce(double u, Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat: return u - std::floor(u);
    case Wrap::mirror: return u - 2 * std::floor(0.5 * u);
    default: return std::clamp(u, -2.0, 3.0);
  }
}

/// The index of the texel for index i, or -1 for the border value.
int wrapped(int i, int n, Wrap wrap) {
  if (i >= 0 && i < n) return i;
  switch (wrap) {
    case Wrap::repeat: return ((i % n) + n) % n;
    case Wrap::mirror: {
      const int m = ((i % (2 * n)) + 2 * n) % (2 * n);
      return m < n ? m : 2 * n - 1 - m;
    }
    case Wrap::clamp: return std::clamp(i, 0, n - 1);
    default: return -1;
  }
}

double border_value(Wrap wrap) { return wrap == Wrap::one ? 1 : 0; }

class Bitmap final : public Texture {
 public:
  Bitmap(Texels texels, bool nearest, Wrap wrap_u, Wrap wrap_v, const UvTransform& to_uv)
      : texels_(std::move(texels)),
        nearest_(nearest),
        wrap_u_(wrap_u),
        wrap_v_(wrap_v),
        to_uv_(to_uv) {
    Color sum(0);
    for (int y = 0; y < texels_.height(); ++y)
      for (int x = 0; x < texels_.width(); ++x) {
        const Color c = texels_(x, y);
        sum += c;
        maximum_ = glm::max(maximum_, c);
      }
    mean_ = sum / (double{1} * texels_.width() * texels_.height());
    maximum_ = glm::max(maximum_, Color(std::max(border_value(wrap_u), border_value(wrap_v))));
  }

  void prefetch(const SurfacePoint& at) const override {
    const Vec2 p = position(at);
    if (!is_finite(p)) return;
    const int x = column(static_cast<int>(p.x - 0.5)), y = static_cast<int>(p.y - 0.5);
    for (const int j : {row(y), row(y + 1)})
      if (x >= 0 && j >= 0) texels_.prefetch(x, j);
  }

  Spectrum eval(const SurfacePoint& at) const override {
    return spectrum_of(color(at), RgbMeaning::reflectance, at.wavelength);
  }

  Vec2 gradient(const SurfacePoint& at) const override {
    const Vec2 p = position(at);
    if (nearest_ || !is_finite(p)) return Vec2(0);
    const Texels::Cell c = cell(p);
    double value[4];
    for (int i = 0; i < 4; ++i) value[i] = luminance(corner(c, i % 2, i / 2));
    const double along_x = (1 - c.b) * (value[1] - value[0]) + c.b * (value[3] - value[2]);
    const double along_y = (1 - c.a) * (value[2] - value[0]) + c.a * (value[3] - value[1]);
    return to_uv_.pull_back({along_x * texels_.width(), along_y * texels_.height()});
  }

  Vec2i resolution() const override { return {texels_.width(), texels_.height()}; }
  Color mean() const override { return mean_; }
  Color maximum() const override { return maximum_; }

 private:
  Color color(const SurfacePoint& at) const {
    const Vec2 p = position(at);
    if (!is_finite(p)) return mean_;
    if (nearest_)
      return lookup(column(static_cast<int>(std::floor(p.x))),
                    row(static_cast<int>(std::floor(p.y))));
    const Texels::Cell c = cell(p);
    if (std::min({c.x[0], c.x[1], c.y[0], c.y[1]}) >= 0) return texels_.bilinear(c);
    return (1 - c.b) * ((1 - c.a) * corner(c, 0, 0) + c.a * corner(c, 1, 0)) +
           c.b * ((1 - c.a) * corner(c, 0, 1) + c.a * corner(c, 1, 1));
  }

  /// The position in texels; not finite where uv is not.
  Vec2 position(const SurfacePoint& at) const {
    const Vec2 uv = to_uv_(at.uv);
    return {reduce(uv.x, wrap_u_) * texels_.width(), reduce(uv.y, wrap_v_) * texels_.height()};
  }

  /// The texels around a position; -1 for columns and rows of the border value.
  Texels::Cell cell(const Vec2& p) const {
    const double fx = std::floor(p.x - 0.5), fy = std::floor(p.y - 0.5);
    const int i = static_cast<int>(fx), j = static_cast<int>(fy);
    return {{column(i), column(i + 1)}, {row(j), row(j + 1)}, p.x - 0.5 - fx, p.y - 0.5 - fy};
  }
  Color corner(const Texels::Cell& cell, int column, int row) const {
    return lookup(cell.x[column], cell.y[row]);
  }

  int column(int i) const { return wrapped(i, texels_.width(), wrap_u_); }
  int row(int j) const { return wrapped(j, texels_.height(), wrap_v_); }
  /// The texel of a column and a row, or the border value.
  Color lookup(int x, int y) const {
    if (x < 0) return Color(border_value(wrap_u_));
    if (y < 0) return Color(border_value(wrap_v_));
    return texels_(x, y);
  }

  Texels texels_;
  bool nearest_;
  Wrap wrap_u_, wrap_v_;
  UvTransform to_uv_;
  Color mean_{0};
  Color maximum_{0};
};

Wrap read_wrap(Params& params, const std::string& name) {
  const std::string mode = params.text(params.has(name) ? name : "wrap_mode");
  if (mode == "mirror") return Wrap::mirror;
  if (mode == "clamp") return Wrap::clamp;
  if (mode == "zero" || mode == "black") return Wrap::zero;
  if (mode == "one" || mode == "white") return Wrap::one;
  return Wrap::repeat;
}

bool read_nearest(Params& params) {
  const std::string filter = params.text("filter_type");
  if (filter == "trilinear" || filter == "ewa")
    params.warn("filter_type '" + filter + "' is read as 'bilinear'");
  return filter == "nearest";
}

Decoding read_decoding(Params& params) {
  Decoding decoding;
  if (params.boolean("raw")) {
    if (params.has("gamma")) params.fail("gamma", "and 'raw' exclude each other");
    decoding.kind = Decoding::Kind::none;
    decoding.keep_negative = true;
  } else if (params.has("gamma")) {
    decoding.gamma = params.real("gamma");
    if (decoding.gamma == -1)
      decoding.kind = Decoding::Kind::srgb;
    else if (decoding.gamma == 1)
      decoding.kind = Decoding::Kind::none;
    else if (decoding.gamma > 0)
      decoding.kind = Decoding::Kind::power;
    else
      params.fail("gamma", "must be positive, or -1 for sRGB");
  }
  return decoding;
}

ObjectPtr create_bitmap(Params& params) {
  const Wrap wrap_u = read_wrap(params, "wrap_mode_u"), wrap_v = read_wrap(params, "wrap_mode_v");
  const bool nearest = read_nearest(params);
  const UvTransform to_uv(params);
  return std::make_shared<Bitmap>(load_texels(params, read_decoding(params)), nearest, wrap_u,
                                  wrap_v, to_uv);
}

std::vector<Parameter> parameters() {
  const std::vector<std::string> wraps = {"repeat", "mirror", "clamp", "zero",
                                          "one",    "black",  "white"};
  return concat(
      {image_parameters("Image file: PNG, JPEG, HDR, EXR, TGA or BMP."),
       {choice_parameter("filter_type", "bilinear",
                         "How texels are interpolated; trilinear and ewa are read as bilinear.",
                         {"bilinear", "nearest", "trilinear", "ewa"}),
        choice_parameter("wrap_mode", "repeat", "What lies outside of [0, 1].", wraps),
        {"wrap_mode_u", ParamType::text, no_default, "wrap_mode along u, if different.", wraps},
        {"wrap_mode_v", ParamType::text, no_default, "wrap_mode along v, if different.", wraps},
        {"raw", ParamType::boolean, false,
         "Take the stored values as they are, without sRGB decoding."},
        {"gamma", ParamType::real, no_default,
         "Gamma of the stored values: 1 is linear, -1 sRGB; by the file's format if not given."}}});
}

}  // namespace

Plugin texture_bitmap() {
  std::vector<std::string> ignored = {"format", "accel", "cache", "max_anisotropy"};
  return {{"texture", "bitmap", "An image, interpolated between its texels.",
           concat({parameters(), uv_parameters()}), std::move(ignored)},
          create_bitmap};
}

}  // namespace mlt
