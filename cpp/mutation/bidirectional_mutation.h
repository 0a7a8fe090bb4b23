// The bidirectional mutation (Veach & Guibas 1997, sec. 5.3.1; Veach 1997, sec. 11.3.1): delete a piece
// of the path, grow new vertices from both ends of the gap, and connect them. It can change anything,
// including the length, so it makes the chain ergodic on its own.
//
// With x_l and x_m the vertices that stay on both sides of the gap (l = -1 or m = k + 1: no vertex
// stays there), c_d = m - l edges are deleted and c_a = s + t + 1 are added, of which s vertices come
// from the light side and t from the camera side. All ways (s, t) of making the same vertices are
// summed:
//
//   T(x -> y) = p_delete(l, m | x) p_length(c_a | c_d) sum_s p_way(s) p_s(inserted vertices)
#pragma once

#include "mutation/mutation.h"

namespace mlt {

class BidirectionalMutation : public Mutation {
 public:
  explicit BidirectionalMutation(const PathTarget& target)
      : Mutation("bidirectional"), target_(&target), scene_(&target.scene()) {}

  double suitability(const PathState&) const override { return 1; }
  bool ergodic() const override { return true; }
  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override;
  double density(const PathState& x, const PathState& y, const Edit& edit) const override;

 private:
  bool grow(PathState& y, int first, int count, int step, MutationContext& context) const;
  int most_edges() const { return target_->rules().most_edges(); }

  const PathTarget* target_;
  const Scene* scene_;
};

}  // namespace mlt
