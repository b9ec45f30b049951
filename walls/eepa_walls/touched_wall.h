// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_TOUCHED_WALL_H
#define EEPA_WALLS_TOUCHED_WALL_H

#include "placement.h"
#include "shape.h"

#include <eepa/body.h>

namespace eepa {

/// The wall as the law sees it at a contact: in space and with the motion of its shape.
/// \param rate  of the normal in the shape's frame, while the shape stands still [1/time]
/// \param surface_speed  of a cylinder's surface about its axis [length/time]
/// \param time_step  the step to the present positions; 0 in a set-up [time]
EEPA_FUNCTION WallPoint<double> touched_wall(const SurfacePoint &point, const Body<double> &body,
                                             const RigidMotion &motion, const Vec3 &rate,
                                             double surface_speed, double time_step)
{
  WallPoint<double> wall;
  wall.normal = motion.direction_to_space(point.normal);
  wall.overlap = body.radius - point.distance;
  wall.normal_rate = motion.direction_to_space(rate);
  const Vec3 spot = middle_of_overlap(body, wall.normal, wall.overlap);
  // as the particle's velocity, that of half a step ago
  wall.velocity = motion.velocity_before(spot, body.v, 0.5 * time_step);
  if (motion.turns()) {
    wall.angular_velocity = motion.angular_velocity();
    wall.normal_rate += wall.angular_velocity.cross(wall.normal);
  }
  if (surface_speed != 0.0) {
    const Vec3 around(wall.normal[1], -wall.normal[0], 0.0);
    wall.velocity += (point.face == 0 ? -surface_speed : surface_speed) * around;
  }
  return wall;
}

/// The wall at the end of the step, as the force is.
EEPA_FUNCTION WallPoint<double> at_end_of_step(const WallPoint<double> &wall,
                                               const Body<double> &body, const RigidMotion &motion,
                                               double time_step)
{
  WallPoint<double> now = wall;
  const Vec3 spot = middle_of_overlap(body, wall.normal, wall.overlap);
  now.velocity += motion.velocity_at(spot) - motion.velocity_before(spot, body.v, 0.5 * time_step);
  return now;
}

}    // namespace eepa

#endif
