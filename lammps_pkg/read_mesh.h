// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_READ_MESH_H
#define LMP_EEPA_READ_MESH_H

#include <eepa_commands/wall_shapes.h>
#include <eepa_walls/mesh_shape.h>

#include <memory>
#include <string>

namespace LAMMPS_NS {

class LAMMPS;

/// Reads the mesh of a wall: one process reads the file, all of them make the same mesh of it. What is wrong
/// with the mesh without harm is told in warnings. Collective.
/// \param who  begins the messages: "fix ID wall/gran/eepa"
std::unique_ptr<eepa::MeshShape> read_mesh(LAMMPS *, const eepa::WallShape &typed,
                                           const std::string &who);

}    // namespace LAMMPS_NS

#endif
