// The order of the units in a render with two kinds of them: a pass of samples, then rounds of
// another pass and a fixed number of units of chains.
#pragma once

#include <cstdint>

namespace mlt {

class Interleaving {
 public:
  /// `tiles`: units of a pass of samples, `chain_units`: those of the chains in a round. Either may
  /// be 0.
  Interleaving(uint64_t tiles = 0, uint64_t chain_units = 1)
      : tiles_(tiles), chain_units_(chain_units) {}

  struct Place {
    bool sampled;     ///< Whether it is a unit of samples; else of chains.
    uint64_t number;  ///< Number among the units of its kind.
  };
  Place place_of(uint64_t unit) const {
    if (unit < tiles_) return {true, unit};
    const uint64_t round = (unit - tiles_) / units_per_round(),
                   k = (unit - tiles_) % units_per_round();
    if (k < tiles_) return {true, (1 + round) * tiles_ + k};
    return {false, round * chain_units_ + k - tiles_};
  }
  /// How many units of samples there are before this unit.
  uint64_t sampled_before(uint64_t unit) const {
    const Place place = place_of(unit);
    return place.sampled ? place.number : unit - place.number;
  }
  uint64_t units_per_round() const { return tiles_ + chain_units_; }

 private:
  uint64_t tiles_, chain_units_;
};

}  // namespace mlt
