// The sums of a film as bytes.
#include "image/sample_film.h"

#include <algorithm>

namespace mlt {

void SampleFilm::write(ByteWriter& bytes, const Strand& strand) const {
  if (!strand.pending.empty()) throw RenderError("a film cannot be saved while units are running");
  bytes.write(strand.reach);
  bytes.write(strand.next);
  bytes.write(strand.rgb);
  bytes.write(strand.light);
  bytes.write(strand.samples);
  for (const SampleSums& sums : strand.sums) sums.save(bytes);
}

SampleFilm::Strand SampleFilm::read(ByteReader& bytes, const Strand& like) const {
  Strand strand;
  strand.reach = bytes.read<PixelRect>();
  strand.next = bytes.read<uint64_t>();
  bytes.read(strand.rgb);
  bytes.read(strand.light);
  bytes.read(strand.samples);
  strand.sums.resize(like.sums.size());
  for (SampleSums& sums : strand.sums) sums.load(bytes);
  const auto fit = [&](const std::vector<float>& sums) {
    return sums.empty() || sums.size() == like.size();
  };
  const PixelRect &a = strand.reach, &b = like.reach;
  if (a.x0 != b.x0 || a.y0 != b.y0 || a.x1 != b.x1 || a.y1 != b.y1 || !fit(strand.rgb) ||
      !fit(strand.light) || strand.samples.size() != like.samples.size())
    throw RenderError("the saved film has another size");
  return strand;
}

SampleFilm::Selection SampleFilm::everything() const {
  Selection all;
  for (int g = 0; g < group_count(); ++g) all.groups.push_back(g);
  return all;
}

std::vector<std::pair<SampleFilm::Group*, int>> SampleFilm::strands_of(
    const Selection& selection) const {
  std::vector<std::pair<Group*, int>> strands;
  const uint64_t last = std::min<uint64_t>(selection.last, share_count());
  for (uint64_t first = selection.first; first < last; ++first) {
    const int share = static_cast<int>(first);
    for (const int group : selection.groups)
      if (!splats_ || share == group)
        strands.push_back({groups_.at(group).get(), splats_ ? 0 : share});
  }
  return strands;
}

std::string SampleFilm::save(const Selection& selection) const {
  ByteWriter bytes;
  for (const auto& [group, index] : strands_of(selection)) {
    const std::lock_guard lock(group->mutex);
    write(bytes, group->strands[index]);
  }
  return bytes.take();
}

void SampleFilm::load(const std::string& saved, const Selection& selection) {
  ByteReader bytes(saved);
  const auto places = strands_of(selection);
  std::vector<Strand> strands;
  for (const auto& [group, index] : places) strands.push_back(read(bytes, group->strands[index]));
  bytes.finish();
  for (size_t i = 0; i < places.size(); ++i) {
    const std::lock_guard lock(places[i].first->mutex);
    places[i].first->strands[places[i].second] = std::move(strands[i]);
  }
}

}  // namespace mlt
