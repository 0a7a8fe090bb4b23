#include "image/label.h"

#include <algorithm>
#include <array>
#include <cmath>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace mlt {
namespace {

/// What the font has; anything else becomes a question mark.
std::string printable(std::string text) {
  std::replace_if(text.begin(), text.end(), [](char c) { return c < 32 || c > 126; }, '?');
  return text;
}

/// A corner of a quad, as the font lays it out; each glyph is a few axis-parallel quads.
struct Corner {
  float x, y, z;
  unsigned char color[4];
};
using Quad = std::array<Corner, 4>;

}  // namespace

int text_width(const std::string& text, int scale) {
  return scale * stb_easy_font_width(printable(text).data());
}

void fill(Image& image, int x, int y, int width, int height, float value) {
  const int x0 = std::max(x, 0), x1 = std::min(x + width, image.width);
  const int y0 = std::max(y, 0), y1 = std::min(y + height, image.height);
  for (int row = y0; row < y1; ++row)
    for (int column = x0; column < x1; ++column)
      for (int c = 0; c < image.channels; ++c) image.at(column, row, c) = value;
}

void draw_text(Image& image, int x, int y, const std::string& text, int scale, float value) {
  constexpr size_t quads_per_letter = 16;
  std::vector<Quad> quads(quads_per_letter * (text.size() + 1));
  const int bytes = static_cast<int>(quads.size() * sizeof(Quad));
  const int count = stb_easy_font_print(0, 0, printable(text).data(), nullptr, quads.data(), bytes);
  for (int i = 0; i < count; ++i) {
    const Corner &low = quads[i][0], &high = quads[i][2];
    const auto dots = [&](float v) { return scale * static_cast<int>(std::lround(v)); };
    fill(image, x + dots(low.x), y + dots(low.y), dots(high.x - low.x), dots(high.y - low.y),
         value);
  }
}

}  // namespace mlt
