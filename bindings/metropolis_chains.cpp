#include "metropolis_chains.h"

#include "lab/lockstep.h"

namespace mlt::python {

using lab::Point;

namespace {

Doubles checked(const py::object& returned, size_t count, const std::string& what) {
  Doubles array = Doubles::ensure(returned);
  if (!array) PyErr_Clear();
  if (!array || array.ndim() != 1 || static_cast<size_t>(array.size()) != count)
    throw UsageError("vectorized: " + what + " must return an array of " + std::to_string(count) +
                     " numbers, one for each chain that it was given");
  return array;
}

}  // namespace

VectorChains::VectorChains(const Numbers& space, py::object target,
                           const lab::Prototypes<Point>& moves, std::vector<py::object> vectorized,
                           const std::vector<Point>& starts, uint64_t seed)
    : space_(space),
      function_(std::move(target)),
      vectorized_(std::move(vectorized)),
      rng_(seed, Purpose::chain, starts.size()),
      generators_(rng_) {
  const std::vector<double> values = evaluate(starts);
  for (size_t c = 0; c < starts.size(); ++c)
    chains_.emplace_back(starts[c], values[c], moves, seed, c);
}

py::dict VectorChains::advance(size_t steps, bool expected_values) {
  Trace<Numbers> trace(space_, chains_.size(), steps, expected_values);
  const auto draw_all = [&](size_t move, const std::vector<size_t>& group) {
    if (!vectorized_[move].is_none()) return draw(vectorized_[move], group);
    for (const size_t c : group) chains_[c].draw();
  };
  const auto evaluate_all = [&](const std::vector<Point>& points) { return evaluate(points); };
  for (size_t i = 0; i < steps; ++i)
    lab::step_together(chains_, draw_all, evaluate_all, [&](size_t c, lab::Chain<Point>& chain) {
      trace.step(c, i, chain, [&](const auto& record) { return chain.finish(record); });
    });
  return trace.take();
}

py::object VectorChains::to_array(const std::vector<Point>& points) const {
  py::array_t<double> array(std::vector<size_t>{points.size(), space_.dimensions});
  double* data = array.mutable_data();
  for (const Point& p : points) data = std::copy(p.begin(), p.end(), data);
  if (space_.form == Numbers::Form::array) return array;
  py::object flat = array.reshape({-1});
  return space_.form == Numbers::Form::number ? flat : flat.attr("astype")("int64");
}

std::vector<double> VectorChains::evaluate(const std::vector<Point>& points) const {
  const Doubles values = checked(function_(to_array(points)), points.size(), "the target");
  return {values.data(), values.data() + values.size()};
}

void VectorChains::draw(const py::object& move, const std::vector<size_t>& group) {
  const size_t count = group.size(), width = space_.dimensions;
  std::vector<Point> states;
  for (const size_t c : group) states.push_back(chains_[c].state().x);
  const py::object x = to_array(states);
  const py::object proposed = move.attr("propose")(x, *RandomGenerators::Use(generators_, rng_));
  const Doubles y = Doubles::ensure(proposed);
  if (!y) PyErr_Clear();
  if (!y || static_cast<size_t>(y.size()) != count * width ||
      static_cast<size_t>(y.shape(0)) != count)
    throw UsageError("vectorized: propose(x, rng) must return an array of the shape of x");
  Doubles forward, backward;
  const bool symmetric = move.attr("symmetric").cast<bool>();
  if (!symmetric) {
    forward = checked(move.attr("density")(x, proposed), count, "density(x, y)");
    backward = checked(move.attr("density")(proposed, x), count, "density(x, y)");
  }
  for (size_t i = 0; i < count; ++i) {
    const double* p = y.data() + i * width;
    chains_[group[i]].set_proposal(Point(p, p + width), symmetric ? 1 : forward.data()[i],
                                   symmetric ? 1 : backward.data()[i]);
  }
}

}  // namespace mlt::python
