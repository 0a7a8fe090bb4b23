#include "job/fireflies.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mlt {
namespace {

Color pixel(const Image& image, size_t i) {
  return Color(image.data[3 * i], image.data[3 * i + 1], image.data[3 * i + 2]);
}

}  // namespace

int left_out(const std::vector<float>& sorted) {
  const int count = static_cast<int>(sorted.size());
  double sum = 0, weighted = 0;
  for (int i = 0; i < count; ++i) {
    sum += sorted[i];
    weighted += (i + 1) * double{sorted[i]};
  }
  if (!(sum > 0)) return 0;
  const double gini = 2 * weighted / (count * sum) - (count + 1.0) / count;
  return std::min(static_cast<int>(std::clamp(gini, 0.0, 1.0) * count / 2), (count - 1) / 2);
}

Image adaptive_median(const std::vector<Image>& groups) {
  Image image(groups[0].width, groups[0].height, 3);
  std::vector<float> brightness(groups.size()), sorted;
  std::vector<int> order(groups.size());
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    for (size_t g = 0; g < groups.size(); ++g)
      brightness[g] = static_cast<float>(target_luminance(pixel(groups[g], i)));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return brightness[a] < brightness[b]; });
    sorted.clear();
    for (const int g : order) sorted.push_back(brightness[g]);
    const size_t c = left_out(sorted);
    Color sum(0);
    for (size_t k = c; k < order.size() - c; ++k) sum += pixel(groups[order[k]], i);
    if (target_luminance(sum) < 0) sum = Color(0);  // some groups owe light to the others
    for (int channel = 0; channel < 3; ++channel)
      image.data[3 * i + channel] =
          static_cast<float>(sum[channel] / static_cast<double>(order.size() - 2 * c));
  }
  return image;
}

Image without_fireflies(const Rendering& rendering) {
  std::vector<Image> groups;
  for (int g = 0; g < Rendering::group_count; ++g)
    if (GroupImage group = rendering.group(g); group.weight > 0)
      groups.push_back(std::move(group.image));
  if (groups.empty()) return rendering.image();
  Image image = adaptive_median(groups);
  for (const Rendering* part : rendering.parts()) image += without_fireflies(*part);
  return image;
}

}  // namespace mlt
