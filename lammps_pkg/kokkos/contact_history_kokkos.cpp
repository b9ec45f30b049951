// SPDX-License-Identifier: GPL-2.0-only
#include "contact_history_kokkos.h"

#include "list_rows.h"

#include "atom_kokkos.h"
#include "atom_masks.h"
#include "comm.h"
#include "error.h"
#include "memory.h"
#include "my_page.h"
#include "neighbor.h"
#include "pair.h"

#include <Kokkos_Profiling_ScopedRegion.hpp>

#include <algorithm>
#include <numeric>

using namespace LAMMPS_NS;

template <class DeviceType>
ContactHistoryKokkos<DeviceType>::ContactHistoryKokkos(LAMMPS *lmp, int narg, char **arg) :
    ContactHistoryOnHost(lmp, narg, arg, false), host_list(lmp), partners(dnum, (dnum + 3) / 4)
{
  // what this fix reads of particles it asks for itself
  kokkosable = 1;
  execution_space = Host;
  datamask_read = datamask_modify = EMPTY_MASK;
  exchange_comm_device = sort_device = 1;
  exchange_head = 3;         // and where its numbers begin
  comm_forward = 1;          // whether a ghost is a new particle
  host_list.copymode = 1;    // it does not own its arrays
  on_device.quads_of_slot = (dnum + 3) / 4;
  clear_absent();
  partners.grow(atom->nmax);
  reserve_exchange();
}

template <class DeviceType>
Fix *ContactHistoryKokkos<DeviceType>::create(LAMMPS *lmp, int narg, char **arg)
{
  return new ContactHistoryKokkos(lmp, narg, arg);
}

template <class DeviceType>
ContactHistoryKokkos<DeviceType> *
ContactHistoryKokkos<DeviceType>::make(LAMMPS *lmp, const std::string &id, int values,
                                       Pair *contacts_of)
{
  return static_cast<ContactHistoryKokkos *>(
      ContactHistory::make(lmp, id, values, contacts_of, &create));
}

template <class DeviceType>
NeighList *ContactHistoryKokkos<DeviceType>::follow(NeighListKokkos<DeviceType> *list)
{
  device_list = list;
  return &host_list;
}

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::init()
{
  bring_partners_to_host();    // LAMMPS may be told to make new pages for them
  ContactHistory::init();
  clear_absent();
}

/* ---------------------------------------------------------------------- a new neighbour list */

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::pre_exchange()
{
  if (newton_pair || !nobody_has_moved()) {
    collect_partners_on_host();
    return;
  }
  partners.collect(*device_list, on_device, device_list_ids, atom->nlocal);
  partners_are_on_device = true;
  partners_are_on_host = false;
  maxpartner = partners.most();
  reserve_exchange();
}

/// As ContactHistory has it: with newton on, and after a fix that ran before this one has deleted or inserted particles.
template <class DeviceType> void ContactHistoryKokkos<DeviceType>::collect_partners_on_host()
{
  bring_to_host();
  list_ids.resize(nall_neigh);
  const Kokkos::View<tagint *, Kokkos::HostSpace, Kokkos::MemoryUnmanaged> ids(list_ids.data(),
                                                                               list_ids.size());
  Kokkos::deep_copy(ids, Kokkos::subview(device_list_ids, std::make_pair(0, nall_neigh)));
  atomKK->sync(Host, TAG_MASK);
  change_partners_on_host();
  ContactHistory::pre_exchange();
  clear_absent();
}

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::post_neighbor()
{
  send_partners_to_device();
  forget_newcomers();
  bigint stored = 0;
  if (just_restarted) {
    bring_partners_to_host();
    stored = std::accumulate(npartner, npartner + atom->nlocal, bigint{0});
  }

  nlocal_neigh = atom->nlocal;
  nall_neigh = atom->nlocal + atom->nghost;
  make_rows();
  atomKK->sync(ExecutionSpaceFromDevice<DeviceType>::space, TAG_MASK);
  const auto ids = atomKK->k_tag.template view<DeviceType>();
  partners.put_beside(*device_list, on_device, ids, parting_contacts);
  if (static_cast<int>(device_list_ids.extent(0)) < nall_neigh)
    device_list_ids = decltype(device_list_ids)(
        Kokkos::view_alloc("eepa:list_ids", Kokkos::WithoutInitializing), ids.extent(0));
  const auto present = std::make_pair(0, nall_neigh);
  Kokkos::deep_copy(Kokkos::subview(device_list_ids, present), Kokkos::subview(ids, present));

  list_is_on_host = false;
  device_is_newer = true;
  if (watches_radii()) atomKK->sync(Host, X_MASK | RADIUS_MASK);
  list_is_made();
  if (just_restarted) {
    bring_to_host();
    warn_of_lost_histories(stored);
  }
}

/// Removes new particles from the lists of partners, where there are some. Collective.
template <class DeviceType> void ContactHistoryKokkos<DeviceType>::forget_newcomers()
{
  new_here.clear();
  int mine = partners.has_newcomers(atom->nlocal) ? 1 : 0, some = 0;
  MPI_Allreduce(&mine, &some, 1, MPI_INT, MPI_MAX, world);
  if (!some) return;
  change_partners_on_host();
  atomKK->sync(Host, TAG_MASK);
  comm->forward_comm(this);
  forget_partners_with_new_ids();
  clear_absent();
  send_partners_to_device();
}

template <class DeviceType>
int ContactHistoryKokkos<DeviceType>::pack_forward_comm(int n, int *particles, double *buf,
                                                        int /*pbc_flag*/, int * /*pbc*/)
{
  return pack_border(n, particles, buf);
}

template <class DeviceType>
void ContactHistoryKokkos<DeviceType>::unpack_forward_comm(int n, int first, double *buf)
{
  unpack_border(n, first, buf);
}

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::post_integrate()
{
  if (!watches_radii()) return;
  atomKK->sync(Host, X_MASK | RADIUS_MASK);
  ContactHistory::post_integrate();
}

/// Makes the slots of the present neighbour list; what is in them is undefined.
template <class DeviceType> void ContactHistoryKokkos<DeviceType>::make_rows()
{
  const auto without = [](const std::string &name) {
    return Kokkos::view_alloc(name, Kokkos::WithoutInitializing);
  };
  const auto particles = device_list->d_numneigh.extent(0);
  if (on_device.first.extent(0) < particles)
    on_device.first = decltype(Rows::first)(without("eepa:first"), particles);
  slots = 0;
  Kokkos::parallel_scan(
      "eepa:place_slots", Kokkos::RangePolicy<DeviceType>(0, device_list->inum),
      PlaceSlots<DeviceType>{device_list->d_ilist, device_list->d_numneigh, on_device.first},
      slots);
  if (slots <= static_cast<bigint>(on_device.status.extent(0))) return;
  const bigint reserved = slots + slots / 8;      // lists vary a little in size
  on_device.status = decltype(Rows::status)();    // first, so that there is never memory for both
  on_device.quads = decltype(Rows::quads)();
  on_device.status = decltype(Rows::status)(without("eepa:status"), reserved);
  on_device.quads =
      decltype(Rows::quads)(without("eepa:quads"), reserved * on_device.quads_of_slot);
}

/* ---------------------------------------------------------------------- contacts on the host */

namespace {
/// A copy on the host, in memory of its own also where the host could reach the device's: so tests of a host's back end
/// find a copy that is missing.
template <class View> typename View::HostMirror copy_on_host(const View &view, bigint count)
{
  const auto part = Kokkos::subview(view, std::make_pair(bigint{0}, count));
  typename View::HostMirror copy(
      Kokkos::view_alloc(view.label() + ":host", Kokkos::WithoutInitializing), count);
  Kokkos::deep_copy(copy, part);
  return copy;
}
}    // namespace

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::copy_list_to_host()
{
  if (list_is_on_host) return;
  list_is_on_host = true;
  const NeighListKokkos<DeviceType> &list = *device_list;
  const auto particles = static_cast<bigint>(list.d_numneigh.extent(0));
  ilist_on_host = copy_on_host(list.d_ilist, list.inum);
  numneigh_on_host = copy_on_host(list.d_numneigh, particles);
  first_on_host = copy_on_host(on_device.first, particles);
  host_list.inum = list.inum;
  host_list.ilist = ilist_on_host.data();
  host_list.numneigh = numneigh_on_host.data();

  const Kokkos::View<int *, DeviceType> packed(
      Kokkos::view_alloc("eepa:neighbors", Kokkos::WithoutInitializing), slots);
  Kokkos::parallel_for("eepa:pack_neighbors", Kokkos::RangePolicy<DeviceType>(0, list.inum),
                       PackNeighbors<DeviceType>{list.d_ilist, list.d_numneigh, list.d_neighbors,
                                                 on_device.first, packed});
  neighbors_on_host.resize(slots);
  Kokkos::deep_copy(Kokkos::View<int *, Kokkos::HostSpace, Kokkos::MemoryUnmanaged>(
                        neighbors_on_host.data(), slots),
                    packed);
  firstneigh_on_host.assign(particles, nullptr);
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = host_list.ilist[ii];
    firstneigh_on_host[i] = neighbors_on_host.data() + first_on_host(i);
  }
  host_list.firstneigh = firstneigh_on_host.data();
}

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::bring_to_host()
{
  if (!device_is_newer) return;
  device_is_newer = false;
  const Kokkos::Profiling::ScopedRegion region("gran/eepa: contacts to the host");
  copy_list_to_host();
  status_on_host = copy_on_host(on_device.status, slots);
  const int quads = on_device.quads_of_slot;
  const auto quads_on_host = copy_on_host(on_device.quads, slots * quads);
  values_on_host.resize(slots * dnum);
  if (maxatom < nlocal_neigh) {
    maxatom = atom->nmax;
    firstflag =
        static_cast<int **>(memory->srealloc(firstflag, maxatom * sizeof(int *), "eepa:firstflag"));
    firstvalue = static_cast<double **>(
        memory->srealloc(firstvalue, maxatom * sizeof(double *), "eepa:firstvalue"));
  }
  for (int ii = 0; ii < host_list.inum; ii++) {
    const int i = host_list.ilist[ii];
    const bigint first = first_on_host(i);
    firstflag[i] = status_on_host.data() + first;
    firstvalue[i] = values_on_host.data() + first * dnum;
    for (bigint slot = first; slot < first + host_list.numneigh[i]; slot++)
      for (int k = 0; k < dnum; k++)
        values_on_host[slot * dnum + k] = quads_on_host(slot * quads + k / 4).value[k % 4];
  }
}

/* ---------------------------------------------------------------------- partners between host and device */

/// Gives the places behind the last particle empty lists on the host: all places are copied to the device.
template <class DeviceType> void ContactHistoryKokkos<DeviceType>::clear_absent()
{
  std::fill(npartner + atom->nlocal, npartner + owner.size(), 0);
}

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::bring_partners_to_host()
{
  if (partners_are_on_host) return;
  partners_are_on_host = true;
  const Kokkos::Profiling::ScopedRegion region("gran/eepa: partners to the host");
  const auto host = partners.to_host();
  const int quads = on_device.quads_of_slot;
  ipage_atom->reset();
  dpage_atom->reset();
  for (std::size_t i = 0; i < owner.size(); i++) {
    const int n = npartner[i] = host.count(i);
    owner[i] = host.owner(i);
    partner[i] = ipage_atom->get(n);
    valuepartner[i] = dpage_atom->get(dnum * n);
    if (!partner[i] || !valuepartner[i])
      error->one(
          FLERR,
          "pair_style gran/eepa: a particle has {} contacts, and neigh_modify one {} allows fewer",
          n, neighbor->oneatom);
    for (int m = 0; m < n; m++) {
      const bigint at = host.first(i) + m;
      partner[i][m] = host.ids(at);
      for (int k = 0; k < dnum; k++)
        valuepartner[i][dnum * m + k] = host.quads(at * quads + k / 4).value[k % 4];
    }
  }
}

/// Brings the lists of partners to the host, where they change next.
template <class DeviceType> void ContactHistoryKokkos<DeviceType>::change_partners_on_host()
{
  bring_partners_to_host();
  partners_are_on_device = false;
}

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::send_partners_to_device()
{
  if (partners_are_on_device) return;
  partners_are_on_device = true;
  const Kokkos::Profiling::ScopedRegion region("gran/eepa: partners to the device");
  const auto particles = owner.size();
  auto host = partners.room_on_host(std::accumulate(npartner, npartner + particles, bigint{0}));
  const int quads = on_device.quads_of_slot;
  bigint at = 0;
  int most = 0;
  for (std::size_t i = 0; i < particles; i++) {
    const int n = host.count(i) = npartner[i];
    host.owner(i) = owner[i];
    host.first(i) = at;
    most = std::max(most, n);
    for (int m = 0; m < n; m++, at++) {
      host.ids(at) = partner[i][m];
      for (int k = 0; k < dnum; k++)
        host.quads(at * quads + k / 4).value[k % 4] = valuepartner[i][dnum * m + k];
    }
  }
  partners.from_host(host, most);
}

/* ---------------------------------------------------------------------- going with a particle */

template <class DeviceType> void ContactHistoryKokkos<DeviceType>::grow_arrays(int nmax)
{
  const auto before = owner.size();
  ContactHistory::grow_arrays(nmax);
  std::fill(npartner + std::min<std::size_t>(before, nmax), npartner + nmax, 0);
  partners.grow(nmax);
}

template <class DeviceType>
int ContactHistoryKokkos<DeviceType>::pack_exchange_kokkos(const int &sent,
                                                           DAT::tdual_xfloat_2d &buffer,
                                                           DAT::tdual_int_1d sendlist,
                                                           DAT::tdual_int_1d copylist,
                                                           ExecutionSpace space)
{
  send_partners_to_device();
  partners_are_on_host = false;
  list_is_old = true;
  return partners.pack_exchange(sent, buffer, sendlist, copylist, space);
}

template <class DeviceType>
void ContactHistoryKokkos<DeviceType>::unpack_exchange_kokkos(DAT::tdual_xfloat_2d &buffer,
                                                              DAT::tdual_int_1d &indices,
                                                              int received, int received_first,
                                                              int numbers_first,
                                                              ExecutionSpace space)
{
  send_partners_to_device();
  partners_are_on_host = false;
  list_is_old = true;
  partners.unpack_exchange(buffer, indices, received, received_first, numbers_first, space);
  maxpartner = partners.most();
  reserve_exchange();
}

template <class DeviceType>
void ContactHistoryKokkos<DeviceType>::sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &sorter)
{
  send_partners_to_device();
  partners_are_on_host = false;
  list_is_old = true;
  partners.sort(sorter);
}

template <class DeviceType> double ContactHistoryKokkos<DeviceType>::memory_usage()
{
  return ContactHistory::memory_usage() + partners.memory_usage() +
      static_cast<double>(
             on_device.first.span() * sizeof(bigint) + on_device.status.span() * sizeof(int) +
             on_device.quads.span() * sizeof(eepa::Quad) + device_list_ids.span() * sizeof(tagint) +
             neighbors_on_host.capacity() * sizeof(int) +
             values_on_host.capacity() * sizeof(double));
}

namespace LAMMPS_NS {
template class ContactHistoryKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class ContactHistoryKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
