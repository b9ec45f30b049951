// SPDX-License-Identifier: GPL-2.0-only
// What a driver gets of one contact in a force call, and what a contact does to a wall's surface.

#include "support.h"

namespace step_test {
using namespace eepa_test;

using AnyModel = ContactLaw<LinearLaw<UnitExponent>, RollingSds, TwistingMarshall>;

const double dt = 1e-6;

Coefficients coefficients()
{
  Material m = material(eepa::Law::linear, 5e3, 1e4, 3e3, -1e-3);
  m.p.damping = Damping::restitution;
  m.p.restitution = 0.4;
  m.p.rolling = RollingModel::sds;
  m.p.mu_r = 0.1;
  m.p.kr = 1e3;
  m.p.rolling_viscous = 1e-3;
  m.p.twisting = TwistingModel::marshall;
  return resolve(m.p, m.law);
}
Contact contact()
{
  Bodies b;
  b.v_i = Vec3(-0.02, 0.05, 0.01);
  b.w_i = Vec3(20.0, 30.0, -40.0);
  return b.contact(dt);
}
History some_history()
{
  History history;
  history.max_overlap = 1.2e-5;
  history.tangential_spring = Vec3(0.0, 2e-7, -1e-7);
  history.rolling_spring = Vec3(0.0, 1e-7, 3e-7);
  history.twisting_spring = 2e-7;
  return history;
}
struct Row {
  double value[AnyModel::history_size];
  Row() { store_history<AnyModel::Layout>(some_history(), value); }
  History history() const
  {
    return load_history<AnyModel::Layout>(static_cast<const double *>(value));
  }
};
StepRequest in_step()
{
  return StepRequest::of_call(true, dt, true, false);
}

TEST(Step, ARequestIsThatOfTheCall)
{
  const StepRequest step = StepRequest::of_call(true, dt, true, false);
  EXPECT_EQ(step.time_step, dt);
  EXPECT_TRUE(step.advance && step.wants_energy && step.wants_losses && step.booked);
  const StepRequest setup = StepRequest::of_call(false, dt, true, true);
  EXPECT_EQ(setup.time_step, 0.0);
  EXPECT_FALSE(setup.advance || setup.wants_losses || setup.booked);
  EXPECT_TRUE(setup.wants_energy);
  const StepRequest plain = StepRequest::of_call(true, dt, false, false);
  EXPECT_FALSE(plain.wants_energy || plain.wants_losses);
  const StepRequest none;
  EXPECT_EQ(none.time_step, 0.0);
  EXPECT_FALSE(none.advance || none.wants_energy || none.wants_losses);
  EXPECT_TRUE(none.booked);
}

TEST(Step, GivesWhatTheLawGivesAndKeepsTheNewState)
{
  const Coefficients c = coefficients();
  for (const bool first : {false, true})
    for (const bool booked : {false, true}) {
      StepRequest request = in_step();
      request.booked = booked;
      Row row;
      History history = some_history();
      const Response response = AnyModel::evaluate(c, contact(), dt, history);
      const ContactOutcome outcome =
          step_contact<AnyModel>(c, request, contact(), first, row.value);
      const Wrench<double> wrench = AnyModel::wrench(response, contact());
      EXPECT_EQ(outcome.wrench.force, wrench.force);
      EXPECT_EQ(outcome.wrench.torque_i, wrench.torque_i);
      EXPECT_EQ(outcome.wrench.torque_j, wrench.torque_j);
      EXPECT_EQ(outcome.status, ContactStatus::of(response));
      EXPECT_EQ(outcome.max_overlap, history.max_overlap);
      EXPECT_EQ(outcome.energy.total(), AnyModel::stored_energy(c, contact(), history).total());
      const Dissipation lost = dissipation_of_step<AnyModel>(c, contact(), response, dt, first,
                                                             some_history(), history, booked);
      EXPECT_EQ(outcome.lost.total(), lost.total());
      EXPECT_NE(outcome.lost.total(), 0.0);
      EXPECT_EQ(row.history().tangential_spring, history.tangential_spring);
      EXPECT_NE(row.history().tangential_spring, some_history().tangential_spring);
    }
}

TEST(Step, ASetUpKeepsTheOldState)
{
  const Coefficients c = coefficients();
  Row row;
  const ContactOutcome outcome = step_contact<AnyModel>(
      c, StepRequest::of_call(false, dt, true, false), contact(), false, row.value);
  EXPECT_EQ(row.history().max_overlap, some_history().max_overlap);
  EXPECT_EQ(row.history().tangential_spring, some_history().tangential_spring);
  EXPECT_EQ(outcome.lost.total(), 0.0);
  EXPECT_GT(outcome.energy.total(), 0.0);
}

TEST(Step, WhatIsNotRequestedIsNone)
{
  const Coefficients c = coefficients();
  Row row, forces_row;
  const StepRequest request = StepRequest::of_call(true, dt, false, false);
  const ContactOutcome outcome = step_contact<AnyModel>(c, request, contact(), false, row.value);
  EXPECT_EQ(outcome.energy.total(), 0.0);
  EXPECT_EQ(outcome.lost.total(), 0.0);
  // the same for a caller that never wants more, whatever the request says
  const ContactOutcome forces =
      step_contact<AnyModel, Wanted::forces>(c, in_step(), contact(), false, forces_row.value);
  EXPECT_EQ(forces.wrench.force, outcome.wrench.force);
  EXPECT_EQ(forces.energy.total(), 0.0);
  EXPECT_EQ(forces.lost.total(), 0.0);
  EXPECT_EQ(forces_row.history().tangential_spring, row.history().tangential_spring);
  Row other;
  const ContactOutcome energies =
      step_contact<AnyModel, Wanted::energies>(c, in_step(), contact(), false, other.value);
  EXPECT_GT(energies.energy.total(), 0.0);
  EXPECT_EQ(energies.lost.total(), 0.0);
}

TEST(Step, AnOpeningLosesWhatTheContactStored)
{
  const Coefficients c = coefficients();
  Contact apart = contact();
  apart.overlap = -1e-9;
  for (const bool booked : {false, true}) {
    StepRequest request = in_step();
    request.booked = booked;
    const Dissipation lost = open_contact<AnyModel>(c, request, apart, Row().value);
    const Dissipation same = dissipation_of_opening<AnyModel>(c, apart, dt, some_history(), booked);
    EXPECT_EQ(lost.total(), same.total());
    EXPECT_GT(lost.total(), 0.0);
  }
}

TEST(Step, LossesAndEnergiesAddUp)
{
  Dissipation lost;
  lost.hysteresis = 1.0;
  lost.normal_dashpot = 2.0;
  lost.tangential_dashpot = 3.0;
  lost.sliding = 4.0;
  lost.rolling = 5.0;
  lost.twisting = 6.0;
  EXPECT_EQ(lost.total(), 21.0);
  for (int k = 0; k < Dissipation::Kinds::count; k++) EXPECT_EQ(lost.by_kind().value[k], k + 1.0);
  Dissipation sum = lost;
  sum.add(lost, 0.5);
  for (int k = 0; k < Dissipation::Kinds::count; k++)
    EXPECT_EQ(sum.by_kind().value[k], 1.5 * (k + 1.0));

  StoredEnergy energy;
  energy.normal = 3.0;
  energy.tangential = 2.0;
  energy.rolling = 4.0;
  energy.twisting = 8.0;
  StoredEnergy more = energy;
  more.add(energy, 0.5);
  EXPECT_EQ(more.normal, 4.5);
  EXPECT_EQ(more.tangential, 3.0);
  EXPECT_EQ(more.rolling, 6.0);
  EXPECT_EQ(more.twisting, 12.0);
  EXPECT_EQ(more.total(), 25.5);
}

TEST(Step, OverlapOfSpheresNowAndBefore)
{
  EXPECT_EQ(overlap_of_spheres(Vec3(1.0, 2.0, 4.0), 2.0, Vec3(-1.0, 1.0, 2.0), 1.5), 0.5);
  EXPECT_EQ(overlap_of_spheres(Vec3(1.0, 2.0, 4.0), 1.0, Vec3(-1.0, 1.0, 2.0), 1.5), -0.5);
  Bodies b;
  b.v_i = Vec3(-0.02, 0.05, 0.01);    // closes by 0.02 dt a step
  EXPECT_DOUBLE_EQ(overlap_before(b.contact(), 1e-5), b.overlap - 0.02 * 1e-5);
  EXPECT_EQ(size_of_pair(2.0, 1.5), 3.5);
  EXPECT_EQ(size_at_wall(2.0), 4.0);
}

/// A sphere on a wall, whose normal is x.
Contact on_wall(const Vec3 &velocity)
{
  Bodies b;
  b.R_j = b.m_j = infinity;
  b.v_i = velocity;
  return b.contact();
}

TEST(Wear, APressingForceWorksAlongSlidingAndApproach)
{
  Wrench<double> wrench;
  wrench.force = Vec3(3.0, -1.0, 2.0);
  wrench.torque_i.setZero();
  const SurfaceLoad load = load_on_surface(on_wall(Vec3(-0.5, 3.0, -4.0)), wrench, 0.1);
  EXPECT_EQ(load.normal_force, 3.0);
  EXPECT_EQ(load.shear, Vec3(0.0, 1.0, -2.0));
  EXPECT_DOUBLE_EQ(load.sliding_work, 3.0 * 5.0 * 0.1);
  EXPECT_DOUBLE_EQ(load.impact_work, 3.0 * 0.5 * 0.1);
}

TEST(Wear, APullingForceDoesNotWearAndALeavingSphereDoesNotStrike)
{
  Wrench<double> wrench;
  wrench.force = Vec3(-3.0, -1.0, 2.0);
  wrench.torque_i.setZero();
  const SurfaceLoad pull = load_on_surface(on_wall(Vec3(-0.5, 3.0, -4.0)), wrench, 0.1);
  EXPECT_EQ(pull.normal_force, -3.0);
  EXPECT_EQ(pull.shear, Vec3(0.0, 1.0, -2.0));
  EXPECT_EQ(pull.sliding_work, 0.0);
  EXPECT_EQ(pull.impact_work, 0.0);
  wrench.force[0] = 3.0;
  const SurfaceLoad leaves = load_on_surface(on_wall(Vec3(0.5, 3.0, -4.0)), wrench, 0.1);
  EXPECT_DOUBLE_EQ(leaves.sliding_work, 1.5);
  EXPECT_EQ(leaves.impact_work, 0.0);
}

}    // namespace step_test
