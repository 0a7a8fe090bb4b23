// Chains that advance step by step together, for targets and moves that take the states of many
// chains at once.
#pragma once

#include "lab/lab.h"

#include <map>

namespace mlt::lab {

/// Takes one step of all chains. `draw(move, chains)` lets a move propose for the chains that have
/// chosen it, by index; `evaluate(points)` returns the target at one point of each chain;
/// `finish(c, chain)` ends the step of chain c.
template <class X, class Draw, class Evaluate, class Finish>
void step_together(std::vector<Chain<X>>& chains, Draw&& draw, Evaluate&& evaluate,
                   Finish&& finish) {
  std::map<size_t, std::vector<size_t>> chosen;
  for (size_t c = 0; c < chains.size(); ++c)
    if (chains[c].choose()) chosen[chains[c].kernel().chosen()].push_back(c);
  for (const auto& [move, group] : chosen) draw(move, group);
  std::vector<X> points;
  for (const Chain<X>& chain : chains)
    points.push_back(chain.proposed() ? chain.other().x : chain.state().x);
  const auto values = evaluate(points);
  for (size_t c = 0; c < chains.size(); ++c) {
    if (chains[c].proposed()) chains[c].set_target(values[c]);
    finish(c, chains[c]);
  }
}

}  // namespace mlt::lab
