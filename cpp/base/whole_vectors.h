#pragma once

namespace mlt {

/// A count, rounded up to a multiple of 8: loops over so many floats have no rest of single steps.
constexpr int whole_vectors(int count) { return (count + 7) / 8 * 8; }

}  // namespace mlt
