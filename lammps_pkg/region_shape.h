// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_REGION_SHAPE_H
#define LMP_EEPA_REGION_SHAPE_H

#include <eepa_walls/shape.h>

#include "lmptype.h"
#include "region.h"

#include <array>

namespace LAMMPS_NS {

/// Motion of a region by its own keywords, as last seen. Kept in restart files.
struct RegionMotion {
  bigint step = -1;    ///< time step of this motion; -1 before the first
  eepa::Vec3 displacement = eepa::Vec3::Zero();
  double angle = 0.0;
  eepa::Vec3 velocity = eepa::Vec3::Zero(), angular_velocity = eepa::Vec3::Zero();
};

/// The surface of one of LAMMPS's regions. Particles touch it on the side that the region's keyword
/// `side` names, and on both where a face is open. The numbers of its faces are LAMMPS's own; some
/// regions give several faces one number.
class RegionShape final : public eepa::Shape {
 public:
  explicit RegionShape(Region *region) : region_(region) {}

  /// Finds the region again before a run; it may have been deleted and defined anew.
  void set_region(Region *region) { region_ = region; }

  /// Takes up place and size of the region in this step. Variables of the region are evaluated, so
  /// that all processes have to call it.
  /// \param time_step  since the last call in another step [time]
  void update(bigint step, double time_step);

  RegionMotion motion;

  bool collect(const eepa::Vec3 &centre, double reach, std::vector<int> &pieces) const override;
  void visit(const eepa::Vec3 &centre, double radius, const int *pieces, int count,
             std::vector<eepa::SurfacePoint> &found) const override;
  eepa::SurfacePoint nearest(int face, const eepa::Vec3 &centre) const override;
  eepa::Vec3 normal_rate(const eepa::SurfacePoint &point, const eepa::Vec3 &centre,
                         const eepa::Vec3 &velocity) const override;
  bool moves() const override { return region_->dynamic_check() != 0; }
  eepa::SurfaceVelocity velocity(const eepa::SurfacePoint &point, const eepa::Vec3 &centre,
                                 const eepa::Vec3 &path) const override;
  bool is_between(const eepa::Vec3 &before, const eepa::Vec3 &now) const override;
  double extent(const eepa::Vec3 &point, const eepa::Vec3 &axis) const override;
  bool has_face(int face) const override { return face >= 0; }

 private:
  Region *region_;
  bool size_rate_known_ = false;    // whether the region has seen its size in the step before

  int contacts(const eepa::Vec3 &centre, double reach) const;
  eepa::SurfacePoint point_of(int contact) const;
  /// The contact at a face whose normal is nearest to a given one.
  /// \return its number in the region's list, or -1
  int find(int face, const eepa::Vec3 &normal, const eepa::Vec3 &centre, double reach) const;
};

}    // namespace LAMMPS_NS

#endif
