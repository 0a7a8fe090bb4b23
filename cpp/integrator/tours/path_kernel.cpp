#include "integrator/tours/path_kernel.h"

namespace mlt {

std::vector<MutationStats> path_kernel_rows(const Mutations& mutations,
                                            const MixtureWeights& weights) {
  std::vector<MutationStats> rows;
  for (size_t i = 0; i < mutations.size(); ++i)
    for (size_t k = 0; k <= longest_row; ++k) {
      MutationStats row;
      row.name = mutations[i]->name();
      row.length = static_cast<int>(k);
      row.weight = weights[k][i];
      rows.push_back(row);
    }
  return rows;
}

}  // namespace mlt
