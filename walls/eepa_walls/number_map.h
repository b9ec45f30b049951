// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_NUMBER_MAP_H
#define EEPA_WALLS_NUMBER_MAP_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace eepa {

/// A map from numbers to small numbers that is emptied at no cost and keeps its memory.
class NumberMap {
 public:
  /// Empties it and makes room for as many keys.
  void clear(std::size_t keys)
  {
    std::size_t size = slots_.size();
    if (size < 2 * keys) {
      if (size == 0) size = 64;
      while (size < 2 * keys) size *= 2;
      slots_.assign(size, Slot());
      generation_ = 0;
    }
    ++generation_;
  }

  /// The value of a key; `value`, which it has from now on, when the key is new.
  int insert(std::int64_t key, int value)
  {
    Slot &slot = slot_of(key);
    if (slot.generation != generation_) slot = {key, generation_, value};
    return slot.value;
  }

  bool contains(std::int64_t key) { return slot_of(key).generation == generation_; }

 private:
  struct Slot {
    std::int64_t key = 0;
    std::uint64_t generation = 0;
    int value = 0;
  };

  Slot &slot_of(std::int64_t key)
  {
    const std::size_t mask = slots_.size() - 1;
    const std::uint64_t h = static_cast<std::uint64_t>(key) * 0x9e3779b97f4a7c15u;
    std::size_t i = (h >> 32) & mask;
    while (slots_[i].generation == generation_ && slots_[i].key != key) i = (i + 1) & mask;
    return slots_[i];
  }

  std::vector<Slot> slots_;
  std::uint64_t generation_ = 0;
};

}    // namespace eepa

#endif
