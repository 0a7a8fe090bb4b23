#include "render/technique_pyramid.h"

#include "image/label.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mlt {
namespace {

constexpr int gap = 8, text_scale = 2, line = text_scale * text_height;
constexpr float paper = 1, ink = 0, nothing_found = 0.8f;

bool is_black(const Image& image) {
  return std::all_of(image.data.begin(), image.data.end(), [](float v) { return v == 0; });
}

/// Averages squares of `factor` pixels; what does not fill a square is left out.
Image smaller(const Image& image, int factor) {
  Image result(std::max(1, image.width / factor), std::max(1, image.height / factor), 3);
  const int nx = std::min(factor, image.width), ny = std::min(factor, image.height);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int j = 0; j < ny; ++j)
          for (int i = 0; i < nx; ++i) sum += image.at(x * factor + i, y * factor + j, c);
        result.at(x, y, c) = static_cast<float>(sum / (nx * ny));
      }
  return result;
}

struct Entry {
  TechniqueName name;
  const Image* image;
  int edges() const { return name.s + name.t - 1; }
};

class Pyramid {
 public:
  Pyramid(std::vector<Entry> entries, double exposure, int most_width)
      : entries_(std::move(entries)), scale_(std::exp2(exposure)) {
    const Image& first = *entries_[0].image;
    factor_ = std::max(1, (first.width + most_width - 1) / most_width);
    cell_width_ = std::max({1, first.width / factor_, text_width("s=10 t=10", text_scale)});
    cell_height_ = std::max(1, first.height / factor_);
    for (const Entry& e : entries_) {
      rows_ = std::max(rows_, e.edges());
      columns_ = std::max(columns_, e.name.s + 1);
    }
    margin_ = text_width("k=10", text_scale) + 2 * gap;
  }

  Image draw() const {
    const int block = line + gap + rows_ * (cell_height_ + line + gap);
    const int titles = text_width(title(true), text_scale) + 2 * gap;
    Image image(std::max(margin_ + columns_ * (cell_width_ + gap), titles), 2 * (block + gap), 3);
    fill(image, 0, 0, image.width, image.height, paper);
    for (const bool weighted : {false, true})
      draw_block(image, weighted, gap + weighted * (block + gap));
    return image;
  }

 private:
  static std::string title(bool weighted) {
    return weighted ? "weighted: their sum is the render" : "raw: what each technique finds alone";
  }

  void draw_block(Image& image, bool weighted, int top) const {
    draw_text(image, gap, top, title(weighted), text_scale, ink);
    for (const Entry& e : entries_) {
      if (e.name.weighted != weighted) continue;
      const int x = margin_ + e.name.s * (cell_width_ + gap);
      const int y = top + line + gap + (e.edges() - 1) * (cell_height_ + line + gap);
      if (e.name.s == 0)
        draw_text(image, gap, y + cell_height_ / 2 - line / 2, fmt::format("k={}", e.edges()),
                  text_scale, ink);
      draw_cell(image, e, x, y);
    }
  }

  void draw_cell(Image& image, const Entry& e, int x, int y) const {
    const std::string label = fmt::format("s={} t={}", e.name.s, e.name.t);
    draw_text(image, x, y + cell_height_ + text_scale, label, text_scale, ink);
    if (is_black(*e.image)) {
      fill(image, x, y, std::max(1, e.image->width / factor_), cell_height_, nothing_found);
      return;
    }
    const Image small = smaller(*e.image, factor_);
    for (int j = 0; j < small.height; ++j)
      for (int i = 0; i < small.width; ++i)
        for (int c = 0; c < 3; ++c)
          image.at(x + i, y + j, c) =
              static_cast<float>(std::clamp(scale_ * small.at(i, j, c), 0.0, 1.0));
  }

  std::vector<Entry> entries_;
  double scale_;
  int factor_ = 1, cell_width_ = 1, cell_height_ = 1, rows_ = 0, columns_ = 0, margin_ = 0;
};

}  // namespace

std::optional<TechniqueName> parse_technique(const std::string& layer) {
  for (const char* const kind : {"raw", "weighted"}) {
    const std::string pattern = fmt::format("{}.s%9d.t%9d", kind);
    int s, t;
    if (std::sscanf(layer.c_str(), pattern.c_str(), &s, &t) == 2 && s >= 0 && t >= 0 &&
        layer == fmt::format("{}.s{}.t{}", kind, s, t))
      return TechniqueName{s, t, kind == std::string("weighted")};
  }
  return std::nullopt;
}

std::optional<Image> technique_pyramid(const std::vector<NamedImage>& layers, double exposure,
                                       int most_width) {
  std::vector<Entry> entries;
  bool lens_is_hit = false;
  for (const NamedImage& layer : layers)
    if (const auto name = parse_technique(layer.name)) {
      entries.push_back({*name, &layer.image});
      lens_is_hit = lens_is_hit || (name->t == 0 && !is_black(layer.image));
    }
  if (entries.empty()) return std::nullopt;
  if (!lens_is_hit)
    entries.erase(std::remove_if(entries.begin(), entries.end(),
                                 [](const Entry& e) { return e.name.t == 0; }),
                  entries.end());
  return Pyramid(std::move(entries), exposure, most_width).draw();
}

}  // namespace mlt
