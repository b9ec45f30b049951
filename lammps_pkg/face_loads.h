// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_FACE_LOADS_H
#define LMP_EEPA_FACE_LOADS_H

#include <eepa/wear.h>

#include <mpi.h>

#include <array>
#include <vector>

namespace LAMMPS_NS {

/// Loads and wear of each face of a mesh: what particles do to it, over its area.
class FaceLoads {
 public:
  /// columns of the output
  enum Column {
    NUMBER,      ///< of the triangle in its file, from 1
    AREA,        ///< [area]
    PRESSURE,    ///< normal force over area, mean of the steps since the last output [pressure]
    SHEAR,       ///< magnitude of the mean tangential force, over area [pressure]
    SLIDING,     ///< normal force times distance slid, over area, since the beginning [energy/area]
    IMPACT,      ///< work of normal forces while particles approach, likewise [energy/area]
    N_COLUMNS
  };

  /// \param numbers  of the faces in their file, from 1
  /// \param areas  of the faces, > 0
  FaceLoads(std::vector<int> numbers, std::vector<double> areas);

  void start_step() { steps_++; }
  /// \param time_step  over which the forces of this contact act
  void add(int face, const eepa::Contact &contact, const eepa::Wrench<double> &wrench,
           double time_step);

  /// Prepares the rows of this process; the faces are shared out among the processes. Collective.
  void sum(MPI_Comm world);
  /// Sliding and impact work of each face, 2 values a face, of all processes together. Collective.
  std::vector<double> wear(MPI_Comm world) const;
  /// Goes on from the wear of a restart file; to be called on one process.
  /// \param values  wear_size() of them
  void set_wear(const double *values);
  int wear_size() const { return 2 * static_cast<int>(areas_.size()); }

  int row_count() const { return static_cast<int>(row_pointers_.size()); }
  double **rows() { return row_pointers_.data(); }
  double memory_usage() const;

 private:
  enum { NORMAL_FORCE, SHEAR_FORCE, SLIDING_WORK = SHEAR_FORCE + 3, IMPACT_WORK, N_SUMS };

  std::vector<int> numbers_;
  std::vector<double> areas_;
  std::vector<std::array<double, N_SUMS>> sums_;    // of this process
  int steps_ = 0;
  std::vector<double> table_;    // of the faces of this process
  std::vector<double *> row_pointers_;
};

}    // namespace LAMMPS_NS

#endif
