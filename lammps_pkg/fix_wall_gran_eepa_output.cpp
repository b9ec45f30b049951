// SPDX-License-Identifier: GPL-2.0-only

// What FixWallGranEepa tells: energy, global vector, loads of each face.

#include "fix_wall_gran_eepa.h"

#include "face_loads.h"

#include <algorithm>

using namespace LAMMPS_NS;

/// Sums the forces and contacts of all ranks. Collective.
void FixWallGranEepa::sum_forces()
{
  constexpr int n = sizeof(Sums) / sizeof(double);
  static_assert(n == 10, "Sums is an array of doubles");
  Sums all;
  MPI_Allreduce(&sums, &all, n, MPI_DOUBLE, MPI_SUM, world);
  for (int k = 0; k < 3; k++) {
    output_vector[FIRST_FORCE_X + k] = all.force[0][k];
    output_vector[SECOND_FORCE_X + k] = all.force[1][k];
    output_vector[FORCE_X + k] = all.force[0][k] + all.force[1][k];
    output_vector[TORQUE_X + k] = all.moment[k];
  }
  output_vector[CONTACTS] = all.contacts;
  output_is_summed = true;
}

double FixWallGranEepa::compute_vector(int n)
{
  if (!output_is_summed) sum_forces();
  output_vector[POSITION] = position();
  output_vector[VELOCITY] = normal_velocity();
  output_vector[LOAD_FORCE] = loaded() ? load_now : 0.0;
  output_vector[LOAD_KINETIC_ENERGY] = loaded() ? platen.kinetic_energy() : 0.0;
  output_vector[LOAD_WORK] = platen.work;
  output_vector[LOAD_DISSIPATED] = platen.dissipated;
  output_vector[ANGLE] = angle_before + placement.angle;
  output_vector[ANGULAR_VELOCITY] = motion_args.rotates ? angular_speed : 0.0;
  for (int k = 0; k < 3; k++) output_vector[DISPLACEMENT_X + k] = placement.displacement[k];
  return output_vector[n];
}

/// Energy stored in the contacts with the wall.
double FixWallGranEepa::compute_scalar()
{
  double all;
  MPI_Allreduce(&elastic_energy, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

void FixWallGranEepa::end_of_step()
{
  if (!face_loads) return;
  face_loads->sum(world);
  array_local = face_loads->rows();
}
