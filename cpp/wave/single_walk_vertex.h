// A vertex of a subpath in a wave that is not Lambertian, or a point on a light that is neither an
// emissive mesh nor at infinity: it is computed alone, in double precision, by the functions of
// cpp/path.
#pragma once

#include "path/mis.h"
#include "path/subpath.h"

#include <memory>
#include <vector>

namespace mlt {

struct SingleWalkVertex {
  WalkVertex x;
  /// What the technique with its joint before the vertex adds to the sums (TechniqueSums), for a
  /// path that is joined there.
  double technique = 0;
  double sums_before = 0;     ///< The sums for a walk that goes on at the vertex before it.
  double forward_before = 1;  ///< WalkVertex::forward of that.

  /// JointLanes::sums where the other walk has the density `back`, in projected solid angle, of the
  /// direction to the previous vertex.
  double sums(const MisExponent& beta, double back) const {
    return technique + sums_over(beta, back);
  }
  /// The sums for a walk that goes on here, in place of a connection.
  double walk_sums(const MisExponent& beta, double back) const {
    return (x.vertex.delta() ? 0 : technique) + sums_over(beta, back);
  }

 private:
  double sums_over(const MisExponent& beta, double back) const {
    if (sums_before == 0) return 0;  // also where the quotient is infinite
    return beta.over(sums_before, x.density_back(back) / forward_before);
  }
};

/// Vertices that do not move; all are freed together.
class SingleWalkVertices {
 public:
  void clear() { count_ = 0; }
  SingleWalkVertex& add() {
    if (count_ == chunks_.size() * chunk_size)
      chunks_.push_back(std::make_unique<SingleWalkVertex[]>(chunk_size));
    SingleWalkVertex& added = chunks_[count_ / chunk_size][count_ % chunk_size];
    ++count_;
    return added = {};
  }

 private:
  static constexpr size_t chunk_size = 32;
  std::vector<std::unique_ptr<SingleWalkVertex[]>> chunks_;
  size_t count_ = 0;  ///< How many are in use.
};

}  // namespace mlt
