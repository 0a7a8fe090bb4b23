#pragma once

namespace mlt {

/// A count, rounded up to a multiple of 8, so that loops over floats need no scalar remainder.
constexpr int whole_vectors(int count) { return (count + 7) / 8 * 8; }

}  // namespace mlt
