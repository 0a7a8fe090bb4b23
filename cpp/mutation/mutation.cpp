#include "mutation/mutation.h"

namespace mlt {

double Mutation::relative_density(const PathState& x, const PathState& y, const Edit& edit) const {
  const int first = std::max(0, edit.first - 1);
  const int last = std::min(y.edges(), edit.first + edit.inserted);
  const double p = density(x, y, edit);
  return p == 0 ? 0 : p / magnitude(y.terms, first, last);
}

}  // namespace mlt
