#include "wave/number_rows.h"

namespace mlt {

void NumberRows::draw_fresh(int begin, int end, uint32_t changed_key, Rows<double>& u) const {
  for (int i = begin; i < end; ++i) {
    const uint32_t bits = mix_bits_32(mix_bits_32(low_[i]) ^ high_[i] ^ changed_key);
    u[i] = unit_interval(uint64_t{bits} << 32);
  }
}

void NumberRows::draw(const SmallStep& step) {
  draw_fresh(row * fresh_, row * capacity, 0, u_);
  const int end = row * moving_;
  draw_fresh(0, end, 0, u_);
  if (step.shape == SmallStep::Shape::kelemen) {
    for (int i = 0; i < end; ++i) u_[i] = step.kelemen(x_[i], u_[i]);
    return;
  }
  draw_fresh(0, end, angle_key, angle_);
  for (int i = 0; i < end; ++i) u_[i] = step.gaussian(x_[i], u_[i], angle_[i]);
}

}  // namespace mlt
