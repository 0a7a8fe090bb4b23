// Labels on pictures, in the bitmap font of stb_easy_font.
#pragma once

#include "image/image.h"

#include <string>

namespace mlt {

constexpr int text_height = 10;  ///< Of a line, in units of `scale`, with its descenders.

/// Width of one line in pixels.
int text_width(const std::string& text, int scale);

/// Writes one line of printable ASCII with its upper left corner at (x, y), each dot `scale` pixels
/// wide. All channels get `value`; what lies outside the image is left out.
void draw_text(Image& image, int x, int y, const std::string& text, int scale, float value);

/// Fills a rectangle; what lies outside the image is left out.
void fill(Image& image, int x, int y, int width, int height, float value);

}  // namespace mlt
