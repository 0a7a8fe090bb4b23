#include "path/manifold_photons.h"

#include <algorithm>

namespace mlt {
namespace {

constexpr size_t most_in_cell = 16;

/// The axis along which these photons extend the most.
int widest_axis(const ManifoldPhoton* first, size_t count) {
  Vec3 low = first->at, high = first->at;
  for (size_t i = 1; i < count; ++i) {
    low = glm::min(low, first[i].at);
    high = glm::max(high, first[i].at);
  }
  const Vec3 size = high - low;
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

void divide_photons(ManifoldPhoton* first, size_t count) {
  if (count <= most_in_cell) return;
  const int axis = widest_axis(first, count);
  const size_t half = count / 2;
  std::nth_element(
      first, first + half, first + count,
      [&](const ManifoldPhoton& a, const ManifoldPhoton& b) { return a.at[axis] < b.at[axis]; });
  first[half].axis = axis;
  divide_photons(first, half);
  divide_photons(first + half + 1, count - half - 1);
}

}  // namespace

double ManifoldPhotons::Cell::share(uint64_t lobes) const {
  if (count == 0) return 0;
  const auto alike = [&](const ManifoldPhoton& photon) { return photon.lobes == lobes; };
  return static_cast<double>(std::count_if(first, first + count, alike)) /
         static_cast<double>(count);
}

void ManifoldPhotons::add(const Vertex& x0, VertexKind y, const ManifoldPhoton& photon) {
  if (size_ == most) return;
  (y == VertexKind::camera ? at_lens_ : on_surfaces_)[x0.emitter].push_back(photon);
  ++size_;
}

void ManifoldPhotons::divide() {
  for (Photons* all : {&on_surfaces_, &at_lens_})
    for (auto& [emitter, photons] : *all) divide_photons(photons.data(), photons.size());
}

ManifoldPhotons::Cell ManifoldPhotons::near(const Vertex& x0, const Vertex& y) const {
  const Photons& all = y.kind == VertexKind::camera ? at_lens_ : on_surfaces_;
  const auto found = all.find(x0.emitter);
  if (found == all.end()) return {};
  Cell cell{found->second.data(), found->second.size()};
  while (cell.count > most_in_cell) {
    const uint64_t half = cell.count / 2;
    const ManifoldPhoton& middle = cell.first[half];
    const bool above = y.at.p[middle.axis] >= middle.at[middle.axis];
    cell = above ? Cell{&middle + 1, cell.count - half - 1} : Cell{cell.first, half};
  }
  return cell;
}

}  // namespace mlt
