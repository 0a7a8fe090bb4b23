// Groups whose samples are blocks of one sequence. Together they are stratified better than each of
// them: their mean has less variance than the spread of independent groups would tell. Blocks that
// are joined measure how much less. Let V_k be the variance of the mean as told by the spread of
// blocks of 2^k groups that follow each other; of independent groups all V_k are alike. With K the
// largest of which there are two, each join leaves r = (V_K / V_0)^(1/K) of the variance of the
// mean. G groups are joined log2 G times, so that theirs is
//
//   V = V_0 r^(log2 G).
//
// Light that one sample of all has found has r = 1.
#pragma once

#include "job/spread.h"

#include <vector>

namespace mlt {

class BlocksOfSequence {
 public:
  /// Adds the brightness of each pixel in the next group.
  void add(std::vector<float> brightness, double weight);
  /// V / V_0 in each tile of n x n pixels, as it and its neighbours tell; 1 where few pixels tell.
  std::vector<float> remaining(const Vec2i& size, int n) const;

 private:
  /// Blocks of 2^k groups. One without another of its size is left out.
  struct Level {
    Spread blocks;
    std::vector<float> first;  ///< The first block of a pair; empty between pairs.
    double first_weight = 0;
  };
  std::vector<Level> levels_;
};

}  // namespace mlt
