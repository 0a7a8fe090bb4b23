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

std::optional<Halves> halves(const Rendering& rendering) {
  GroupImages first = groups_with_images(rendering);
  if (first.size() < fewest_to_halve) return std::nullopt;
  const auto middle = first.begin() + static_cast<std::ptrdiff_t>(first.size() / 2);
  GroupImages second(std::make_move_iterator(middle), std::make_move_iterator(first.end()));
  first.erase(middle, first.end());
  Halves sum{half_of(std::move(first)), half_of(std::move(second))};
  for (const Rendering* part : rendering.parts()) {
    const std::optional<Halves> more = halves(*part);
    if (!more) return std::nullopt;
    add(sum.first, more->first);
    add(sum.second, more->second);
  }
  return sum;
}

}  // namespace mlt
