// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_PLATEN_H
#define LMP_EEPA_PLATEN_H

#include <cmath>
#include <limits>

namespace LAMMPS_NS {

/// A rigid plane of given mass that moves along its normal under an external force, the reaction of
/// the particles and a damping force -c v, by velocity Verlet like the particles. It knows nothing
/// of contacts.
///
/// Each half kick is the exact solution of m v' = f - c v at constant f. It is of second order,
/// symmetric in time, stable for any c, and for c = 0 that of Verlet.
class Platen {
 public:
  double mass = 0.0;                                           ///< > 0 [mass]
  double damping = 0.0;                                        ///< c >= 0 [mass/time]
  double lowest = -std::numeric_limits<double>::infinity();    ///< limits of travel [length]
  double highest = std::numeric_limits<double>::infinity();

  // kept in restart files
  double position = 0.0;      ///< [length]
  double velocity = 0.0;      ///< between start_step() and end_step(): at half a step
  double work = 0.0;          ///< done by the external force so far [energy]
  double dissipated = 0.0;    ///< by damping and at the limits so far [energy]

  /// Sets the forces at the present position, along +axis, in the set-up of a run.
  void set_forces(double applied, double reaction)
  {
    applied_ = applied;
    reaction_ = reaction;
  }

  double applied() const { return applied_; }
  double kinetic_energy() const { return 0.5 * mass * velocity * velocity; }
  /// Displacement in the present step [length]
  double travel() const { return travel_; }

  /// First half kick, and motion to the end of the step.
  void start_step(double dt)
  {
    kinetic_before_ = kinetic_energy();
    braked_ = kick(0.5 * dt);
    double next = position + dt * velocity;
    limited_ = next > highest || next < lowest;
    if (limited_) {
      // the velocity that particles see in this step is that of the shortened displacement
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
      // a stop is perfectly plastic; the platen leaves it when the force changes its sign
      velocity = 0.0;
      limited_ = true;
    }
    work += mean_applied * travel_;
    // Verlet turns the mean force times the displacement into kinetic energy, up to a term in dt^2
    // that does not accumulate. At a stop, the difference is what the stop dissipated.
    if (limited_)
      dissipated += kinetic_before_ + (mean_applied + mean_reaction) * travel_ - kinetic_energy();
    else if (dt > 0.0)
      dissipated += braked_ * travel_ / dt;
  }

  /// Starts a platen of the present mass at a given position and velocity. A gain of kinetic energy
  /// is booked as work from outside, a loss as dissipated.
  /// \param had  kinetic energy of the platen before, 0 where there was none [energy]
  void start(double place, double speed, double had)
  {
    position = place;
    velocity = speed;
    const double gain = kinetic_energy() - had;
    work += gain > 0.0 ? gain : 0.0;
    dissipated += gain < 0.0 ? -gain : 0.0;
  }
  /// Ends the platen, because another drive moves the wall; its kinetic energy is dissipated.
  void stop()
  {
    dissipated += kinetic_energy();
    velocity = 0.0;
  }

 private:
  double applied_ = 0.0, reaction_ = 0.0;    // at the last force call [force]
  double travel_ = 0.0;
  double kinetic_before_ = 0.0;    // kinetic energy at the beginning of the present step
  double braked_ = 0.0;            // impulse of the damping in the present step
  bool limited_ = false;           // whether a limit took part in the present step

  /// \return momentum taken by the damping [mass length/time]
  double kick(double time)
  {
    const double force = applied_ + reaction_;
    const double decay = damping * time / mass;
    const double lost = std::expm1(-decay);    // relative change of velocity, in (-1, 0]
    const double share = decay > 0.0 ? -lost / decay : 1.0;
    const double change = lost * velocity + time / mass * force * share;
    velocity += change;
    return damping > 0.0 ? time * force - mass * change : 0.0;
  }
};

}    // namespace LAMMPS_NS

#endif
