// The division of a render into units, and the dependencies between them. The terms are explained
// in docs/notation.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace mlt {

/// Some of the strands of a render: first ... last - 1.
struct Strands {
  uint64_t first = 0, last = ~uint64_t{0};

  bool has(uint64_t strand) const { return first <= strand && strand < last; }
};

/// The units from ... to - 1 of some strands; by default all that there are.
struct Task {
  Strands strands;
  uint64_t from = 0, to = ~uint64_t{0};
};

/// Units are numbered 0, 1, 2, ..., one pass after the other, and are started in that order.
struct Plan {
  uint64_t units_per_pass = 1;
  /// At each multiple of this number of units all groups that have begun are equally far.
  uint64_t units_per_group_turn = 1;
  /// The strand that a unit belongs to; after units_per_cycle units each strand has had its turn.
  std::function<uint64_t(uint64_t)> strand_of = [](uint64_t) { return 0; };
  uint64_t units_per_cycle = 1;
  /// Assigns runs of `units` units to the strands in turn.
  void take_turns(uint64_t strands, uint64_t units) {
    strand_of = [=](uint64_t unit) { return unit / units % strands; };
    units_per_cycle = units * strands;
  }
  /// Samples of one pass, and the pixels that they are spread over.
  double samples_per_pass = 1, pixels = 1;
  /// First strands of the sequences that no task reaches across, and the number of all strands.
  std::vector<uint64_t> borders = {0, 1};

  /// The least number of units of a render.
  uint64_t least_units = 0;

  /// How many units `spp` samples per pixel take.
  uint64_t unit_count(double spp) const {
    return std::max(least_units, static_cast<uint64_t>(std::ceil(spp * pixels / samples_per_pass)) *
                                     units_per_pass);
  }
  double spp_done(uint64_t units) const {
    return static_cast<double>(units) / static_cast<double>(units_per_pass) * samples_per_pass /
           pixels;
  }

  uint64_t strand_count() const { return borders.back(); }

  /// Cuts all strands into `wanted` sequences, or as near to it as their borders allow.
  std::vector<Strands> cut(int wanted) const {
    const uint64_t sequences = std::max<uint64_t>(1, borders.size() - 1);
    const uint64_t each = (std::max(1, wanted) + sequences - 1) / sequences;
    std::vector<Strands> cut;
    for (size_t i = 0; i + 1 < borders.size(); ++i) {
      const uint64_t first = borders[i], size = borders[i + 1] - first;
      const uint64_t count = std::min(each, size);
      for (uint64_t j = 0; j < count; ++j)
        cut.push_back({first + size * j / count, first + size * (j + 1) / count});
    }
    return cut;
  }
};

}  // namespace mlt
