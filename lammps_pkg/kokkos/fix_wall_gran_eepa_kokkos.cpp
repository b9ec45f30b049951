// SPDX-License-Identifier: GPL-2.0-only
#include "fix_wall_gran_eepa_kokkos.h"

#include "kokkos_styles.h"
#include "wall_search.h"

#include "compute_gran_eepa_energy_atom.h"

#include "atom_kokkos.h"
#include "atom_masks.h"
#include "comm.h"
#include "error.h"
#include "kokkos.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using eepa::Vec3;

/// Before there is a fix, which could not be destroyed.
static LAMMPS *with_kokkos(LAMMPS *lmp, char **arg)
{
  if (!lmp->kokkos)
    lmp->error->all(FLERR,
                    "fix {} wall/gran/eepa/kk: KOKKOS is off; start LAMMPS with -k on, or use "
                    "wall/gran/eepa",
                    arg[0]);
  return lmp;
}

template <class DeviceType>
FixWallGranEepaKokkos<DeviceType>::FixWallGranEepaKokkos(LAMMPS *lmp, int narg, char **arg) :
    FixWallGranEepa(with_kokkos(lmp, arg), narg, arg)
{
  // loads of faces are summed on the host
  if (!face_loads) surface = make_wall_surface<DeviceType>(*shape);
  if (!surface) return;
  // what this fix reads of particles it asks for itself
  kokkosable = 1;
  execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  datamask_read = datamask_modify = EMPTY_MASK;
  exchange_comm_device = sort_device = 1;
  device_histories = std::make_unique<WallHistoriesKokkos<DeviceType>>(histories, history_size,
                                                                       surface->most_contacts());
  device_histories->grow(atom->nmax);
  maxexchange = std::max(maxexchange, device_histories->most_exchanged());
}

/// Takes the name without suffix: restart files have with the data of particles the name as it is, and give them only
/// to a fix of the same one.
template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::post_constructor()
{
  delete[] Fix::style;
  Fix::style = utils::strdup("wall/gran/eepa");
}

template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::init()
{
  FixWallGranEepa::init();
  if (surface)
    device_engine = make_contact_engine_kokkos<DeviceType>(style.settings, parameters.rolling,
                                                           parameters.twisting);
}

template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::warn_of_device()
{
  if (!surface || execution_space == Host) FixWallGranEepa::warn_of_device();
}

template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::bring_sizes_to_host()
{
  if (surface) atomKK->sync(Host, RADIUS_MASK | RMASS_MASK | MASK_MASK);
}

/// Variables may ask for computes of the host.
template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::bring_all_to_host()
{
  if (surface) atomKK->sync(Host, ALL_MASK);
}

/* ---------------------------------------------------------------------- force call */

template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::add_contacts()
{
  if (!surface) {
    FixWallGranEepa::add_contacts();
    return;
  }
  atomKK->sync(execution_space,
               X_MASK | V_MASK | OMEGA_MASK | F_MASK | TORQUE_MASK | RADIUS_MASK | RMASS_MASK |
                   MASK_MASK);
  if (masses.has_bodies() && (neighbor->ago == 0 || update->setupflag != 0))
    send_to_device(masses.body_masses(), "eepa:wall:body_mass", body_mass);
  Step step = step_of_call();
  if (particles_are_elsewhere() || one_is_far()) collect_on_device(step);
  prepare_tallies(step);
  if (step.rows.candidates == 0) return;

  surface->find(step);
  device_histories->force_call_changes_them();
  bigint stop;
  if (evflag || keep_ledger || contact_table || !request.advance) {
    const WallTallies tallies = device_engine->add_wall_forces_and_tally(step);
    take_sums(tallies);
    take_tallies(step, tallies);
    stop = tallies.stop;
  } else {
    const WallSums of_step = device_engine->add_wall_forces(step);
    take_sums(of_step);
    stop = of_step.stop;
  }
  atomKK->modified(execution_space, F_MASK | TORQUE_MASK);
  if (stop != 0) stop_run(stop);
}

template <class DeviceType> WallStep<DeviceType> FixWallGranEepaKokkos<DeviceType>::step_of_call()
{
  Step step = buffers;
  step.take(*atomKK, masses, body_mass);
  step.rows = device_histories->rows();
  step.motion = placement;
  step.surface_speed = surface_speed;
  step.margin = collected_margin;
  step.coefficients = coefficients;
  step.about = Vec3(about.data());
  step.groupbit = igroup == 0 ? 0 : groupbit;
  step.two_planes = typed_shape.planes() == 2;
  step.request = request;
  step.ledger = keep_ledger;
  step.books_setup = books_setup();
  step.virial = evflag && vflag_global;
  step.virial_of_atoms = evflag && vflag_atom;
  step.table = contact_table;
  step.losses_of_atoms = !atom_losses.empty();
  return step;
}

/// As collect_candidates()
template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::collect_on_device(Step &step)
{
  step.margin = margin_of_candidates();
  const int particles = atom->nlocal;
  watches_places = atoms_may_be_far();
  if (watches_places) {
    reserve(device_places, "eepa:wall:places", particles);
    const auto present = std::make_pair(0, particles);
    Kokkos::deep_copy(Kokkos::subview(device_places, present, Kokkos::ALL),
                      Kokkos::subview(step.x, present, Kokkos::ALL));
  }
  if (request.advance) {
    const int behind = surface->one_behind(step, particles);
    if (behind >= 0) stop_run(WallStop::of(WallStop::behind, behind));
  }
  device_histories->put_beside(*surface, step, particles);
  particles_are_moved = false;
  step.rows = device_histories->rows();
  reserve(buffers.found, "eepa:wall:found", step.rows.candidates);
  reserve(buffers.kept, "eepa:wall:kept", step.rows.candidates);
  reserve(buffers.parted, "eepa:wall:parted", step.rows.candidates);
  reserve(buffers.touches, "eepa:wall:touches", step.rows.slots);
  if (contact_table && particles > 0)
    std::fill_n(array_atom[0], static_cast<std::size_t>(particles) * N_ATOM, 0.0);
  if (contact_table) {
    reserve_rows(buffers.table_rows, "eepa:wall:table", atom->nmax, WallTable::COLUMNS);
    Kokkos::deep_copy(buffers.table_rows, 0.0);
  }
}

/// Whether an atom has left the place where it was collected, where neighbour lists do not say so.
template <class DeviceType> bool FixWallGranEepaKokkos<DeviceType>::one_is_far() const
{
  if (!watches_places || atom->nlocal == 0) return false;
  double longest = 0.0;
  Kokkos::parallel_reduce(
      "gran/eepa:watch_atoms", Kokkos::RangePolicy<DeviceType>(0, atom->nlocal),
      LongestPath<DeviceType>{atomKK->k_x.template view<DeviceType>(), device_places},
      Kokkos::Max<double>(longest));
  return longest > 0.25 * neighbor->skin * neighbor->skin;
}

/* ---------------------------------------------------------------------- what comes back */

template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::prepare_tallies(Step &step)
{
  if (step.virial_of_atoms) {
    reserve_rows(buffers.atom_virial, "eepa:wall:virial", atom->nmax, 6);
    Kokkos::deep_copy(buffers.atom_virial, 0.0);
  }
  if (step.losses_of_atoms) {
    reserve_rows(buffers.atom_losses, "eepa:wall:losses", atom->nmax, AtomLosses::kinds);
    Kokkos::deep_copy(buffers.atom_losses, 0.0);
  }
  if (keep_ledger) reserve(buffers.partings, "eepa:wall:partings", 2 * step.rows.slots);
  step.found = buffers.found;
  step.kept = buffers.kept;
  step.parted = buffers.parted;
  step.touches = buffers.touches;
  step.partings = buffers.partings;
  step.table_rows = buffers.table_rows;
  step.atom_virial = buffers.atom_virial;
  step.atom_losses = buffers.atom_losses;
}

template <class DeviceType>
void FixWallGranEepaKokkos<DeviceType>::take_sums(const WallSums &of_step)
{
  for (int k = 0; k < 3; k++) {
    sums.force[0][k] = of_step.force[0][k];
    sums.force[1][k] = of_step.force[1][k];
    sums.moment[k] = of_step.moment[k];
  }
  sums.contacts = of_step.contacts;
  elastic_energy = of_step.energy;
}

namespace {
/// Copies the first rows of a table to rows of the host that lie one after another.
template <class Table> void copy_rows(const Table &table, int rows, double *to)
{
  using Rows =
      Kokkos::View<double **, Kokkos::LayoutRight, Kokkos::HostSpace, Kokkos::MemoryUnmanaged>;
  Kokkos::deep_copy(Rows(to, rows, table.extent(1)),
                    Kokkos::subview(table, std::make_pair(0, rows), Kokkos::ALL));
}
}    // namespace

template <class DeviceType>
void FixWallGranEepaKokkos<DeviceType>::take_tallies(const Step &step, const WallTallies &tallies)
{
  const int particles = atom->nlocal;
  if (keep_ledger) {
    ledger.elastic.add(tallies.of_contacts.elastic, 1.0);
    ledger.dissipated.add(tallies.of_contacts.dissipated, 1.0);
    power = tallies.power;
  }
  if (step.virial)
    for (int k = 0; k < 6; k++) virial[k] += tallies.of_contacts.virial[k];
  if (step.virial_of_atoms) copy_rows(step.atom_virial, particles, vatom[0]);
  if (step.table) {
    static_assert(static_cast<int>(WallTable::COLUMNS) == N_ATOM &&
                      static_cast<int>(WallTable::OVERLAP) == ATOM_OVERLAP,
                  "the same columns");
    copy_rows(step.table_rows, particles, array_atom[0]);
  }
  if (!step.losses_of_atoms) return;
  std::vector<double> losses(static_cast<std::size_t>(particles) * AtomLosses::kinds);
  copy_rows(step.atom_losses, particles, losses.data());
  for (auto *compute : atom_losses)
    for (int i = 0; i < particles; i++)
      compute->add(i, losses.data() + static_cast<std::size_t>(i) * AtomLosses::kinds);
}

template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::stop_run(bigint stop)
{
  atomKK->sync(Host, X_MASK | V_MASK | RADIUS_MASK | TAG_MASK | MASK_MASK);
  const int i = WallStop::particle_of(stop);
  if (WallStop::reason_of(stop) == WallStop::behind) stop_behind_wall(i);
  if (WallStop::reason_of(stop) == WallStop::too_many)
    error->one(FLERR, "fix {} wall/gran/eepa/kk: atom {} touches the wall at more than {} places",
               id, atom->tag[i], surface->most_contacts());
  const Vec3 centre = placement.to_shape(Vec3(atom->x[i]));
  const double radius = atom->radius[i];
  std::vector<eepa::SurfacePiece> pieces;
  shape->collect(centre, radius, pieces);
  found.clear();
  shape->visit(centre, radius, pieces.data(), static_cast<int>(pieces.size()), found);
  for (const eepa::SurfacePoint &point : found)
    if (eepa::too_deep(radius - point.distance, radius))
      stop_at_overlap(i, point.face, radius - point.distance);
  error->one(FLERR, "fix {} wall/gran/eepa/kk: atom {} overlaps the wall by more than its radius",
             id, atom->tag[i]);
}

/* ---------------------------------------------------------------------- histories that go along */

template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::grow_arrays(int nmax)
{
  FixWallGranEepa::grow_arrays(nmax);
  if (surface) device_histories->grow(nmax);
}

template <class DeviceType>
void FixWallGranEepaKokkos<DeviceType>::copy_arrays(int i, int j, int delflag)
{
  if (surface) device_histories->change_on_host(atom->nlocal);
  FixWallGranEepa::copy_arrays(i, j, delflag);
}

template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::set_arrays(int i)
{
  if (surface) device_histories->change_on_host(atom->nlocal);
  FixWallGranEepa::set_arrays(i);
}

template <class DeviceType> int FixWallGranEepaKokkos<DeviceType>::pack_exchange(int i, double *buf)
{
  if (surface) device_histories->bring_to_host(atom->nlocal);
  return FixWallGranEepa::pack_exchange(i, buf);
}

template <class DeviceType>
int FixWallGranEepaKokkos<DeviceType>::unpack_exchange(int i, double *buf)
{
  if (surface) device_histories->change_on_host(atom->nlocal);
  return FixWallGranEepa::unpack_exchange(i, buf);
}

template <class DeviceType> int FixWallGranEepaKokkos<DeviceType>::pack_restart(int i, double *buf)
{
  if (surface) device_histories->bring_to_host(atom->nlocal);
  return FixWallGranEepa::pack_restart(i, buf);
}

template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::unpack_restart(int i, int nth)
{
  if (surface) device_histories->change_on_host(atom->nlocal);
  FixWallGranEepa::unpack_restart(i, nth);
  if (surface && static_cast<int>(histories.list(i).size()) > surface->most_contacts())
    stop_run(WallStop::of(WallStop::too_many, i));
}

template <class DeviceType> int FixWallGranEepaKokkos<DeviceType>::size_restart(int i)
{
  if (surface) device_histories->bring_to_host(atom->nlocal);
  return FixWallGranEepa::size_restart(i);
}

template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::write_restart(FILE *file)
{
  if (surface) device_histories->bring_to_host(atom->nlocal);
  FixWallGranEepa::write_restart(file);
}

/// Planes are where the file has them.
template <class DeviceType> void FixWallGranEepaKokkos<DeviceType>::restart(char *buf)
{
  FixWallGranEepa::restart(buf);
  if (surface && typed_shape.is_plane()) surface = make_wall_surface<DeviceType>(*shape);
}

template <class DeviceType>
int FixWallGranEepaKokkos<DeviceType>::pack_exchange_kokkos(const int &sent,
                                                            DAT::tdual_xfloat_2d &buffer,
                                                            DAT::tdual_int_1d sendlist,
                                                            DAT::tdual_int_1d copylist,
                                                            ExecutionSpace space)
{
  particles_are_moved = true;
  return device_histories->change_lists().pack_exchange(sent, buffer, sendlist, copylist, space);
}

template <class DeviceType>
void FixWallGranEepaKokkos<DeviceType>::unpack_exchange_kokkos(DAT::tdual_xfloat_2d &buffer,
                                                               DAT::tdual_int_1d &indices,
                                                               int received, int received_first,
                                                               int numbers_first,
                                                               ExecutionSpace space)
{
  particles_are_moved = true;
  device_histories->change_lists().unpack_exchange(buffer, indices, received, received_first,
                                                   numbers_first, space);
}

template <class DeviceType>
void FixWallGranEepaKokkos<DeviceType>::sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &sorter)
{
  particles_are_moved = true;
  device_histories->change_lists().sort(sorter);
}

template <class DeviceType> double FixWallGranEepaKokkos<DeviceType>::memory_usage()
{
  const double bytes = FixWallGranEepa::memory_usage();
  if (!surface) return bytes;
  return bytes + device_histories->memory_usage() +
      static_cast<double>(buffers.found.span() * sizeof(int) +
                          buffers.kept.span() * sizeof(unsigned) +
                          buffers.parted.span() * sizeof(int) +
                          (buffers.touches.span() + buffers.partings.span()) * sizeof(WallTouch) +
                          (buffers.table_rows.span() + buffers.atom_losses.span() +
                           buffers.atom_virial.span() + body_mass.span() + device_places.span()) *
                              sizeof(double));
}

/* ---------------------------------------------------------------------- */

Fix *LAMMPS_NS::make_wall_gran_eepa_on_device(LAMMPS *lmp, int narg, char **arg)
{
  return new FixWallGranEepaKokkos<LMPDeviceType>(lmp, narg, arg);
}
Fix *LAMMPS_NS::make_wall_gran_eepa_on_host(LAMMPS *lmp, int narg, char **arg)
{
  return new FixWallGranEepaKokkos<LMPHostType>(lmp, narg, arg);
}

namespace LAMMPS_NS {
template class FixWallGranEepaKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixWallGranEepaKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
