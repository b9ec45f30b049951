// SPDX-License-Identifier: GPL-2.0-only
#include "pair_gran_eepa_omp.h"

#include "atom.h"
#include "comm.h"
#include "force.h"
#include "neigh_list.h"
#include "neighbor.h"

#include <algorithm>
#include <functional>
#include <limits>

using namespace LAMMPS_NS;

void PairGranEepaOMP::cut_list(int count)
{
  const int inum = list->inum;
  const int *ilist = list->ilist;
  first_places.clear();
  first_atoms.clear();
  // atoms of a slice are consecutive only where the list is sorted by atom, as LAMMPS's lists are
  if (std::adjacent_find(ilist, ilist + inum, std::greater_equal<>()) != ilist + inum) return;

  // slices of equal work: 1 for each neighbour's distance, and own_work for the particle itself
  constexpr bigint own_work = 2;
  bigint work = 0;
  for (int ii = 0; ii < inum; ii++) work += own_work + list->numneigh[ilist[ii]];
  bigint done = 0;
  for (int ii = 0; ii < inum; ii++) {
    const bigint slice = static_cast<bigint>(first_places.size());
    if (done * count >= slice * work) {
      first_places.push_back(ii);
      first_atoms.push_back(slice == 0 ? 0 : ilist[ii]);
    }
    done += own_work + list->numneigh[ilist[ii]];
  }
  if (static_cast<int>(first_places.size()) < count) {    // fewer atoms than threads
    first_places.clear();
    return;
  }
  first_places.push_back(inum);
  first_atoms.push_back(std::numeric_limits<int>::max());    // ghosts belong to the last slice
}

void PairGranEepaOMP::work_through_list()
{
  const int count = comm->nthreads;
  if (neighbor->ago == 0 || first_places.empty()) cut_list(count);
  // LAMMPS's tallies of energy and virial are not thread-safe
  if (count == 1 || evflag || first_places.empty()) {
    PairGranEepa::work_through_list();
    return;
  }
  const int written = force->newton_pair ? atom->nlocal + atom->nghost : atom->nlocal;
  slices.resize(count);
  for (int s = 0; s < count; s++) {
    slices[s].begin = first_places[s];
    slices[s].end = first_places[s + 1];
    slices[s].first_atom = first_atoms[s];
    slices[s].atom_count = std::min(first_atoms[s + 1], written) - first_atoms[s];
    slices[s].deferrable = written;
  }
#pragma omp parallel for num_threads(count) schedule(static, 1)
  for (int s = 0; s < count; s++) {
    slices[s].deferred.clear();
    work_through(slices[s]);
  }
#pragma omp parallel for num_threads(count) schedule(static, 1)
  for (int s = 0; s < count; s++) add_deferred(s);
}

void PairGranEepaOMP::add_deferred(int slice)
{
  double **f = atom->f, **torque = atom->torque;
  for (const ContactSlice &from : slices) {
    for (const DeferredForce &deferred : from.deferred) {
      if (!slices[slice].writes(deferred.atom)) continue;
      for (int k = 0; k < 3; k++) {
        f[deferred.atom][k] += deferred.force[k];
        torque[deferred.atom][k] += deferred.torque[k];
      }
    }
  }
}
