// SPDX-License-Identifier: GPL-2.0-only
#include "pair_gran_eepa_kokkos.h"

#include "kokkos_styles.h"

#include "atom_kokkos.h"
#include "atom_masks.h"
#include "error.h"
#include "force.h"
#include "kokkos.h"
#include "memory_kokkos.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "update.h"

#include <Kokkos_Profiling_ScopedRegion.hpp>

#include <type_traits>

using namespace LAMMPS_NS;

namespace {
constexpr const char *style_name = "pair_style gran/eepa/kk";

/// Lets LAMMPS take a pair style for one of the host while this object lives.
class AsOnHost {
 public:
  explicit AsOnHost(ExecutionSpace &of) : space(of), before(of) { space = Host; }
  ~AsOnHost() { space = before; }
  AsOnHost(const AsOnHost &) = delete;
  AsOnHost &operator=(const AsOnHost &) = delete;

 private:
  ExecutionSpace &space;
  const ExecutionSpace before;
};
}    // namespace

template <class DeviceType>
PairGranEepaKokkos<DeviceType>::PairGranEepaKokkos(LAMMPS *lmp) : PairGranEepa(lmp)
{
  if (!lmp->kokkos)
    error->all(FLERR, "{}: KOKKOS is off; start LAMMPS with -k on, or use gran/eepa", style_name);
  kokkosable = 1;
  execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  datamask_read = X_MASK | V_MASK | OMEGA_MASK | F_MASK | TORQUE_MASK | TYPE_MASK | MASK_MASK |
      ENERGY_MASK | VIRIAL_MASK | RMASS_MASK | RADIUS_MASK;
  datamask_modify = F_MASK | TORQUE_MASK | ENERGY_MASK | VIRIAL_MASK;
  deep = decltype(deep)("eepa:deep");
  Kokkos::deep_copy(deep, DeepContact::none);
}

template <class DeviceType> PairGranEepaKokkos<DeviceType>::~PairGranEepaKokkos()
{
  if (copymode) return;
  memoryKK->destroy_kokkos(energy_of_atoms, eatom);
  memoryKK->destroy_kokkos(virial_of_atoms, vatom);
  eatom = nullptr;
  vatom = nullptr;
}

/* ---------------------------------------------------------------------- set-up */

template <class DeviceType> void PairGranEepaKokkos<DeviceType>::init_style()
{
  if (lmp->kokkos->neighflag == FULL)
    error->all(FLERR,
               "{}: neighbor lists of KOKKOS are full and must be half: say `package kokkos neigh "
               "half`, or "
               "-pk kokkos neigh half when LAMMPS starts",
               style_name);
  if (neighbor->style != Neighbor::BIN)
    error->all(FLERR,
               "{}: the style of command neighbor must be bin, not nsq, multi or multi/old: with "
               "KOKKOS, LAMMPS has no "
               "other lists for particles of different sizes",
               style_name);
  require_all_pairs_of_types();
  PairGranEepa::init_style();
  device_engine = make_contact_engine_kokkos<DeviceType>(style.settings, rolling, twisting);
  auto *request = neighbor->find_request(this);
  constexpr bool on_device = std::is_same_v<DeviceType, LMPDeviceType>;
  request->set_kokkos_host(!on_device);
  request->set_kokkos_device(on_device);
}

/// Stops where pair_style hybrid would leave out pairs of types: LAMMPS can not do that in a list of KOKKOS for particles
/// of different sizes.
template <class DeviceType> void PairGranEepaKokkos<DeviceType>::require_all_pairs_of_types() const
{
  if (!utils::strmatch(force->pair_style, "^hybrid")) return;
  for (int i = 1; i <= atom->ntypes; i++) {
    for (int j = i; j <= atom->ntypes; j++) {
      if (setflag[i][j] || (setflag[i][i] && setflag[j][j])) continue;
      error->all(
          FLERR,
          "{}: pair_style {} gives types {} {} to another sub-style, and LAMMPS has no such "
          "neighbor lists "
          "with KOKKOS: give all pairs of types to gran/eepa/kk, or use gran/eepa without suffix",
          style_name, force->pair_style, i, j);
    }
  }
}

template <class DeviceType> ContactHistory *PairGranEepaKokkos<DeviceType>::make_history(int values)
{
  device_history = ContactHistoryKokkos<DeviceType>::make(lmp, history_id, values, this);
  return device_history;
}

template <class DeviceType>
void PairGranEepaKokkos<DeviceType>::init_list(int /*id*/, NeighList *made)
{
  device_list = static_cast<NeighListKokkos<DeviceType> *>(made);
  list = device_history->follow(device_list);
}

/* ---------------------------------------------------------------------- force call */

template <class DeviceType> void PairGranEepaKokkos<DeviceType>::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag, 0);
  if (classes.empty()) send_coefficients();
  {
    const AsOnHost masses_of_bodies(execution_space);
    if (neighbor->ago == 0) bring_what_new_lists_need();
    begin_force_call();
  }
  if (masses.has_bodies() && neighbor->ago == 0) send_bodies();
  allocate_tallies_of_atoms();

  atomKK->sync(execution_space, datamask_read);
  const ContactStep<DeviceType> step = step_of_call();
  device_history->device_has_changed();
  if (evflag || keep_ledger || !request.advance)
    take_sums(device_engine->add_forces_and_tally(step));
  else
    device_engine->add_forces(step);
  atomKK->modified(execution_space, evflag ? datamask_modify : F_MASK | TORQUE_MASK);
  stop_where_too_deep();
  if (keep_atom_losses) take_losses_of_atoms();
  end_force_call();
}

template <class DeviceType> ContactStep<DeviceType> PairGranEepaKokkos<DeviceType>::step_of_call()
{
  ContactStep<DeviceType> step;
  step.inum = device_list->inum;
  step.ilist = device_list->d_ilist;
  step.numneigh = device_list->d_numneigh;
  step.neighbors = device_list->d_neighbors;
  step.rows = device_history->rows();

  step.take(*atomKK, masses, body_mass);
  step.written = atom->nlocal + (force->newton_pair ? atom->nghost : 0);
  step.several_write = lmp->kokkos->neighflag != HALF;

  step.holds_some = masses.holds_some();
  step.body = body;

  step.coefficients = device_coefficients;
  step.stride = pair_index(1, 0);
  for (int k = 0; k < 4; k++) step.special[k] = force->special_lj[k];

  step.request = request;
  step.tallies.energy = eflag_global != 0;
  step.tallies.virial = vflag_global != 0;
  step.tallies.energy_of_atoms = eflag_atom != 0;
  step.tallies.virial_of_atoms = vflag_atom != 0;
  step.tallies.ledger = keep_ledger;
  step.tallies.losses_of_atoms = keep_atom_losses;
  step.energy_of_atoms = energy_of_atoms.template view<DeviceType>();
  step.virial_of_atoms = virial_of_atoms.template view<DeviceType>();
  step.losses_of_atoms = losses_of_atoms;
  step.deep = deep;
  return step;
}

/* ---------------------------------------------------------------------- where a neighbour list is new */

/// Brings sizes of particles to the host where it needs them for bodies of fix rigid or for particles that were
/// inserted.
template <class DeviceType> void PairGranEepaKokkos<DeviceType>::bring_what_new_lists_need()
{
  if (masses.has_bodies() || !device_history->newcomers().empty()) bring_to_host(HostData::SIZES);
}

namespace {
template <class DeviceType> struct CountTooLarge {
  typename ArrayTypes<DeviceType>::t_float_1d radius;
  typename ArrayTypes<DeviceType>::t_int_1d type;
  Kokkos::View<double *, DeviceType> allowed;

  KOKKOS_INLINE_FUNCTION void operator()(int i, int &found) const
  {
    if (radius(i) > allowed(type(i))) found++;
  }
};
}    // namespace

template <class DeviceType> void PairGranEepaKokkos<DeviceType>::check_radii()
{
  // execution_space is that of the host meanwhile
  atomKK->sync(ExecutionSpaceFromDevice<DeviceType>::space, RADIUS_MASK | TYPE_MASK);
  int found = 0;
  Kokkos::parallel_reduce("gran/eepa:check_radii", Kokkos::RangePolicy<DeviceType>(0, atom->nlocal),
                          CountTooLarge<DeviceType>{atomKK->k_radius.template view<DeviceType>(),
                                                    atomKK->k_type.template view<DeviceType>(),
                                                    device_allowed_radius},
                          found);
  if (found == 0) return;
  bring_to_host(HostData::MOTION);    // for the message
  PairGranEepa::check_radii();
}

/* ---------------------------------------------------------------------- what goes to the device */

template <class DeviceType> void PairGranEepaKokkos<DeviceType>::send_coefficients()
{
  send_to_device(coefficients, "eepa:coefficients", device_coefficients);
  std::vector<double> allowed(atom->ntypes + 1, 0.0);
  for (int type = 1; type <= atom->ntypes; type++) allowed[type] = allowed_radius(type);
  send_to_device(allowed, "eepa:allowed_radius", device_allowed_radius);
}

/// Masses and numbers of rigid bodies change with the neighbour list.
template <class DeviceType> void PairGranEepaKokkos<DeviceType>::send_bodies()
{
  send_to_device(masses.body_masses(), "eepa:body_mass", body_mass);
  send_to_device(masses.bodies(), "eepa:body", body);
}

template <class DeviceType> void PairGranEepaKokkos<DeviceType>::allocate_tallies_of_atoms()
{
  if (eflag_atom) {
    memoryKK->destroy_kokkos(energy_of_atoms, eatom);
    memoryKK->create_kokkos(energy_of_atoms, eatom, maxeatom, "pair:eatom");
  }
  if (vflag_atom) {
    memoryKK->destroy_kokkos(virial_of_atoms, vatom);
    memoryKK->create_kokkos(virial_of_atoms, vatom, maxvatom, "pair:vatom");
  }
  if (!keep_atom_losses) return;
  const int atoms = atom->nlocal + atom->nghost;
  if (static_cast<int>(losses_of_atoms.extent(0)) < atoms)
    losses_of_atoms = decltype(losses_of_atoms)("eepa:losses_of_atoms", atoms, AtomLosses::kinds);
  else
    Kokkos::deep_copy(losses_of_atoms, 0.0);
}

/* ---------------------------------------------------------------------- what comes back */

template <class DeviceType> void PairGranEepaKokkos<DeviceType>::take_sums(const StepSums &sums)
{
  if (eflag_global) eng_vdwl += sums.energy;
  if (vflag_global)
    for (int k = 0; k < 6; k++) virial[k] += sums.virial[k];
  if (eflag_atom) {
    energy_of_atoms.template modify<DeviceType>();
    energy_of_atoms.template sync<LMPHostType>();
  }
  if (vflag_atom) {
    virial_of_atoms.template modify<DeviceType>();
    virial_of_atoms.template sync<LMPHostType>();
  }
  if (!keep_ledger) return;
  ledger.elastic.add(sums.elastic, 1.0);
  ledger.dissipated.add(sums.dissipated, 1.0);
}

template <class DeviceType> void PairGranEepaKokkos<DeviceType>::take_losses_of_atoms()
{
  const int atoms = atom->nlocal + atom->nghost;
  using Rows =
      Kokkos::View<double **, Kokkos::LayoutRight, Kokkos::HostSpace, Kokkos::MemoryUnmanaged>;
  Kokkos::deep_copy(Rows(atom_losses.row(0), atoms, AtomLosses::kinds),
                    Kokkos::subview(losses_of_atoms, std::make_pair(0, atoms), Kokkos::ALL));
}

template <class DeviceType> void PairGranEepaKokkos<DeviceType>::stop_where_too_deep()
{
  unsigned long long found = DeepContact::none;
  Kokkos::deep_copy(found, deep);
  if (found == DeepContact::none) return;
  Kokkos::deep_copy(deep, DeepContact::none);    // a program may go on with another run
  bring_to_host(HostData::MOTION);
  stop_at_overlap(DeepContact::i_of(found), DeepContact::j_of(found));
}

template <class DeviceType> void PairGranEepaKokkos<DeviceType>::bring_to_host(HostData data)
{
  const Kokkos::Profiling::ScopedRegion region("gran/eepa: particles to the host");
  unsigned int mask = RADIUS_MASK | RMASS_MASK | TYPE_MASK | MASK_MASK;
  if (data != HostData::SIZES) mask |= X_MASK | V_MASK | OMEGA_MASK | TAG_MASK;
  atomKK->sync(Host, mask);
  if (data == HostData::CONTACTS && device_history) device_history->bring_to_host();
}

template <class DeviceType> double PairGranEepaKokkos<DeviceType>::memory_usage()
{
  return PairGranEepa::memory_usage() +
      static_cast<double>(device_coefficients.extent(0) * sizeof(eepa::Coefficients) +
                          (body_mass.extent(0) + body.extent(0) + losses_of_atoms.size()) *
                              sizeof(double));
}

/* ---------------------------------------------------------------------- */

Pair *LAMMPS_NS::make_gran_eepa_on_device(LAMMPS *lmp)
{
  return new PairGranEepaKokkos<LMPDeviceType>(lmp);
}
Pair *LAMMPS_NS::make_gran_eepa_on_host(LAMMPS *lmp)
{
  return new PairGranEepaKokkos<LMPHostType>(lmp);
}

namespace LAMMPS_NS {
template class PairGranEepaKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class PairGranEepaKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
