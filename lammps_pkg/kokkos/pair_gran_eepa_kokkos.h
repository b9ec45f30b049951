/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifdef PAIR_CLASS
// clang-format off
PairStyle(gran/eepa/kk,PairGranEepaKokkos<LMPDeviceType>);
PairStyle(gran/eepa/kk/device,PairGranEepaKokkos<LMPDeviceType>);
PairStyle(gran/eepa/kk/host,PairGranEepaKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_PAIR_GRAN_EEPA_KOKKOS_H
#define LMP_PAIR_GRAN_EEPA_KOKKOS_H

#include "pair_gran_eepa.h"

#include "contact_engine_kokkos.h"
#include "contact_history_kokkos.h"

#include "kokkos_type.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

/// pair_style gran/eepa/kk: the force call of gran/eepa on a device. Everything else is gran/eepa: commands, mixing,
/// restart files, checks and outputs.
template <class DeviceType> class PairGranEepaKokkos : public PairGranEepa {
 public:
  typedef DeviceType device_type;

  PairGranEepaKokkos(class LAMMPS *);
  ~PairGranEepaKokkos() override;
  void compute(int, int) override;
  void init_style() override;
  void init_list(int, class NeighList *) override;
  double memory_usage() override;

 protected:
  void bring_to_host(HostData) override;
  class ContactHistory *make_history(int values) override;
  void check_radii() override;

 private:
  template <class T> using DeviceArray = Kokkos::View<T *, DeviceType>;

  void require_all_pairs_of_types() const;
  void bring_what_new_lists_need();
  void send_coefficients();
  void send_bodies();
  void allocate_tallies_of_atoms();
  ContactStep<DeviceType> step_of_call();
  void take_sums(const StepSums &);
  void take_losses_of_atoms();
  void stop_where_too_deep();

  std::unique_ptr<const ContactEngineKokkos<DeviceType>> device_engine;
  ContactHistoryKokkos<DeviceType> *device_history = nullptr;    // the same as fix_history
  NeighListKokkos<DeviceType> *device_list = nullptr;            // `list` is its copy on the host

  DeviceArray<eepa::Coefficients> device_coefficients;    // (ntypes+1)^2
  DeviceArray<double> device_allowed_radius;              // by type
  DeviceArray<double> body_mass, body;                    // of fix rigid, as in ContactMasses
  DAT::tdual_efloat_1d energy_of_atoms;
  DAT::tdual_virial_array virial_of_atoms;
  Kokkos::View<double **, Kokkos::LayoutRight, DeviceType> losses_of_atoms;
  Kokkos::View<unsigned long long, DeviceType> deep;
};

}    // namespace LAMMPS_NS

#endif
#endif
