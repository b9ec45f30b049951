// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_CANDIDATES_H
#define EEPA_WALLS_CANDIDATES_H

#include "shape.h"

#include <cstddef>
#include <vector>

namespace eepa {

/// The particles that may touch a shape until they are collected again, with the pieces of it that each
/// may touch.
///
/// A piece that was a distance away from a particle's centre can not be touched before the centre has
/// come nearer by that distance less the radius. So each particle is kept with its centre at that time,
/// and its pieces with their distances: from how far the centre has moved since then follows how many
/// pieces, of all that are within the reach, can be touched at present.
class Candidates {
 public:
  void clear()
  {
    particles_.clear();
    radii_.clear();
    centres_.clear();
    pieces_.clear();
    first_piece_.assign(1, 0);
  }

  /// Takes a particle in if it may touch the shape.
  /// \param centre  in the shape's frame
  /// \param margin  how far its centre may move [length]
  /// \param always  whether it is taken in even if it can not touch
  void add(int particle, const Vec3 &centre, double radius, double margin, const Shape &shape,
           bool always)
  {
    if (!shape.collect(centre, radius + margin, pieces_) && !always) {
      pieces_.resize(first_piece_.back());
      return;
    }
    particles_.push_back(particle);
    radii_.push_back(radius);
    centres_.push_back(centre);
    first_piece_.push_back(pieces_.size());
  }

  std::size_t count() const { return particles_.size(); }
  int particle(std::size_t k) const { return particles_[k]; }
  const std::vector<int> &particles() const { return particles_; }
  /// When it was collected. Here and not with the particle because particles at a wall are scattered in memory.
  double radius(std::size_t k) const { return radii_[k]; }

  const SurfacePiece *pieces(std::size_t k) const { return pieces_.data() + first_piece_[k]; }
  /// 0 for all particles of a shape that has no pieces
  int piece_count(std::size_t k) const
  {
    return static_cast<int>(first_piece_[k + 1] - first_piece_[k]);
  }
  /// How many of its pieces, the first ones, a particle may touch.
  /// \param centre  now, in the shape's frame
  int near_pieces(std::size_t k, const Vec3 &centre) const
  {
    const Vec3 path = centre - centres_[k];
    const double moved = dot<double>(path, path) * (1.0 + 1e-12);    // squared
    const SurfacePiece *piece = pieces(k);
    const int count = piece_count(k);
    int near = 0;
    while (near < count && may_touch(piece[near], radii_[k], moved)) ++near;
    return near;
  }

  double memory_usage() const
  {
    return static_cast<double>(
        particles_.capacity() * sizeof(int) + radii_.capacity() * sizeof(double) +
        centres_.capacity() * sizeof(Vec3) + pieces_.capacity() * sizeof(SurfacePiece) +
        first_piece_.capacity() * sizeof(std::size_t));
  }

 private:
  std::vector<int> particles_;
  std::vector<double> radii_;
  std::vector<Vec3> centres_;
  std::vector<SurfacePiece> pieces_;
  std::vector<std::size_t> first_piece_ = {0};
};

}    // namespace eepa

#endif
