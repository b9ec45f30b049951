// SPDX-License-Identifier: GPL-2.0-only
#include "read_mesh.h"

#include "comm.h"
#include "error.h"
#include "fmt/format.h"
#include "lammps.h"

#include <stdexcept>
#include <vector>

using namespace LAMMPS_NS;

namespace {

/// The bytes of a file on all processes.
/// \throw std::invalid_argument on all processes when it can not be read
std::vector<char> broadcast_file(LAMMPS *lmp, const std::string &file)
{
  std::vector<char> bytes;
  std::string wrong;
  if (lmp->comm->me == 0) {
    try {
      bytes = eepa::read_bytes(file);
    } catch (const std::invalid_argument &e) {
      wrong = e.what();
    }
  }
  // MPI counts with int
  constexpr long long chunk = 1 << 30;
  long long sizes[2] = {static_cast<long long>(bytes.size()), static_cast<long long>(wrong.size())};
  MPI_Bcast(sizes, 2, MPI_LONG_LONG, 0, lmp->world);
  bytes.resize(sizes[0]);
  wrong.resize(sizes[1]);
  MPI_Bcast(wrong.data(), static_cast<int>(sizes[1]), MPI_CHAR, 0, lmp->world);
  if (!wrong.empty()) throw std::invalid_argument(wrong);
  for (long long at = 0; at < sizes[0]; at += chunk)
    MPI_Bcast(bytes.data() + at, static_cast<int>(std::min(chunk, sizes[0] - at)), MPI_CHAR, 0,
              lmp->world);
  return bytes;
}

}    // namespace

std::unique_ptr<eepa::MeshShape> LAMMPS_NS::read_mesh(LAMMPS *lmp, const eepa::WallShape &typed,
                                                      const std::string &who)
{
  eepa::MeshTransformation transformation;
  transformation.scale = typed.placement.scale;
  transformation.axis = eepa::Vec3(typed.placement.axis.data());
  transformation.angle = typed.placement.degrees;
  transformation.offset = eepa::Vec3(typed.placement.offset.data());
  std::unique_ptr<eepa::MeshShape> shape;
  try {
    const std::vector<char> bytes = broadcast_file(lmp, typed.file);
    const eepa::StlTriangles triangles = eepa::parse_stl(bytes.data(), bytes.size(), typed.file);
    shape = std::make_unique<eepa::MeshShape>(eepa::TriangleMesh(triangles, transformation),
                                              typed.smooth);
  } catch (const std::invalid_argument &e) {
    // every process has the same bytes and the same error
    lmp->error->all(FLERR, "{}: wall mesh: {}", who, e.what());
  }
  if (lmp->comm->me == 0)
    for (const eepa::MeshFinding &finding : shape->mesh().findings)
      lmp->error->warning(FLERR, "{}: wall mesh {}: {}", who, typed.file, finding.text());
  return shape;
}
