// A rendering whose groups are given.
#pragma once

#include "rendering/integrator.h"

namespace mlt {

class Given : public Rendering {
 public:
  /// Groups of equal weight.
  Given(std::vector<Image> groups, Image common, bool share_sequence = false)
      : Rendering(nullptr, 1), common_(std::move(common)), share_sequence_(share_sequence) {
    for (Image& image : groups) groups_.push_back({std::move(image), 1});
  }
  Given(std::vector<GroupImage> groups, std::vector<const Rendering*> parts)
      : Rendering(nullptr, 1), groups_(std::move(groups)), parts_(std::move(parts)) {}

  GroupImage group(int index, int) const override {
    return index < static_cast<int>(groups_.size()) ? groups_[index] : GroupImage();
  }
  std::vector<const Rendering*> parts() const override { return parts_; }
  Image common_error(int) const override { return common_; }
  bool groups_share_sequence() const override { return share_sequence_; }

  Memory memory(double) const override { return {}; }
  void run_unit(uint64_t) override {}
  Image image(int) const override { return {}; }
  void add_stats(Stats&) const override {}
  std::string save(const Task&, Content) const override { return {}; }
  void load(const std::string&) override {}

 private:
  std::vector<GroupImage> groups_;
  std::vector<const Rendering*> parts_;
  Image common_;
  bool share_sequence_ = false;
};

}  // namespace mlt
