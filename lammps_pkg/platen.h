// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_PLATEN_H
#define LMP_EEPA_PLATEN_H

#include <cmath>
#include <limits>

namespace LAMMPS_NS {

/// A rigid plane of given mass that moves along its normal under a force from outside, the
/// reaction of the particles and a damping force -c v, by velocity Verlet as the particles do.
/// It knows nothing of contacts.
///
/// For c > 0 each half kick is the exact solution of m v' = f - c v for the force that it starts
/// with: of second order, symmetric in time, stable for any c, and Verlet's own for c = 0.
class Platen {
 public:
  double mass = 0.0;                                           ///< > 0 [mass]
  double damping = 0.0;                                        ///< c >= 0 [mass/time]
  double lowest = -std::numeric_limits<double>::infinity();    ///< limits of travel [length]
  double highest = std::numeric_limits<double>::infinity();

  // what a restart keeps
  double position = 0.0;      ///< [length]
  double velocity = 0.0;      ///< at half a step between start_step() and end_step()
  double work = 0.0;          ///< done by the force from outside so far [energy]
  double dissipated = 0.0;    ///< by damping and at the limits so far [energy]

  /// The forces at the present position, along +axis. For the set-up of a run.
  void set_forces(double applied, double reaction)
  {
    applied_ = applied;
    reaction_ = reaction;
  }

  double applied() const { return applied_; }
  double kinetic_energy() const { return 0.5 * mass * velocity * velocity; }
  /// Way of the present step [length]
  double travel() const { return travel_; }

  /// First half kick, and the way to the end of the step.
  void start_step(double dt)
  {
    kinetic_before_ = kinetic_energy();
    braked_ = kick(0.5 * dt);
    double next = position + dt * velocity;
    limited_ = next > highest || next < lowest;
    if (limited_) {
      // what particles meet in this step is the speed at which the rest of the way is made
      next = next > highest ? highest : lowest;
      velocity = (next - position) / dt;
    }
    travel_ = dt * velocity;
    position = next;
  }

  /// Second half kick, with the forces at the end of the step.
  void end_step(double applied, double reaction, double dt)
  {
    const double mean_applied = 0.5 * (applied_ + applied);
    const double mean_reaction = 0.5 * (reaction_ + reaction);
    set_forces(applied, reaction);
    braked_ += kick(0.5 * dt);
    if ((position >= highest && velocity > 0.0) || (position <= lowest && velocity < 0.0)) {
      // a stop takes all and gives nothing back; the platen leaves it when the forces turn
      velocity = 0.0;
      limited_ = true;
    }
    work += mean_applied * travel_;
    // Verlet turns the mean force times the way into kinetic energy, up to a term in dt^2 that does
    // not add up. At a stop, what is missing afterwards is what the stop took.
    if (limited_)
      dissipated += kinetic_before_ + (mean_applied + mean_reaction) * travel_ - kinetic_energy();
    else if (dt > 0.0)
      dissipated += braked_ * travel_ / dt;
  }

  /// A platen of the present mass at a given place and speed, whose kinetic energy was `had` before
  /// (0 where there was none). What it gains comes from outside, as the work of the load does; what
  /// it loses is booked as dissipated.
  void start(double place, double speed, double had)
  {
    position = place;
    velocity = speed;
    const double gain = kinetic_energy() - had;
    work += gain > 0.0 ? gain : 0.0;
    dissipated += gain < 0.0 ? -gain : 0.0;
  }
  /// No platen any more: something else drives the wall, and its kinetic energy is lost.
  void stop()
  {
    dissipated += kinetic_energy();
    velocity = 0.0;
  }

 private:
  double applied_ = 0.0, reaction_ = 0.0;    // at the last force call [force]
  double travel_ = 0.0;
  double kinetic_before_ = 0.0;    // of the present step
  double braked_ = 0.0;            // impulse of the damping in the present step
  bool limited_ = false;           // whether a limit took part in the present step

  /// \return the momentum that the damping took
  double kick(double time)
  {
    const double force = applied_ + reaction_;
    const double decay = damping * time / mass;
    const double lost = std::expm1(-decay);    // of the velocity, in (-1, 0]
    const double share = decay > 0.0 ? -lost / decay : 1.0;
    const double change = lost * velocity + time / mass * force * share;
    velocity += change;
    return damping > 0.0 ? time * force - mass * change : 0.0;
  }
};

}    // namespace LAMMPS_NS

#endif
