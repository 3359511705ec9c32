#pragma once
// Objects that stay where they are until all are given back: blocks, so that growing moves nothing.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ringcraft {

template <class T>
class Arena {
 public:
  // `count` neighbours, as whoever had them last left them.
  T* take(std::size_t count) {
    while (block_ < blocks_.size() && used_ + count > blocks_[block_].size()) ++block_, used_ = 0;
    if (block_ == blocks_.size()) blocks_.emplace_back(std::max(count, kBlock));
    T* first = blocks_[block_].data() + used_;
    used_ += count;
    size_ += count;
    return first;
  }
  void clear() { block_ = used_ = size_ = 0; }
  std::size_t size() const { return size_; }

 private:
  static constexpr std::size_t kBlock = 256;

  std::vector<std::vector<T>> blocks_;
  std::size_t block_ = 0, used_ = 0, size_ = 0;
};

}  // namespace ringcraft
