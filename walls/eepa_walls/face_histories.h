// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_FACE_HISTORIES_H
#define EEPA_WALLS_FACE_HISTORIES_H

#include <eepa/history.h>
#include <eepa/vector.h>

#include <array>
#include <cstddef>
#include <vector>

namespace eepa {

/// What a contact of a particle and a face remembers.
struct FaceHistory {
  int face = 0;    ///< see Shape
  /// place of the centre in the step before, relative to the face: unit normal in the shape's frame, or 0
  /// where it is not known, and distance [length]
  Vec3 normal = Vec3::Zero();
  double distance = 0.0;
  std::array<double, max_history_size> values{};    ///< see HistoryIndex
};

/// Histories of all particles of a process with a wall. Few of them touch it, so that a particle
/// without contacts has one integer here, and one in contact a short list.
class FaceHistories {
 public:
  using List = std::vector<FaceHistory>;

  /// Makes room for particles. \param count  at least as many as before
  void grow(std::size_t count) { list_of_.resize(count, none); }

  bool has_some(int particle) const { return list_of_[particle] != none; }

  /// Contacts of a particle, in the order in which they began.
  const List &list(int particle) const
  {
    static const List empty;
    return has_some(particle) ? lists_[list_of_[particle]] : empty;
  }

  /// Fetches a list that will be read soon, and its contacts, which is of use once the list is there.
  void prefetch_list(int particle) const
  {
#if defined(__GNUC__) || defined(__clang__)
    if (has_some(particle)) __builtin_prefetch(&lists_[list_of_[particle]]);
#else
    (void) particle;
#endif
  }
  void prefetch_contacts(int particle) const
  {
#if defined(__GNUC__) || defined(__clang__)
    if (!has_some(particle)) return;
    const auto *first = reinterpret_cast<const char *>(lists_[list_of_[particle]].data());
    for (std::size_t line = 0; line < sizeof(FaceHistory); line += 64)
      __builtin_prefetch(first + line, 1);
#else
    (void) particle;
#endif
  }

  /// The same, to be changed; release() has to be called when it may have become empty.
  List &mutable_list(int particle)
  {
    int &which = list_of_[particle];
    if (which == none) {
      if (free_.empty()) {
        free_.push_back(static_cast<int>(lists_.size()));
        lists_.emplace_back();
      }
      which = free_.back();
      free_.pop_back();
    }
    return lists_[which];
  }

  void release(int particle)
  {
    const int which = list_of_[particle];
    if (which == none || !lists_[which].empty()) return;
    free_.push_back(which);
    list_of_[particle] = none;
  }

  void clear(int particle)
  {
    if (!has_some(particle)) return;
    lists_[list_of_[particle]].clear();
    release(particle);
  }

  /// Gives `to` the contacts of `from`, which keeps them.
  void copy(int from, int to)
  {
    if (from == to) return;
    clear(to);
    if (!has_some(from)) return;
    List &list = mutable_list(to);    // may move the lists
    list = lists_[list_of_[from]];
  }

  double memory_usage() const
  {
    std::size_t bytes = list_of_.capacity() * sizeof(int) + free_.capacity() * sizeof(int) +
        lists_.capacity() * sizeof(List);
    for (const List &list : lists_) bytes += list.capacity() * sizeof(FaceHistory);
    return static_cast<double>(bytes);
  }

 private:
  static constexpr int none = -1;

  std::vector<int> list_of_;
  std::vector<List> lists_;
  std::vector<int> free_;
};

}    // namespace eepa

#endif
