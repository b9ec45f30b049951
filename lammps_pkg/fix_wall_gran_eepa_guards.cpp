// SPDX-License-Identifier: GPL-2.0-only

// How FixWallGranEepa finds particles that are behind the wall, and what it says.

#include "fix_wall_gran_eepa.h"

#include "atom.h"
#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;
using eepa::FaceHistory;
using eepa::Vec3;

/// Whether a centre moved towards a face by so much that it can be behind it. The velocity of the wall is
/// not exactly that of the step, and a contact that ends moves the other way.
bool FixWallGranEepa::got_through(const eepa::Body<double> &body, const FaceHistory &history) const
{
  if (!request.advance) return false;
  Vec3 path = dt * placement.direction_to_shape(body.v - placement.velocity_at(body.x));
  if (shape->moves()) path -= dt * shape->drift(placement.to_shape(body.x));
  return eepa::dot(path, history.normal) < -0.5 * history.distance;
}

/// Stops where a particle was on one side of the wall a step ago and is on the other side now. One that
/// moves by less than its radius in a step can not get through without a contact.
void FixWallGranEepa::require_slow(int i) const
{
  if (!request.advance || !is_member(i)) return;
  const Vec3 x(atom->x[i]), v(atom->v[i]);
  const double radius = atom->radius[i];
  Vec3 path = dt * (v - placement.velocity_at(x));
  if (shape->moves())
    path -= dt * placement.direction_to_space(shape->drift(placement.to_shape(x)));
  if (!(path.squaredNorm() > radius * radius)) return;
  const Vec3 now = placement.to_shape(x);
  const Vec3 before = now - placement.direction_to_shape(path);
  if (shape->is_between(before, now)) stop_behind_wall(i);
}

void FixWallGranEepa::stop_at_overlap(int i, int face, double overlap) const
{
  const bool lower = face == 0;
  const double place = (lower ? typed_shape.lo : typed_shape.hi) +
      placement.displacement[typed_shape.is_plane() ? typed_shape.axis() : 0];
  error->one(FLERR,
             "fix {} wall/gran/eepa: atom {} overlaps the wall by {:.6g} at step {}, more than its "
             "radius {:.6g}: the time step is too large, the stiffness too small or the wall too "
             "fast; or it was put behind the plane: {} {} at {:.6g} bounds a half space",
             id, atom->tag[i], overlap, update->ntimestep, atom->radius[i], typed_shape.kind_name(),
             lower ? "lo" : "hi", place);
}

void FixWallGranEepa::stop_behind_wall(int i) const
{
  std::string what = typed_shape.kind_name();
  if (typed_shape.kind == eepa::WallShape::zcylinder)
    what = fmt::format("cylinder of radius {:.6g}", typed_shape.radius);
  if (typed_shape.kind == eepa::WallShape::region) what += " " + typed_shape.region_id;
  if (typed_shape.kind == eepa::WallShape::mesh) what += " " + typed_shape.file;
  const Vec3 relative = Vec3(atom->v[i]) - placement.velocity_at(Vec3(atom->x[i]));
  error->one(FLERR,
             "fix {} wall/gran/eepa: the center of atom {} is through the {} at step {}, at {:.6g} "
             "{:.6g} {:.6g}: it moves by {:.6g} a step and its radius is {:.6g}; the time step is "
             "too large, the stiffness too small or the wall too fast",
             id, atom->tag[i], what, update->ntimestep, atom->x[i][0], atom->x[i][1], atom->x[i][2],
             dt * relative.norm(), atom->radius[i]);
}
