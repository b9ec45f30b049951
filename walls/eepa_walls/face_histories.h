// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_FACE_HISTORIES_H
#define EEPA_WALLS_FACE_HISTORIES_H

#include <eepa/history.h>
#include <eepa/vector.h>

#include <array>
#include <cstddef>
#include <utility>
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

/// Contacts of one particle, in the order in which they began. The first one, mostly the only one, lies in the
/// list itself, so that a contact is one place of memory.
class FaceHistoryList {
 public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  const FaceHistory &operator[](std::size_t k) const { return k == 0 ? first_ : others_[k - 1]; }
  FaceHistory &operator[](std::size_t k) { return k == 0 ? first_ : others_[k - 1]; }

  void push_back(const FaceHistory &contact)
  {
    if (size_++ == 0)
      first_ = contact;
    else
      others_.push_back(contact);
  }
  /// Forgets the last ones. \param size  at most as many as there are
  void truncate(std::size_t size)
  {
    size_ = size;
    others_.resize(size > 1 ? size - 1 : 0);
  }

  double memory_of_others() const
  {
    return static_cast<double>(others_.capacity() * sizeof(FaceHistory));
  }

 private:
  std::size_t size_ = 0;
  FaceHistory first_;
  std::vector<FaceHistory> others_;
};

/// Histories of all particles of a process with a wall. Few of them touch it: a particle has an integer here,
/// one in contact a short list, and one that may come into contact room for it.
class FaceHistories {
 public:
  using List = FaceHistoryList;

  /// Makes room for particles. \param count  at least as many as before
  void grow(std::size_t count) { list_of_.resize(count, none); }
  /// For how many particles there is room.
  std::size_t places() const { return list_of_.size(); }

  /// Puts the lists in the order in which particles will be asked for, one after the other in memory. No list
  /// moves from then on while only these particles get contacts.
  /// \param particles  all whose contacts are kept: LAMMPS leaves places behind of particles that are gone
  void arrange(const std::vector<int> &particles)
  {
    spare_lists_.clear();
    spare_lists_.reserve(particles.size());
    spare_list_of_.assign(list_of_.size(), none);
    for (const int particle : particles) {
      if (!has_some(particle)) continue;
      spare_list_of_[particle] = static_cast<int>(spare_lists_.size());
      spare_lists_.push_back(std::move(lists_[list_of_[particle]]));
    }
    lists_.swap(spare_lists_);
    list_of_.swap(spare_list_of_);
    free_.clear();
  }

  bool has_some(int particle) const { return list_of_[particle] != none; }

  /// Contacts of a particle, in the order in which they began.
  const List &list(int particle) const
  {
    static const List empty;
    return has_some(particle) ? lists_[list_of_[particle]] : empty;
  }

  /// Fetch what has_some() and the list will read soon.
  void prefetch(int particle) const
  {
#if defined(__GNUC__) || defined(__clang__)
    __builtin_prefetch(&list_of_[particle]);
#else
    (void) particle;
#endif
  }
  void prefetch_list(int particle) const
  {
#if defined(__GNUC__) || defined(__clang__)
    if (!has_some(particle)) return;
    const auto *list = reinterpret_cast<const char *>(&lists_[list_of_[particle]]);
    for (std::size_t line = 0; line < sizeof(List); line += 64) __builtin_prefetch(list + line, 1);
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
    lists_[list_of_[particle]].truncate(0);
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
    const std::size_t numbers = list_of_.capacity() + spare_list_of_.capacity() + free_.capacity();
    const std::size_t lists = lists_.capacity() + spare_lists_.capacity();
    auto bytes = static_cast<double>(numbers * sizeof(int) + lists * sizeof(List));
    for (const List &list : lists_) bytes += list.memory_of_others();
    return bytes;
  }

 private:
  static constexpr int none = -1;

  std::vector<int> list_of_;
  std::vector<List> lists_;
  std::vector<int> free_;
  // of the arrangement before, kept so that no memory is asked for where lists are arranged in every step
  std::vector<int> spare_list_of_;
  std::vector<List> spare_lists_;
};

}    // namespace eepa

#endif
