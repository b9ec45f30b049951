// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_COMMANDS_WALL_SHAPES_H
#define EEPA_COMMANDS_WALL_SHAPES_H

#include "words.h"

#include <array>
#include <string>

namespace eepa {

/// How a mesh is placed when its file is read: scaled about the origin, then turned about an axis
/// through the origin, then moved.
struct MeshPlacement {
  double scale = 1.0;                                ///< > 0
  std::array<double, 3> axis = {0.0, 0.0, 1.0};      ///< not 0, of any length
  double degrees = 0.0;                              ///< right-handed about the axis
  std::array<double, 3> offset = {0.0, 0.0, 0.0};    ///< [length]
};

/// The surface of a wall as typed: one or two planes normal to an axis, a cylinder along z, the
/// surface of a region of LAMMPS, or a mesh of triangles.
struct WallShape {
  /// Restart files have these values.
  enum Kind { xplane = 0, yplane = 1, zplane = 2, zcylinder = 3, region = 4, mesh = 5 };
  static constexpr int kind_count = 6;

  Kind kind = zplane;
  bool has_lo = false, has_hi = false;
  double lo = 0.0, hi = 0.0;    ///< positions of the planes given, lo < hi [length]
  double radius = 0.0;          ///< radius of a cylinder, > 0 [length]
  std::string region_id;        ///< of `region`
  std::string file;             ///< of `mesh`
  MeshPlacement placement;      ///< of `mesh`
  double smooth =
      default_smooth;    ///< `mesh`: largest angle of edges that count as smooth [degrees]

  /// Facets of round parts meet at less than this where a turn has more than 30 of them; the edges
  /// that a designer wants to be edges are steeper.
  static constexpr double default_smooth = 12.0;

  bool is_plane() const { return kind == xplane || kind == yplane || kind == zplane; }
  /// Axis of a plane's normal.
  int axis() const { return static_cast<int>(kind); }
  /// Number of planes: lo and hi, or one of them; 0 for any other kind.
  int planes() const { return is_plane() ? (has_lo ? 1 : 0) + (has_hi ? 1 : 0) : 0; }
  /// Whether a single plane is given, which can be loaded along its normal.
  bool is_one_plane() const { return planes() == 1; }
  const char *kind_name() const
  {
    constexpr const char *names[kind_count] = {"xplane",    "yplane", "zplane",
                                               "zcylinder", "region", "mesh"};
    return names[kind];
  }
};

/// Reads `xplane|yplane|zplane lo hi`, `zcylinder R`, `region ID` or `mesh FILE [scale s] [rotation ax
/// ay az degrees] [offset x y z] [smooth degrees]`, up to the first word that belongs to none.
/// \throw std::invalid_argument naming argument, value and what is allowed
WallShape parse_shape(Reader &reader);

}    // namespace eepa

#endif
