// Sources of uniform numbers for a walk. All have next(), next2(), and begin(stream), which sets
// the purpose of the numbers that follow; walks are templates over them.
#pragma once

#include "base/rng.h"
#include "math/low_discrepancy.h"
#include "math/vec.h"

namespace mlt {

/// The purposes of random numbers: the walk from the camera, that from the light, and next-event
/// estimation at the vertices of the former.
enum class Stream { camera, light, direct };
inline constexpr size_t stream_count = 3;

/// Independent random numbers.
class RandomSampler {
 public:
  explicit RandomSampler(Rng& rng) : rng_(&rng) {}
  void begin(Stream) {}
  double next() { return rng_->next(); }
  Vec2 next2() {
    const double x = rng_->next();
    return {x, rng_->next()};
  }

 private:
  Rng* rng_;
};

/// The place of a sample in its sequence. Where the shutter has several exposures that are kept
/// apart, each of them has a sample there, with the same numbers but for the time.
struct SampleIndex {
  SampleIndex(uint32_t place) : place(place) {}
  SampleIndex(uint32_t place, uint16_t exposure, uint16_t exposures)
      : place(place), exposure(exposure), exposures(exposures) {}

  /// The number of the time, by that of the sequence.
  double time(double u) const { return exposures == 1 ? u : (exposure + u) / exposures; }

  uint32_t place;
  uint16_t exposure = 0, exposures = 1;
};

/// The samples of one pixel: the first numbers and the first pairs are stratified over the pixel's
/// samples, the others are independent. Each is computed directly from its position.
class PixelSampler {
 public:
  /// Stratified pairs: image position, lens, and the light and direction of the first vertices.
  static constexpr uint32_t stratified_pairs = 6;
  /// Stratified numbers: time, wavelength, and those of the first vertices: choice of a light, of a
  /// lobe, roulette.
  static constexpr uint32_t stratified_singles = 8;
  struct Position {
    uint32_t pairs = 0;    ///< Stratified pairs that have been taken.
    uint32_t singles = 0;  ///< Stratified numbers that have been taken.
    uint32_t words = 0;    ///< Independent numbers that have been taken.
    uint32_t last_pair = stratified_pairs, last_single = stratified_singles;

    bool stratified_pair() const { return pairs < last_pair; }
    bool stratified_single() const { return singles < last_single; }
    /// The places of the next numbers, as if it were a sampler.
    Position next() {
      const Position at = *this;
      ++(stratified_single() ? singles : words);
      return at;
    }
    Position next2() {
      const Position at = *this;
      if (stratified_pair())
        ++pairs;
      else
        words += 2;
      return at;
    }

    /// Where the numbers of a stream begin, whatever the others have taken: those of the camera
    /// after the image position, those of the light with its position and direction, and direct
    /// light with the lens and the vertex after it.
    Position begin(Stream stream) const {
      constexpr uint32_t words_of_stream = 1 << 20;  // a walk has most_edges() vertices at most
      switch (stream) {
        case Stream::camera: break;
        case Stream::light: return {4, 8, words_of_stream, 6, 12};
        case Stream::direct: return {6, 12, 2 * words_of_stream, 8, 14};
      }
      return {pairs, singles, words, 4, 8};
    }
  };

  /// `stream` names the sequence (seed, group and pixel).
  PixelSampler(uint64_t stream, const SampleIndex& index)
      : stream_(stream), key_(key_of(stream, index.place)), index_(index) {
    uint32_t indices[lanes];
    uint64_t seeds[lanes];
    for (uint32_t i = 0; i < lanes; ++i) {
      indices[i] = index.place;
      seeds[i] = stream + i;
    }
    scrambled_sobol<lanes>(indices, seeds, x_, y_);
  }

  void begin(Stream stream) { at_ = at_.begin(stream); }
  double next() {
    const Position at = at_.next();
    if (!at.stratified_single()) return word(at.words);
    return single(stream_, index_, at);
  }
  Vec2 next2() {
    const Position at = at_.next2();
    if (at.stratified_pair()) return {x_[at.pairs], y_[at.pairs]};
    return {word(at.words), word(at.words + 1)};
  }

  /// The sequence of a stratified number; it comes after those of all pairs.
  static uint64_t seed_of_single(uint64_t stream, const Position& at) {
    return stream + lanes + at.singles;
  }
  static double single(uint64_t stream, const SampleIndex& index, const Position& at) {
    const double u = scrambled_radical_inverse(index.place, seed_of_single(stream, at));
    return is_time(at) ? index.time(u) : u;
  }
  /// Whether a stratified number is that of the time.
  static bool is_time(const Position& at) { return at.singles == 0; }

  uint64_t stream() const { return stream_; }
  const SampleIndex& index() const { return index_; }
  const Position& position() const { return at_; }
  /// The key of the independent numbers.
  static uint64_t key_of(uint64_t stream, uint32_t index) {
    return mix_bits(mix_bits(mix_bits(stream) ^ static_cast<uint64_t>(Purpose::pixel)) ^ index);
  }

 private:
  double word(uint64_t n) const { return unit_interval(nth_bits(key_, n)); }

  static constexpr uint32_t lanes = 8;  ///< Enough for the stratified pairs of all streams.

  uint64_t stream_, key_;
  SampleIndex index_;
  Position at_;
  double x_[lanes], y_[lanes];  ///< The stratified pairs.
};

}  // namespace mlt
