#include "rendering/metropolis_chain.h"

namespace mlt {

ChainStats::Row& ChainStats::Row::operator+=(const Row& other) {
  proposed += other.proposed;
  generated += other.generated;
  accepted += other.accepted;
  rays += other.rays;
  acceptance += other.acceptance;
  image_distance += other.image_distance;
  failed_walks += other.failed_walks;
  failed_returns += other.failed_returns;
  return *this;
}

void ChainStats::count(Row& row, const StepResult& result, bool generated, double moved) {
  ++row.proposed;
  row.generated += generated;
  row.acceptance += result.acceptance;
  invalid += result.invalid;
  if (result.accepted < 0) {
    ++run;
    return;
  }
  ++row.accepted;
  row.image_distance += moved;
  run = 0;
}

void ChainStats::save(ByteWriter& bytes) const {
  bytes.write(rows);
  bytes.write(rays);
  bytes.write(invalid);
  bytes.write(run);
  bytes.write(longest.rejections);
  bytes.write(longest.raster);
  bytes.write(longest.signature);
  bytes.write(tours);
  bytes.write(longest_tour);
}

void ChainStats::load(ByteReader& bytes) {
  const size_t expected = rows.size();
  bytes.read(rows);
  if (rows.size() != expected) throw RenderError("the saved state counts other mutations");
  rays = bytes.read<RayCounts>();
  invalid = bytes.read<uint64_t>();
  run = bytes.read<uint64_t>();
  longest.rejections = bytes.read<uint64_t>();
  longest.raster = bytes.read<Vec2>();
  bytes.read(longest.signature);
  bytes.read(tours);
  bytes.read(longest_tour);
}

void add_rows(const std::vector<MutationStats>& names, const std::vector<ChainStats::Row>& rows,
              Stats& stats) {
  for (size_t r = 0; r < rows.size(); ++r) {
    const ChainStats::Row& row = rows[r];
    if (row.proposed == 0) continue;
    MutationStats m = names[r];
    const double n = static_cast<double>(row.proposed);
    m.proposed = row.proposed;
    m.generated = row.generated;
    m.accepted = row.accepted;
    m.rays = row.rays;
    m.failed_walks = row.failed_walks;
    m.failed_returns = row.failed_returns;
    m.mean_acceptance = row.acceptance / n;
    m.image_distance = row.image_distance / n;
    stats.mutations.push_back(m);
  }
}

RenderError no_light_found(uint64_t samples) {
  return RenderError("no light path was found among " + std::to_string(samples) +
                     " bootstrap samples; give more luminance_samples, or check that light can "
                     "reach the camera");
}

}  // namespace mlt
