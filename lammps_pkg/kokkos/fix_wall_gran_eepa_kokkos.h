/* -*- c++ -*- SPDX-License-Identifier: GPL-2.0-only */
#ifdef FIX_CLASS
// clang-format off
FixStyle(wall/gran/eepa/kk,FixWallGranEepaKokkos<LMPDeviceType>);
FixStyle(wall/gran/eepa/kk/device,FixWallGranEepaKokkos<LMPDeviceType>);
FixStyle(wall/gran/eepa/kk/host,FixWallGranEepaKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_WALL_GRAN_EEPA_KOKKOS_H
#define LMP_FIX_WALL_GRAN_EEPA_KOKKOS_H

#include "fix_wall_gran_eepa.h"

#include "contact_engine_kokkos.h"
#include "wall_histories_kokkos.h"
#include "wall_surface_kokkos.h"

#include "kokkos_base.h"

#include <memory>

namespace LAMMPS_NS {

/// fix wall/gran/eepa/kk: the force call of wall/gran/eepa on a device. Everything else is wall/gran/eepa: commands,
/// motion, platens, restart files and outputs. Walls whose shape has no WallSurfaceKokkos are wall/gran/eepa
/// altogether, on the host.
template <class DeviceType>
class FixWallGranEepaKokkos : public FixWallGranEepa, public KokkosBase {
 public:
  typedef DeviceType device_type;

  FixWallGranEepaKokkos(class LAMMPS *, int, char **);
  void post_constructor() override;
  void init() override;
  double memory_usage() override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  int pack_exchange_kokkos(const int &, DAT::tdual_xfloat_2d &, DAT::tdual_int_1d,
                           DAT::tdual_int_1d, ExecutionSpace) override;
  void unpack_exchange_kokkos(DAT::tdual_xfloat_2d &, DAT::tdual_int_1d &, int, int, int,
                              ExecutionSpace) override;
  void sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &) override;

 protected:
  void warn_of_device() override;
  void bring_sizes_to_host() override;
  void bring_all_to_host() override;
  void add_contacts() override;

 private:
  using Step = WallStep<DeviceType>;

  Step step_of_call();
  void collect_on_device(Step &);
  bool one_is_far() const;
  void prepare_tallies(Step &);
  void take_tallies(const Step &, const WallTallies &);
  void take_sums(const WallSums &);
  [[noreturn]] void stop_run(bigint stop);

  MadeSurface<DeviceType> surface;    // or none: all is on the host
  std::unique_ptr<WallHistoriesKokkos<DeviceType>> device_histories;
  std::unique_ptr<const ContactEngineKokkos<DeviceType>> device_engine;

  Kokkos::View<double *, DeviceType> body_mass;                // of fix rigid, as in ContactMasses
  typename ArrayTypes<DeviceType>::t_x_array device_places;    // as `places`
  bool watches_places = false;
  Step buffers;    // of which only the arrays are kept
};

}    // namespace LAMMPS_NS

#endif
#endif
