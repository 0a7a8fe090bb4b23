// A mutation whose density is one formula for any measure: a Derived class has
//
//   template <class Measure>
//   double density_in(const Measure& measure, x, y, edit) const
#pragma once

#include "mutation/mutation.h"
#include "path/measure.h"

namespace mlt {

template <class Derived>
class MeasuredMutation : public Mutation {
 public:
  using Mutation::Mutation;

  double density(const PathState& x, const PathState& y, const Edit& edit) const final {
    return self().density_in(AreaMeasure{y.terms}, x, y, edit);
  }
  double relative_density(const PathState& x, const PathState& y, const Edit& edit) const final {
    return self().density_in(ContributionMeasure{y.terms}, x, y, edit);
  }

 private:
  const Derived& self() const { return static_cast<const Derived&>(*this); }
};

}  // namespace mlt
