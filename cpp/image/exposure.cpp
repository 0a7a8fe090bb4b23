#include "image/exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mlt {
namespace {

constexpr double share = 0.95;     // of the pixels below white
constexpr double shown_as = 0.8;   // the pixel at that share
constexpr double most_stops = 16;  // either way

}  // namespace

double fitting_exposure(const Image& image) {
  const auto channels = static_cast<size_t>(image.channels);
  const auto colours = static_cast<std::ptrdiff_t>(channels - (channels % 2 == 0 ? 1 : 0));
  std::vector<float> brightest;
  brightest.reserve(image.pixel_count());
  for (size_t pixel = 0; pixel < image.pixel_count(); ++pixel) {
    const float* samples = &image.data[pixel * channels];
    if (!std::all_of(samples, samples + colours, [](float v) { return std::isfinite(v); }))
      continue;
    brightest.push_back(*std::max_element(samples, samples + colours));
  }
  if (brightest.empty()) return 0;
  const double place = share * static_cast<double>(brightest.size() - 1);
  const auto nth = brightest.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(brightest.begin(), nth, brightest.end());
  if (!(*nth > 0)) return 0;
  return std::clamp(std::log2(shown_as / static_cast<double>(*nth)), -most_stops, most_stops);
}

}  // namespace mlt
