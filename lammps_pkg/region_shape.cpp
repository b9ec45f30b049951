// SPDX-License-Identifier: GPL-2.0-only
#include "region_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;
using eepa::SurfacePoint;
using eepa::Vec3;

namespace {

/// What LAMMPS keeps for derived regions only.
class Access : public Region {
 public:
  static double *pivot_of(Region *region) { return region->*(&Access::point); }
  static double *axis_of(Region *region) { return region->*(&Access::runit); }
};

}    // namespace

void RegionShape::set_region(Region *region)
{
  const std::vector<Part> before = parts_;
  region_ = region;
  parts_.clear();
  add_parts(region, 0, false);
  if (before.size() != parts_.size()) return;
  for (std::size_t k = 0; k < parts_.size(); k++) parts_[k].motion = before[k].motion;
}

/// \param one_face  whether all faces of the region have the number first_face, as the parts of a union
/// have that is touched from outside
void RegionShape::add_parts(Region *region, int first_face, bool one_face)
{
  if (!region->reglist) {
    parts_.push_back({region, first_face + (one_face ? 1 : region->cmax), {}});
    return;
  }
  // where a part turns, LAMMPS turns the union as well, by an angle that it has not set
  region->theta = 0.0;
  std::fill_n(Access::pivot_of(region), 3, 0.0);
  std::fill_n(Access::axis_of(region), 3, 0.0);
  for (int k = 0; k < region->nregion; k++) {
    Region *part = region->reglist[k];
    add_parts(part, first_face, one_face || !region->interior);
    if (!one_face) first_face += region->interior ? part->cmax : 1;
  }
}

const RegionShape::Part &RegionShape::part_of(int face) const
{
  for (const Part &part : parts_)
    if (face < part.end_face) return part;
  return parts_.back();
}

void RegionShape::update(bigint step, double time_step)
{
  if (!region_->dynamic_check()) return;
  region_->prematch();
  for (Part &part : parts_) part.update(step, time_step);
}

/// Takes up place and size in a step. LAMMPS knows neither the velocity of a region in the first step that it is
/// asked for, nor that of one whose axis is not typed as a unit vector.
void RegionShape::Part::update(bigint step, double time_step)
{
  if (!region->dynamic_check()) return;
  // the region knows its size in the step before unless this is a new one
  const bool is_new = region->prev[4] == 0.0;
  if (motion.step != step || is_new) region->set_velocity();
  if (motion.step == step) {
    region->rprev = motion.size_before;
    return;
  }
  const bool goes_on = motion.step >= 0 && step == motion.step + 1;
  const Vec3 place(region->dx, region->dy, region->dz);
  motion.velocity.setZero();
  motion.angular_velocity.setZero();
  if (goes_on && region->moveflag) motion.velocity = (place - motion.displacement) / time_step;
  if (goes_on && region->rotateflag)
    motion.angular_velocity =
        (region->theta - motion.angle) / time_step * Vec3(Access::axis_of(region));
  motion.size_before = goes_on && region->varshape && !is_new ? region->rprev : 0.0;
  if (region->moveflag) motion.displacement = place;
  if (region->rotateflag) motion.angle = region->theta;
  motion.step = step;
}

Vec3 RegionShape::Part::pivot() const
{
  return Vec3(Access::pivot_of(region)) + motion.displacement;
}

/// \return number of places nearer than `reach`, in the region's own list
int RegionShape::contacts(const Vec3 &centre, double reach) const
{
  if (!region_->match(centre[0], centre[1], centre[2])) return 0;
  return region_->surface(centre[0], centre[1], centre[2], reach);
}

SurfacePoint RegionShape::point_of(int contact) const
{
  const Region::Contact &c = region_->contact[contact];
  SurfacePoint point;
  point.face = c.iwall;
  point.distance = c.r;
  if (c.r > 0.0) point.normal = Vec3(c.delx, c.dely, c.delz) / c.r;
  return point;
}

namespace {

/// Whether any part of a region that stands still has a surface within reach, on either side. What
/// surface() tells does not suffice: it leaves out places that another part of the region hides
/// from this centre, though not from the next one.
bool has_surface_near(Region *region, const Vec3 &centre, double reach)
{
  if (region->reglist) {
    for (int k = 0; k < region->nregion; k++)
      if (has_surface_near(region->reglist[k], centre, reach)) return true;
    return false;
  }
  double x[3] = {centre[0], centre[1], centre[2]};
  return region->surface_interior(x, reach) > 0 || region->surface_exterior(x, reach) > 0;
}

}    // namespace

bool RegionShape::collect(const Vec3 &centre, double reach, std::vector<eepa::SurfacePiece> &) const
{
  return moves() ? contacts(centre, reach) > 0 : has_surface_near(region_, centre, reach);
}

void RegionShape::visit(const Vec3 &centre, double radius, const eepa::SurfacePiece *, int,
                        std::vector<SurfacePoint> &found) const
{
  const int count = contacts(centre, radius);
  for (int k = 0; k < count; k++) {
    const SurfacePoint point = point_of(k);
    // on the surface itself no direction is known; the step before has warned of the overlap
    if (point.distance > 0.0) found.push_back(point);
  }
}

int RegionShape::find(int face, const Vec3 &normal, const Vec3 &centre, double reach) const
{
  int best = -1;
  double closest = -std::numeric_limits<double>::infinity();
  const int count = contacts(centre, reach);
  for (int k = 0; k < count; k++) {
    const SurfacePoint point = point_of(k);
    if (point.face != face) continue;
    const double alike = eepa::dot(point.normal, normal);
    if (alike <= closest) continue;
    closest = alike;
    best = k;
  }
  return best;
}

SurfacePoint RegionShape::nearest(int face, const Vec3 &centre) const
{
  const int k = find(face, Vec3::Zero(), centre, std::numeric_limits<double>::max());
  if (k >= 0) return point_of(k);
  SurfacePoint unknown;    // the centre is on the other side
  unknown.face = face;
  return unknown;
}

/// From the normals a little before and behind the centre, because a region does not tell how its
/// surface is curved.
Vec3 RegionShape::normal_rate(const SurfacePoint &point, const Vec3 &centre,
                              const Vec3 &velocity) const
{
  const eepa::SurfaceVelocity own = this->velocity(point, centre, Vec3::Zero());
  Vec3 along = velocity - own.linear;
  along -= eepa::dot(along, point.normal) * point.normal;
  const Vec3 rotation = own.angular.cross(point.normal);
  const double speed = along.norm();
  if (!(speed > 0.0)) return rotation;
  const double step = 1e-4 * point.distance;
  const Vec3 shift = step / speed * along;
  const double reach = 2.0 * point.distance;
  const int ahead = find(point.face, point.normal, centre + shift, reach);
  if (ahead < 0) return rotation;
  const Vec3 normal_ahead = point_of(ahead).normal;
  const int behind = find(point.face, point.normal, centre - shift, reach);
  if (behind < 0) return rotation;
  const Vec3 rate = 0.5 * speed / step * (normal_ahead - point_of(behind).normal);
  // rounding of the normals of a flat face is no curvature
  if (rate.norm() * point.distance < 1e-9 * speed) return rotation;
  return rate + rotation;
}

eepa::SurfaceVelocity RegionShape::velocity(const SurfacePoint &point, const Vec3 &centre,
                                            const Vec3 &path) const
{
  eepa::SurfaceVelocity velocity;
  const Part &part = part_of(point.face);
  if (!part.region->dynamic_check()) return velocity;
  velocity.linear = part.motion.velocity;
  velocity.angular = part.motion.angular_velocity;
  const Vec3 spot = centre - point.distance * point.normal;
  if (part.region->rotateflag) {
    const Vec3 arm = spot - path - part.pivot();
    velocity.linear += velocity.angular.cross(arm);
  }
  if (!(part.motion.size_before > 0.0)) return velocity;
  const int k = find(point.face, point.normal, centre, 2.0 * point.distance);
  if (k >= 0 && !region_->contact[k].varflag) return velocity;    // an end
  Vec3 growth = Vec3::Zero(), at = spot;
  part.region->velocity_contact_shape(growth.data(), at.data());
  velocity.linear += growth;
  return velocity;
}

/// That of the fastest part.
Vec3 RegionShape::drift(const Vec3 &point) const
{
  Vec3 most = Vec3::Zero();
  for (const Part &part : parts_) {
    Vec3 drift = part.motion.velocity;
    if (part.region->rotateflag) {
      const Vec3 arm = point - part.pivot();
      drift += part.motion.angular_velocity.cross(arm);
    }
    if (drift.squaredNorm() > most.squaredNorm()) most = drift;
  }
  return most;
}

/// Goes along the path in steps that can not jump over the surface without a point next to it.
bool RegionShape::is_between(const Vec3 &before, const Vec3 &now) const
{
  const Vec3 path = now - before;
  const double length = path.norm();
  constexpr int parts = 64;
  const double step = length / parts;
  for (int k = 0; k <= parts; k++)
    if (region_->surface(before[0] + k * path[0] / parts, before[1] + k * path[1] / parts,
                         before[2] + k * path[2] / parts, 0.51 * step) > 0)
      return true;
  return false;
}

/// A region without open faces can be left through its surface only.
bool RegionShape::is_behind(const Vec3 &centre) const
{
  for (const Part &part : parts_)
    if (part.region->openflag) return false;
  return !region_->match(centre[0], centre[1], centre[2]);
}

double RegionShape::extent(const Vec3 &point, const Vec3 &) const
{
  if (moves() || !region_->bboxflag) return std::numeric_limits<double>::infinity();
  const Vec3 corner(std::max(std::fabs(region_->extent_xlo), std::fabs(region_->extent_xhi)),
                    std::max(std::fabs(region_->extent_ylo), std::fabs(region_->extent_yhi)),
                    std::max(std::fabs(region_->extent_zlo), std::fabs(region_->extent_zhi)));
  return corner.norm() + point.norm();
}
