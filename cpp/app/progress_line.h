// One line on a terminal that is updated in place: " 42 % |████      | 12.5 spp, 3.1 s".
#pragma once

#include "app/streams.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <string>

namespace mlt {

class ProgressLine {
 public:
  explicit ProgressLine(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO)) {}
  ~ProgressLine() { clear(); }

  void update(double progress, double spp) {
    if (!shown_) return;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    const int filled = static_cast<int>(progress * width);
    std::string bar;
    for (int i = 0; i < width; ++i) bar += i < filled ? "█" : " ";
    write_to_stderr(fmt::format("\r{:3.0f} % |{}| {:.4g} spp, {:.1f} s\x1b[K", 100 * progress, bar,
                                spp, elapsed.count()));
    dirty_ = true;
  }

  void clear() {
    if (dirty_) write_to_stderr("\r\x1b[K");
    dirty_ = false;
  }

 private:
  static constexpr int width = 30;

  bool shown_, dirty_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace mlt
