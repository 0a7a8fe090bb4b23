#include "render/division.h"

#include "base/parallel.h"

#include <algorithm>

namespace mlt {
namespace {

struct OrderHead {
  uint64_t seed;
  Work work;
};

struct OutcomeHead {
  Work work;
  uint64_t reached, units;
};

}  // namespace

Division::Division(Rendering& rendering, uint64_t seed, int wanted_parts, uint64_t done)
    : rendering_(&rendering), seed_(seed) {
  for (const Part& part : rendering.parts(wanted_parts)) pieces_.push_back({part, done});
}

uint64_t Division::done() const {
  uint64_t least = ~uint64_t{0};
  for (const Piece& piece : pieces_) least = std::min(least, piece.position);
  return least;
}

bool Division::split(size_t part) {
  Piece& piece = pieces_.at(part);
  const uint64_t middle = (piece.part.first + piece.part.last) / 2;
  if (middle == piece.part.first) return false;
  const Piece second{{middle, piece.part.last}, piece.position};
  piece.part.last = middle;
  pieces_.push_back(second);
  return true;
}

bool Division::pass(size_t part, uint64_t to) {
  Piece& piece = pieces_.at(part);
  for (uint64_t unit = piece.position; unit < to; ++unit)
    if (const uint64_t share = rendering_->share_of(unit);
        piece.part.first <= share && share < piece.part.last)
      return false;
  piece.position = std::max(piece.position, to);
  return true;
}

std::string Division::order(size_t part, uint64_t to) const {
  const Piece& piece = pieces_.at(part);
  ByteWriter bytes;
  const Work work{piece.part, piece.position, to};
  bytes.write(OrderHead{seed_, work});
  bytes.write(rendering_->lend(work));
  return bytes.take();
}

uint64_t Division::fold(size_t part, const std::string& outcome) {
  Piece& piece = pieces_.at(part);
  ByteReader bytes(outcome);
  const auto head = bytes.read<OutcomeHead>();
  std::string given_back;
  bytes.read(given_back);
  bytes.finish();
  const Part& shares = head.work.part;
  if (shares.first != piece.part.first || shares.last != piece.part.last ||
      head.work.from != piece.position || head.reached < piece.position)
    throw RenderError("a part of the render came back that nobody waits for");
  rendering_->take_back(head.work, given_back);
  piece.position = head.reached;
  return head.units;
}

std::string carry_out(const std::string& order, ScenePtr scene, const Integrator& integrator,
                      int threads, const std::atomic<bool>& cancelled) {
  ByteReader bytes(order);
  const auto head = bytes.read<OrderHead>();
  std::string lent;
  bytes.read(lent);
  bytes.finish();
  const Work& work = head.work;
  const std::unique_ptr<Rendering> rendering = integrator.start(std::move(scene), head.seed);
  rendering->borrow(work, lent);
  lent.clear();

  std::atomic<uint64_t> next{work.from}, units{0};
  parallel_for(threads, threads, [&](uint64_t) {
    while (!cancelled) {
      const uint64_t unit = next++;
      if (unit >= work.to) break;
      const uint64_t share = rendering->share_of(unit);
      if (share < work.part.first || share >= work.part.last) continue;
      rendering->run_unit(unit);
      ++units;
    }
  });
  ByteWriter outcome;
  // Units are handed out in order, and each one that was has been finished.
  outcome.write(OutcomeHead{work, std::min<uint64_t>(next, work.to), units});
  outcome.write(rendering->give_back(work));
  return outcome.take();
}

}  // namespace mlt
