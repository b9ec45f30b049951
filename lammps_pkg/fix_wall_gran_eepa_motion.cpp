// SPDX-License-Identifier: GPL-2.0-only

// How FixWallGranEepa moves its wall: variables, steps, and changes of the drive.

#include "fix_wall_gran_eepa.h"

#include "error.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "variable.h"

#include <cmath>
#include <stdexcept>

using namespace LAMMPS_NS;
using eepa::WallDrive;

/* ---------------------------------------------------------------------- variables */

void FixWallGranEepa::require_variables(const eepa::MotionArguments &args) const
{
  for (const auto &component : args.velocity) require_equal_style("velocity", component.variable);
  require_equal_style("shear", args.shear.variable);
  require_equal_style("rotate omega", args.rotation.speed.variable);
  require_equal_style("load force", args.load.force.variable);
  require_equal_style("load pressure", args.load.pressure.variable);
  require_equal_style("load area", args.load.area.variable);
}

void FixWallGranEepa::require_equal_style(const char *what, const std::string &variable) const
{
  if (variable.empty()) return;
  const int index = input->variable->find(variable.c_str());
  if (index < 0)
    error->all(FLERR, "fix {} wall/gran/eepa: {} variable {} does not exist", id, what, variable);
  if (!input->variable->equalstyle(index))
    error->all(FLERR,
               "fix {} wall/gran/eepa: {} variable {} is not allowed: it must be equal-style", id,
               what, variable);
}

double FixWallGranEepa::evaluate(const char *what, const eepa::Quantity &quantity)
{
  if (quantity.variable.empty()) return quantity.value;
  // the variable may have changed since init(): `run pre no` calls none, and `run every` has
  // commands
  require_equal_style(what, quantity.variable);
  const double value =
      input->variable->compute_equal(input->variable->find(quantity.variable.c_str()));
  if (!std::isfinite(value))
    error->all(FLERR, "fix {} wall/gran/eepa: {} variable {} = {} at step {} is not finite", id,
               what, quantity.variable, value, update->ntimestep);
  return value;
}

/// Evaluates the user's velocities. Their variables may ask for this fix's own vector.
void FixWallGranEepa::evaluate_motion()
{
  bool any = !motion_args.shear.variable.empty() || !motion_args.rotation.speed.variable.empty();
  for (const auto &component : motion_args.velocity) any |= !component.variable.empty();
  if (!any) return;
  bring_all_to_host();
  modify->clearstep_compute();
  // evaluate all components before one is used
  WallMotion::Vector given;
  for (int k = 0; k < 3; k++) given[k] = evaluate("velocity", motion_args.velocity[k]);
  sliding = evaluate("shear", motion_args.shear);
  angular_speed = evaluate("rotate omega", motion_args.rotation.speed);
  motion.given = given;
  modify->addstep_compute(update->ntimestep + 1);
}

/// External force along the platen's axis. Its variables may ask for this fix's own vector.
double FixWallGranEepa::evaluate_load()
{
  const eepa::LoadArguments &load = motion_args.load;
  const bool any = !load.force.variable.empty() || !load.pressure.variable.empty() ||
      !load.area.variable.empty();
  if (any) {
    bring_all_to_host();
    modify->clearstep_compute();
  }
  double applied;
  if (load.by_pressure) {
    const double pressure = evaluate("load pressure", load.pressure);
    const double area = evaluate("load area", load.area);
    if (area <= 0.0)
      error->all(FLERR,
                 "fix {} wall/gran/eepa: load area variable {} = {} at step {} is not allowed: it "
                 "must be > 0",
                 id, load.area.variable, area, update->ntimestep);
    const bool from_above = typed_shape.is_plane() && !typed_shape.has_lo;
    applied = pressure * area * (from_above ? -1.0 : 1.0);
  } else {
    applied = evaluate("load force", load.force);
  }
  if (any) modify->addstep_compute(update->ntimestep + 1);
  return applied;
}

/* ---------------------------------------------------------------------- steps */

void FixWallGranEepa::initial_integrate(int /*vflag*/)
{
  if (needs_setup)
    error->all(FLERR,
               "{}: load was given by fix_modify after the last set-up, and its forces are not "
               "known: a run with pre no can not follow; leave out pre no",
               style_name());
  // the next force call sees the positions at the end of this step
  evaluate_motion();
  if (loaded()) platen.start_step(dt);
  motion.advance(dt);
  if (motion_args.rotates) placement.turn_to(placement.angle + angular_speed * dt);
}

void FixWallGranEepa::final_integrate()
{
  if (loaded()) platen.end_step(load_now, output_vector[FORCE_X + load_axis()], dt);
}

double FixWallGranEepa::initial_along(int axis) const
{
  return typed_shape.is_plane() && axis == typed_shape.axis() ? initial_position : 0.0;
}

double FixWallGranEepa::position() const
{
  if (loaded()) return platen.position;
  if (typed_shape.is_plane()) return initial_position + placement.displacement[typed_shape.axis()];
  return typed_shape.radius;    // 0 for a region or a mesh, which has no axis without a load
}

double FixWallGranEepa::normal_velocity() const
{
  if (loaded()) return platen.velocity;
  return typed_shape.is_plane() ? placement.velocity[typed_shape.axis()] : 0.0;
}

/// Moves the wall to the present position of motion and platen.
void FixWallGranEepa::place_wall()
{
  placement.displacement = eepa::Vec3(motion.displacement.data());
  placement.velocity = eepa::Vec3(motion.velocity().data());
  surface_speed = 0.0;
  if (loaded()) {
    const int dim = load_axis();
    placement.displacement[dim] = platen.position - initial_along(dim);
    placement.velocity[dim] = platen.velocity;
  }
  if (motion_args.slides) {
    if (typed_shape.is_plane() || motion_args.shear_axis == 2)
      placement.velocity[motion_args.shear_axis] = sliding;
    else
      surface_speed = sliding;
  }
  placement.set_angular_velocity(motion_args.rotates ? angular_speed : 0.0);
}

/* ---------------------------------------------------------------------- changes of the drive */

void FixWallGranEepa::require_limits(const eepa::LoadArguments &load, double place) const
{
  if (place < load.lowest || place > load.highest)
    error->all(FLERR,
               "fix {} wall/gran/eepa: load limits {:.6g} to {:.6g} are not allowed: the {} is "
               "at {:.6g}, outside of them",
               id, load.lowest, load.highest,
               typed_shape.is_plane() ? "plane" : "displacement of the wall", place);
}

void FixWallGranEepa::change_motion(const eepa::MotionArguments &next, bool rotation_goes_on)
{
  const bool was_loaded = loaded(), is_loaded = next.drive == WallDrive::load;
  const bool same_platen = was_loaded && is_loaded && next.load.axis == load_axis();
  // displacement and velocity at the end of the last step
  if (was_loaded) {
    const int dim = load_axis();
    motion.displacement[dim] = platen.position - initial_along(dim);
  }
  const double speed = placement.velocity[next.load.axis];
  const double had = same_platen ? platen.kinetic_energy() : 0.0;
  if (was_loaded && !same_platen) platen.stop();
  motion_args = next;
  motion.drive = next.drive;
  motion.wiggle_axis = next.wiggle_axis;
  motion.amplitude = next.amplitude;
  if (next.drive == WallDrive::wiggle) motion.period = next.period;
  for (int k = 0; k < 3; k++) motion.given[k] = next.velocity[k].value;
  sliding = next.shear.value;
  motion.begin();
  if (is_loaded) {
    const double place = same_platen
        ? platen.position
        : initial_along(next.load.axis) + motion.displacement[next.load.axis];
    platen.mass = next.load.mass;
    platen.damping = next.load.damping;
    platen.lowest = next.load.lowest;
    platen.highest = next.load.highest;
    platen.start(place, same_platen ? platen.velocity : speed, had);
    needs_setup = true;
  }
  angular_speed = next.rotation.speed.value;
  if (next.rotates && !rotation_goes_on) begin_rotation();
  place_wall();
}

/// Begins the rotation of motion_args at the present placement.
void FixWallGranEepa::begin_rotation()
{
  angle_before += placement.angle;
  placement.displacement = eepa::Vec3(motion.displacement.data());
  placement.begin_rotation(eepa::Vec3(motion_args.rotation.point.data()),
                           eepa::Vec3(motion_args.rotation.axis.data()));
  measure_rotation();
}

void FixWallGranEepa::measure_rotation()
{
  rotation_reach = shape->extent(placement.pivot_of_shape(), placement.axis_of_shape());
  rotation_is_new = true;
}

/// fix_modify ID still|velocity ...|wiggle ...|shear ...|rotate ...|load ...
int FixWallGranEepa::modify_param(int narg, char **arg)
{
  eepa::MotionArguments next;
  std::size_t read = 0;
  try {
    read = eepa::parse_wall_change(eepa::Words(arg, arg + narg), typed_shape, next);
  } catch (const std::invalid_argument &e) {
    error->all(FLERR, "fix_modify {} (wall/gran/eepa): {}", id, e.what());
  }
  if (read == 0) return 0;
  require_variables(next);
  if (next.drive == WallDrive::load)
    require_limits(next.load,
                   loaded() && next.load.axis == load_axis()
                       ? platen.position
                       : initial_along(next.load.axis) + placement.displacement[next.load.axis]);
  change_motion(next);
  return static_cast<int>(read);
}
