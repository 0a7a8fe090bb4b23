#include "base/abandon.h"

namespace mlt {
namespace {

thread_local const std::atomic<bool>* current_flag = nullptr;

}  // namespace

Abandonable::Abandonable(const std::atomic<bool>* flag) : outer_(current_flag) {
  current_flag = flag;
}

Abandonable::~Abandonable() { current_flag = outer_; }

const std::atomic<bool>* Abandonable::current() { return current_flag; }

void check_abandoned() {
  if (current_flag && *current_flag) throw Abandoned();
}

}  // namespace mlt
