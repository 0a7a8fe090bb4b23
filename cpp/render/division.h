// A render divided among machines. The owner keeps the whole state; for each part it writes an order,
// "units [from, to) of these shares, and this is where they stand", which any machine with the same
// scene, integrator and seed can carry out, any number of times with the same outcome. What comes
// back is folded once. The pixels have the same bits as if one machine had run all units.
#pragma once

#include "base/bytes.h"
#include "integrator/integrator.h"

#include <atomic>
#include <string>
#include <vector>

namespace mlt {

/// The owner's side. Not for several threads at once.
class Division {
 public:
  /// `rendering` has been prepared, and its units 0 ... `done` - 1 have run; it outlives this.
  Division(Rendering& rendering, uint64_t seed, int wanted_parts, uint64_t done);

  size_t parts() const { return pieces_.size(); }
  /// Up to which unit the part's shares are done.
  uint64_t position(size_t part) const { return pieces_.at(part).position; }
  /// The units before this one are done, perhaps with some others.
  uint64_t done() const;
  /// Cuts a part in two, for more machines; false if it is a single share. The second half is the last
  /// part then.
  bool split(size_t part);
  /// Moves the part on to the unit `to` if it has nothing to do until there.
  bool pass(size_t part, uint64_t to);
  /// To take the part from where it stands to the unit `to`.
  std::string order(size_t part, uint64_t to) const;
  /// Folds the outcome of such an order; returns how many units have been done.
  /// Throws RenderError if the part does not stand where the order began: nothing counts twice.
  uint64_t fold(size_t part, const std::string& outcome);

 private:
  struct Piece {
    Part part;
    uint64_t position = 0;
  };
  Rendering* rendering_;
  uint64_t seed_;
  std::vector<Piece> pieces_;
};

/// The other side: carries out an order on `threads` threads and returns its outcome. When `cancelled`
/// becomes true it stops early, and the outcome tells how far it came.
std::string carry_out(const std::string& order, ScenePtr scene, const Integrator& integrator,
                      int threads, const std::atomic<bool>& cancelled);

}  // namespace mlt
