#include "job/halves.h"

#include "job/fireflies.h"

namespace mlt {
namespace {

/// With fewer, what is known of their error does not tell how unlike halves of one sequence are.
constexpr size_t fewest_to_halve = 4;

using GroupImages = std::vector<GroupImage>;

Image weighted_mean(const GroupImages& groups) {
  double total = 0;
  for (const GroupImage& group : groups) total += group.weight;
  Image mean(groups[0].image.width, groups[0].image.height, 3);
  for (const GroupImage& group : groups) {
    const auto share = static_cast<float>(group.weight / total);
    for (size_t i = 0; i < mean.data.size(); ++i) mean.data[i] += share * group.image.data[i];
  }
  return mean;
}

/// The groups first ... last - 1 of those that have samples.
GroupImages images_of(const Rendering& rendering, int layer, const std::vector<int>& live,
                      size_t first, size_t last) {
  GroupImages groups;
  for (size_t i = first; i < last; ++i) groups.push_back(rendering.group(live[i], layer));
  return groups;
}

Half half_of(GroupImages groups) {
  Half half;
  half.image = weighted_mean(groups);
  std::vector<Image> images;
  for (GroupImage& group : groups) images.push_back(std::move(group.image));
  half.robust = adaptive_median(images);
  return half;
}

void add(Half& sum, const Half& part) {
  sum.image += part.image;
  sum.robust += part.robust;
}

}  // namespace

std::optional<Halves> halves(const Rendering& rendering, int layer) {
  std::vector<int> live;
  for (int g = 0; g < Rendering::group_count; ++g)
    if (rendering.group(g, layer).weight > 0) live.push_back(g);
  if (live.size() < fewest_to_halve) return std::nullopt;
  const size_t middle = live.size() / 2;
  Halves sum{half_of(images_of(rendering, layer, live, 0, middle)),
             half_of(images_of(rendering, layer, live, middle, live.size()))};
  for (const Rendering* part : rendering.parts()) {
    const std::optional<Halves> more = halves(*part, layer);
    if (!more) return std::nullopt;
    add(sum.first, more->first);
    add(sum.second, more->second);
  }
  return sum;
}

}  // namespace mlt
