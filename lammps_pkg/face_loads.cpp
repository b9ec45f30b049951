// SPDX-License-Identifier: GPL-2.0-only
#include "face_loads.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;
using eepa::Vec3;

FaceLoads::FaceLoads(std::vector<int> numbers, std::vector<double> areas) :
    numbers_(std::move(numbers)), areas_(std::move(areas)), sums_(areas_.size())
{
  for (auto &of_face : sums_) of_face.fill(0.0);
}

void FaceLoads::add(int face, const eepa::Contact &contact, const eepa::Wrench<double> &wrench,
                    double time_step)
{
  auto &of_face = sums_[face];
  const eepa::SurfaceLoad load = eepa::load_on_surface(contact, wrench, time_step);
  of_face[NORMAL_FORCE] += load.normal_force;
  for (int k = 0; k < 3; k++) of_face[SHEAR_FORCE + k] += load.shear[k];
  of_face[SLIDING_WORK] += load.sliding_work;
  of_face[IMPACT_WORK] += load.impact_work;
}

void FaceLoads::sum(MPI_Comm world)
{
  int rank, ranks;
  MPI_Comm_rank(world, &rank);
  MPI_Comm_size(world, &ranks);
  const std::size_t faces = areas_.size();
  std::vector<std::array<double, N_SUMS>> all(faces);
  MPI_Allreduce(sums_.data(), all.data(), static_cast<int>(faces * N_SUMS), MPI_DOUBLE, MPI_SUM,
                world);
  const std::size_t begin = faces * rank / ranks, end = faces * (rank + 1) / ranks;
  table_.resize((end - begin) * N_COLUMNS);
  row_pointers_.resize(end - begin);
  const double per_step = steps_ > 0 ? 1.0 / steps_ : 0.0;
  for (std::size_t face = begin; face < end; face++) {
    double *row = table_.data() + (face - begin) * N_COLUMNS;
    row_pointers_[face - begin] = row;
    const auto &of_face = all[face];
    const double per_area = 1.0 / areas_[face];
    row[NUMBER] = numbers_[face];
    row[AREA] = areas_[face];
    row[PRESSURE] = of_face[NORMAL_FORCE] * per_step * per_area;
    row[SHEAR] = Vec3(of_face.data() + SHEAR_FORCE).norm() * per_step * per_area;
    row[SLIDING] = of_face[SLIDING_WORK] * per_area;
    row[IMPACT] = of_face[IMPACT_WORK] * per_area;
  }
  steps_ = 0;
  for (auto &of_face : sums_) std::fill_n(of_face.begin(), static_cast<int>(SLIDING_WORK), 0.0);
}

std::vector<double> FaceLoads::wear(MPI_Comm world) const
{
  std::vector<double> mine, all(wear_size());
  mine.reserve(all.size());
  for (const auto &of_face : sums_) {
    mine.push_back(of_face[SLIDING_WORK]);
    mine.push_back(of_face[IMPACT_WORK]);
  }
  MPI_Allreduce(mine.data(), all.data(), wear_size(), MPI_DOUBLE, MPI_SUM, world);
  return all;
}

void FaceLoads::set_wear(const double *values)
{
  for (auto &of_face : sums_) {
    of_face[SLIDING_WORK] = *values++;
    of_face[IMPACT_WORK] = *values++;
  }
}

double FaceLoads::memory_usage() const
{
  return static_cast<double>(sums_.capacity() * sizeof(sums_[0]) +
                             table_.capacity() * sizeof(double));
}
