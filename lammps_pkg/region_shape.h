// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_REGION_SHAPE_H
#define LMP_EEPA_REGION_SHAPE_H

#include <eepa_walls/shape.h>

#include "lmptype.h"
#include "region.h"

#include <vector>

namespace LAMMPS_NS {

/// Motion of a region by its own keywords, as last seen. Kept in restart files.
struct RegionMotion {
  bigint step = -1;    ///< time step of this motion; -1 before the first
  eepa::Vec3 displacement = eepa::Vec3::Zero();
  double angle = 0.0;
  eepa::Vec3 velocity = eepa::Vec3::Zero(), angular_velocity = eepa::Vec3::Zero();
  double size_before =
      0.0;    ///< variable radius in the step before; 0 where it is not known [length]
};

/// The surface of one of LAMMPS's regions. Particles touch it on the side that the region's keyword
/// `side` names, and on both where a face is open. The numbers of its faces are LAMMPS's own; some
/// regions give several faces one number.
class RegionShape final : public eepa::Shape {
 public:
  explicit RegionShape(Region *region) { set_region(region); }

  /// Finds the region again before a run; it may have been deleted and defined anew.
  void set_region(Region *region);

  /// Takes up place and size of the region in this step. Variables of the region are evaluated, so
  /// that all processes have to call it.
  /// \param time_step  since the last call in another step [time]
  void update(bigint step, double time_step);

  /// Unknown for a region of several parts, each of which may move in its own way.
  RegionMotion motion() const { return parts_.size() == 1 ? parts_[0].motion : RegionMotion(); }
  void set_motion(const RegionMotion &motion)
  {
    if (parts_.size() == 1) parts_[0].motion = motion;
  }

  bool collect(const eepa::Vec3 &centre, double reach,
               std::vector<eepa::SurfacePiece> &pieces) const override;
  void visit(const eepa::Vec3 &centre, double radius, const eepa::SurfacePiece *pieces, int count,
             std::vector<eepa::SurfacePoint> &found) const override;
  eepa::SurfacePoint nearest(int face, const eepa::Vec3 &centre) const override;
  eepa::Vec3 normal_rate(const eepa::SurfacePoint &point, const eepa::Vec3 &centre,
                         const eepa::Vec3 &velocity) const override;
  bool moves() const override { return region_->dynamic_check() != 0; }
  eepa::SurfaceVelocity velocity(const eepa::SurfacePoint &point, const eepa::Vec3 &centre,
                                 const eepa::Vec3 &path) const override;
  eepa::Vec3 drift(const eepa::Vec3 &point) const override;
  bool is_between(const eepa::Vec3 &before, const eepa::Vec3 &now) const override;
  bool is_behind(const eepa::Vec3 &centre) const override;
  double extent(const eepa::Vec3 &point, const eepa::Vec3 &axis) const override;
  bool has_face(int face) const override { return face >= 0; }

 private:
  /// A region, or one of those that a union or intersection is made of.
  struct Part {
    Region *region;
    int end_face;    // above the numbers of its faces in region_
    RegionMotion motion;

    eepa::Vec3 pivot() const;
    void update(bigint step, double time_step);
  };

  Region *region_ = nullptr;
  std::vector<Part> parts_;

  void add_parts(Region *region, int first_face, bool numbered_by_part);
  const Part &part_of(int face) const;

  int contacts(const eepa::Vec3 &centre, double reach) const;
  eepa::SurfacePoint point_of(int contact) const;
  /// The contact at a face whose normal is nearest to a given one.
  /// \return its number in the region's list, or -1
  int find(int face, const eepa::Vec3 &normal, const eepa::Vec3 &centre, double reach) const;
};

}    // namespace LAMMPS_NS

#endif
