// SPDX-License-Identifier: GPL-2.0-only

// How FixWallGranEepa moves its surfaces: variables, steps, and changes of the drive.

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
  bool any = !motion_args.shear.variable.empty();
  for (const auto &component : motion_args.velocity) any |= !component.variable.empty();
  if (!any) return;
  modify->clearstep_compute();
  // evaluate all components before one is used
  WallMotion::Vector given;
  for (int k = 0; k < 3; k++) given[k] = evaluate("velocity", motion_args.velocity[k]);
  sliding = evaluate("shear", motion_args.shear);
  motion.given = given;
  modify->addstep_compute(update->ntimestep + 1);
}

/// External force along the plane's axis. Its variables may ask for this fix's own vector.
double FixWallGranEepa::evaluate_load()
{
  const eepa::LoadArguments &load = motion_args.load;
  const bool any = !load.force.variable.empty() || !load.pressure.variable.empty() ||
      !load.area.variable.empty();
  if (any) modify->clearstep_compute();
  double applied;
  if (load.by_pressure) {
    const double pressure = evaluate("load pressure", load.pressure);
    const double area = evaluate("load area", load.area);
    if (area <= 0.0)
      error->all(FLERR,
                 "fix {} wall/gran/eepa: load area variable {} = {} at step {} is not allowed: it "
                 "must be > 0",
                 id, load.area.variable, area, update->ntimestep);
    applied = pressure * area * surfaces.inward();
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
               "known: a run with pre no can not follow; leave pre no away",
               style_name());
  // the next force call sees the positions at the end of this step
  evaluate_motion();
  if (loaded()) platen.start_step(dt);
  motion.advance(dt);
}

void FixWallGranEepa::final_integrate()
{
  if (loaded()) platen.end_step(load_now, output_vector[FORCE_X + surfaces.axis()], dt);
}

/// Moves the surfaces to the present position of motion and platen.
void FixWallGranEepa::place_surfaces()
{
  surfaces.lo = initial_position[0];
  surfaces.hi = initial_position[1];
  surfaces.displacement = motion.displacement;
  surfaces.velocity = motion.velocity();
  surfaces.surface_speed = 0.0;
  if (loaded()) {
    const int dim = surfaces.axis();
    surfaces.place(platen.position);
    surfaces.displacement[dim] = 0.0;
    surfaces.velocity[dim] = platen.velocity;
  }
  if (motion_args.slides) {
    if (surfaces.is_plane() || motion_args.shear_axis == 2)
      surfaces.velocity[motion_args.shear_axis] = sliding;
    else
      surfaces.surface_speed = sliding;
  }
}

/* ---------------------------------------------------------------------- changes of the drive */

void FixWallGranEepa::require_limits(const eepa::LoadArguments &load, double place) const
{
  if (place < load.lowest || place > load.highest)
    error->all(FLERR,
               "fix {} wall/gran/eepa: load limits {:.6g} to {:.6g} are not allowed: the plane is "
               "at {:.6g}, outside of them",
               id, load.lowest, load.highest, place);
}

void FixWallGranEepa::change_motion(const eepa::MotionArguments &next)
{
  const bool was_loaded = loaded(), is_loaded = next.drive == WallDrive::load;
  // position and velocity at the end of the last step
  const double place = was_loaded ? platen.position : surfaces.position();
  const double speed = was_loaded ? platen.velocity : surfaces.normal_velocity();
  if (was_loaded) {
    const int dim = surfaces.axis();
    motion.displacement[dim] = place - initial_position[surfaces.has_lo ? 0 : 1];
    if (!is_loaded) platen.stop();
  }
  const double had = was_loaded && is_loaded ? platen.kinetic_energy() : 0.0;
  motion_args = next;
  motion.drive = next.drive;
  motion.wiggle_axis = next.wiggle_axis;
  motion.amplitude = next.amplitude;
  if (next.drive == WallDrive::wiggle) motion.period = next.period;
  for (int k = 0; k < 3; k++) motion.given[k] = next.velocity[k].value;
  sliding = next.shear.value;
  motion.begin();
  if (is_loaded) {
    platen.mass = next.load.mass;
    platen.damping = next.load.damping;
    platen.lowest = next.load.lowest;
    platen.highest = next.load.highest;
    platen.start(place, speed, had);
    needs_setup = true;
  }
  place_surfaces();
}

/// fix_modify ID still|velocity ...|wiggle ...|shear ...|load ...
int FixWallGranEepa::modify_param(int narg, char **arg)
{
  eepa::MotionArguments next;
  std::size_t read = 0;
  try {
    read = eepa::parse_wall_change(eepa::Words(arg, arg + narg), surfaces, next);
  } catch (const std::invalid_argument &e) {
    error->all(FLERR, "fix_modify {} (wall/gran/eepa): {}", id, e.what());
  }
  if (read == 0) return 0;
  require_variables(next);
  if (next.drive == WallDrive::load)
    require_limits(next.load, loaded() ? platen.position : surfaces.position());
  change_motion(next);
  return static_cast<int>(read);
}
