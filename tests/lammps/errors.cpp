// SPDX-License-Identifier: GPL-2.0-only

// Every error of the pair style, the wall and the computes names command, argument, value and what
// is allowed. Messages of the shared parser are tested word by word in tests/parser.

#include "simulation.h"

#include <gtest/gtest.h>

using namespace eepa_test;

namespace {

struct Mistake {
  const char *lines, *regex;
};

class PairMistake : public testing::TestWithParam<Mistake> {};

TEST_P(PairMistake, IsNamed)
{
  Simulation simulation;
  simulation.open_box(3.0, 2);
  simulation.create({{Vec3(0, 0, 0)}, {Vec3(1.5, 0, 0)}, {Vec3(0, 1.5, 0)}, {Vec3(1.5, 1.5, 0)}});
  simulation("fix integrate all nve/sphere\ntimestep 1e-5");
  EXPECT_TRUE(refuses(simulation, GetParam().lines, GetParam().regex));
}

const Mistake pair_mistakes[] = {
    {"pair_style gran/eepa",
     "pair_style gran/eepa: missing value: law \\(plateau, linear or luding\\)"},
    {"pair_style gran/eepa hertz",
     "pair_style gran/eepa: law 'hertz' is unknown: it must be plateau, linear or luding"},
    {"pair_style gran/eepa linear scale nan",
     "pair_style gran/eepa: scale d_ref = nan is not a finite number"},
    {"pair_style gran/eepa plateau exponent 2",
     "pair_style gran/eepa: exponent = 2 is not allowed with plateau"},
    {"pair_style gran/eepa luding\npair_coeff * * 1e4 2e4 0 0 0",
     "pair_coeff \\* \\* for gran/eepa: depth must be given with luding"},
    {"pair_style gran/eepa linear\npair_coeff * * 1e4 2e4 0 0 0 depth 0.1",
     "pair_coeff \\* \\* for gran/eepa: keyword depth is not allowed with linear: only luding has "
     "it"},
    {"pair_style gran/eepa luding\npair_coeff * * 1e4 1e4 0 0 0 depth 0.1",
     "k2 = 10000 is not allowed with luding: it must be > k1 = 10000"},
    {"pair_style gran/eepa linear\npair_coeff 1 1 1e4 1e4 0 0 0 bound contact\n"
     "pair_coeff 2 2 1e4 1e4 0 0 0\nrun 0",
     "pair_coeff 1 2 can not be mixed: one has bound adhesive and the other bound contact"},
    // settings changed after the coefficients were given
    {"pair_style gran/eepa luding\npair_coeff * * 1e4 2e4 0 0 0 depth 0.1\n"
     "pair_style gran/eepa linear\nrun 0",
     "pair_coeff 1 1 for gran/eepa: depth is not allowed with linear"},
    {"pair_style gran/eepa linear\npair_coeff", "[Mm]issing|[Ii]ncorrect|[Ii]llegal"},
    {"pair_style gran/eepa linear\npair_coeff 1",
     "pair_coeff for gran/eepa: missing types I J|[Ii]ncorrect|[Ii]llegal"},
    {"pair_style gran/eepa linear\npair_coeff 1 3 1 1 0 0 0", "3|out of (bounds|range)"},
    {"pair_style gran/eepa linear\npair_coeff 1 2",
     "pair_coeff 1 2 for gran/eepa: missing value: k1"},
    {"pair_style gran/eepa linear\npair_coeff 1 * 1e4 1e3 0 0 0",
     "pair_coeff 1 \\* for gran/eepa: k2 = 1000 is not allowed: it must be >= k1 = 10000"},
    {"pair_style gran/eepa linear\npair_coeff 1 1 1e4 nan 0 0 0",
     "pair_coeff 1 1 for gran/eepa: k2 = nan is not a finite number"},
    {"pair_style gran/eepa linear\npair_coeff 2* 1*1 1e4 1e4 0 0 0",
     "pair_coeff 2\\* 1\\*1 for gran/eepa: no pair of types with I <= J"},
    {"pair_style gran/eepa plateau\npair_coeff * * 1e4 1.5e4 0 0 0",
     "k2 = 15000 is not allowed with plateau: it must be >= 2 k1 = 20000.*use linear"},
    {"pair_style gran/eepa linear\npair_coeff 1 1 1e4 1e4 0 0 0\nrun 0",
     "All pair coeffs are not set|pair_coeff 1 2 is not given and can not be mixed without 1 1 and "
     "2 "
     "2"},
    {"pair_style gran/eepa linear\npair_coeff 1 1 1e4 1e4 0 0 0 restitution 0.5\n"
     "pair_coeff 2 2 1e4 1e4 0 0 0 viscous 1 1\nrun 0",
     "pair_style gran/eepa: pair_coeff 1 2 can not be mixed: one has restitution and the other "
     "viscous damping; give it"},
    {"pair_style gran/eepa linear\npair_coeff 1 1 1e4 1e4 0 0 0 rolling constant 0.1\n"
     "pair_coeff 2 2 1e4 1e4 0 0 0 rolling sds 1 1 1\nrun 0",
     "pair_style gran/eepa: pair_coeff 2 2 has another rolling model than those before; constant "
     "and "
     "sds can not be used together"},
    // the settings changed after the coefficients were checked against others
    {"pair_style gran/eepa linear\npair_coeff * * 1e4 1e4 0 0 0\npair_style gran/eepa plateau\nrun "
     "0",
     "pair_coeff 1 1 for gran/eepa: k2 = 10000 is not allowed with plateau"},
    {"pair_style gran/eepa linear\npair_coeff * * 1e4 1e4 0 0 0\n"
     "pair_style gran/eepa linear exponent 1.5\nrun 0",
     "pair_coeff 1 1 for gran/eepa: kt must be given"},
    {"pair_style gran/eepa linear\npair_coeff * * 1e4 1e4 0 0 0\ncomm_modify vel no\nrun 0",
     "pair_style gran/eepa: ghost atoms must have velocities; use comm_modify vel yes"},
    {"pair_style gran/eepa linear\npair_coeff * * 1e4 1e4 0 0 0\nrun 0 post no\n"
     "pair_coeff * * 1e4 1e4 0 0 0 rolling sds 1 1 1\nrun 0",
     "pair_style gran/eepa: rolling sds and twisting can not be switched on or off after a run"},
    {"pair_style gran/eepa linear\npair_coeff * * 1e4 1e4 0 0 0\ngroup a id 1\ngroup b id 2\n"
     "fix a a freeze\nfix b b freeze\nrun 0",
     "fix a freeze and fix b freeze are active, and LAMMPS allows one: .*'group frozen union a b'"},
    {"pair_style gran/eepa linear dtcheck error\npair_coeff * * 1e4 1e4 0 0 0\ntimestep 1\nrun 0",
     "pair_style gran/eepa: timestep 1 is larger than 0.002 = 0.2 sqrt\\(m_min/k_max\\), which the "
     "pair of types"},
};
INSTANTIATE_TEST_SUITE_P(Lines, PairMistake, testing::ValuesIn(pair_mistakes));

TEST(AtomStyle, WithoutRadiusIsRefusedByThePairStyle)
{
  Simulation simulation;
  EXPECT_TRUE(
      refuses(simulation,
              "units si\natom_style atomic\nregion box block 0 1 0 1 0 1\ncreate_box 1 box\n"
              "mass 1 1\ncomm_modify vel yes\npair_style gran/eepa linear\n"
              "pair_coeff 1 1 1 1 0 0 0\nrun 0",
              "pair_style gran/eepa: atoms must have radius, rmass, omega and torque; use "
              "atom_style sphere"));
}

TEST(AtomStyle, WithoutRadiusIsRefusedByTheWall)
{
  Simulation simulation;
  EXPECT_TRUE(
      refuses(simulation,
              "units si\natom_style atomic\nboundary f f f\nregion box block 0 1 0 1 0 1\n"
              "create_box 1 box\nfix w all wall/gran/eepa linear coeff 1 1 0 0 0 wall zplane "
              "0 NULL",
              "fix w wall/gran/eepa: atoms must have radius, rmass, omega and torque"));
}

TEST(AtomStyle, WithoutIdsIsRefused)
{
  Simulation simulation;
  EXPECT_TRUE(
      refuses(simulation,
              "units si\natom_style sphere\natom_modify id no\nregion box block 0 1 0 1 0 1\n"
              "create_box 1 box\ncomm_modify vel yes\npair_style gran/eepa linear\n"
              "pair_coeff 1 1 1 1 0 0 0\nrun 0",
              "pair_style gran/eepa: atoms must have IDs; use atom_modify id yes"));
}

class WallMistake : public testing::TestWithParam<Mistake> {};

TEST_P(WallMistake, IsNamed)
{
  Simulation simulation;
  simulation.open_box(3.0, 1, "f f p");
  simulation.create({{Vec3(0, 0, 0)}});
  simulation("fix integrate all nve/sphere\npair_style zero 1.0\npair_coeff * *\ntimestep 1e-5\n"
             "variable peratom atom x\nvariable two equal 2");
  EXPECT_TRUE(refuses(simulation, std::string("fix w all wall/gran/eepa ") + GetParam().lines,
                      std::string("fix w wall/gran/eepa") + GetParam().regex));
}

#define COEFF "linear coeff 1e4 2e4 0 0 0 "
const Mistake wall_mistakes[] = {
    {"hertz", ": law 'hertz' is unknown: it must be plateau, linear or luding"},
    {"linear scale 0 coeff 1 1 0 0 0 wall xplane 0 1", ": scale d_ref = 0 is not allowed"},
    {"linear", ": missing keyword coeff"},
    {"linear wall", ": keyword 'wall' is unknown"},
    {"linear coeff 1e4 2e4 0 0 wall xplane 0 1", ": missing value: mu"},
    {"linear coeff 1e4 1e3 0 0 0 wall xplane 0 1",
     ": k2 = 1000 is not allowed: it must be >= k1 = 10000"},
    {"plateau coeff 1e4 1.5e4 0 0 0 wall xplane 0 1", ": k2 = 15000 is not allowed with plateau"},
    {"luding coeff 1e4 2e4 0 0 0 wall xplane 0 1", ": depth must be given with luding"},
    {COEFF "bound free wall xplane 0 1",
     ": bound 'free' is unknown: it must be adhesive or contact"},
    {COEFF, ": missing keyword wall"},
    {COEFF "wall", ": missing value: kind of wall"},
    {COEFF "wall sphere 1",
     ": wall 'sphere' is unknown: it must be xplane, yplane, zplane[ ,].*zcylinder"},
    {COEFF "wall xplane", ": missing value: wall planes lo hi"},
    {COEFF "wall xplane 0", ": missing value: wall planes lo hi"},
    {COEFF "wall xplane NULL NULL", ": wall xplane NULL NULL has no surface: give lo, hi or both"},
    {COEFF "wall xplane 1 0", ": wall xplane lo = 1 is not allowed: it must be < hi = 0"},
    {COEFF "wall xplane 1 1", ": wall xplane lo = 1 is not allowed"},
    {COEFF "wall xplane nan 1", ": wall lo = nan is not a finite number"},
    {COEFF "wall xplane 0 inf", ": wall hi = inf is not a finite number"},
    {COEFF "wall xplane null 1", ": wall lo = null is not a finite number"},
    {COEFF "wall zplane 0 NULL", ": wall zplane can not be used where z is periodic"},
    {COEFF "wall zcylinder", ": missing value: wall zcylinder R"},
    {COEFF "wall zcylinder 0", ": wall zcylinder R = 0 is not allowed: it must be > 0"},
    {COEFF "wall zcylinder x", ": wall zcylinder R = x is not a finite number"},
    {COEFF "wall xplane 0 1 spin 2", ": keyword 'spin' is unknown: it must be velocity, wiggle"},
    {COEFF "wall xplane 0 1 velocity 1 2", ": missing value: velocity vx vy vz"},
    {COEFF "wall xplane 0 1 velocity 1 2 z", ": velocity = z is not a finite number"},
    {COEFF "wall xplane 0 1 velocity 1 0 0 wiggle x 1 1",
     ": only one of velocity, wiggle, shear, load and rotate is allowed"},
    {COEFF "wall xplane 0 1 velocity 1 0 0 velocity 1 0 0",
     ": only one of velocity, wiggle, shear, load and rotate is allowed"},
    {COEFF "wall xplane 0 1 wiggle x 1", ": missing value: wiggle dim A period"},
    {COEFF "wall xplane 0 1 wiggle w 1 1",
     ": wiggle dimension 'w' is not allowed: it must be x, y or z"},
    {COEFF "wall xplane 0 1 wiggle x 1 0", ": wiggle period = 0 is not allowed: it must be > 0"},
    {COEFF "wall xplane 0 1 wiggle x a 1", ": wiggle A = a is not a finite number"},
    {COEFF "wall xplane 0 1 shear y", ": missing value: shear dim v"},
    {COEFF "wall xplane 0 1 shear x 1",
     ": shear dimension x is not allowed: it must lie in the plane"},
    {COEFF "wall xplane 0 1 shear q 1", ": shear dimension 'q' is not allowed"},
    {COEFF "wall xplane 0 1 shear y nan", ": shear v = nan is not a finite number"},
    {COEFF "wall xplane 0 1 velocity v_none 0 0\nrun 0", ": velocity variable none does not exist"},
    {COEFF "wall xplane 0 1 velocity v_peratom 0 0\nrun 0",
     ": velocity variable peratom is not allowed: it must be equal-style"},
    {COEFF "wall xplane 0 1\nrun_style respa 2 2\nrun 0", " can not be used with run_style respa"},
    {"linear dtcheck error coeff 1e4 1e4 0 0 0 wall xplane 0 1\ntimestep 1\nrun 0",
     ": timestep 1 is larger than 0.002 = 0.2 sqrt\\(m_min/k_max\\) of contacts with this wall"},
};
INSTANTIATE_TEST_SUITE_P(Lines, WallMistake, testing::ValuesIn(wall_mistakes));

TEST(WallMistakeOfTheBox, CylinderInAPeriodicBoxIsNamed)
{
  for (const char *boundary : {"p f f", "f p f"}) {
    Simulation simulation;
    simulation.open_box(3.0, 1, boundary);
    EXPECT_TRUE(refuses(simulation, "fix w all wall/gran/eepa " COEFF "wall zcylinder 2",
                        "fix w wall/gran/eepa: wall zcylinder can not be used where x or y is "
                        "periodic"));
  }
}

TEST(WallMistakeOfTheBox, PlanesAcrossAPeriodicDimensionAreNamed)
{
  for (const char *dim : {"x", "y", "z"}) {
    Simulation simulation;
    simulation.open_box(3.0, 1, "p p p");
    EXPECT_TRUE(refuses(
        simulation, std::string("fix w all wall/gran/eepa " COEFF "wall ") + dim + "plane 0 1",
        std::string("wall ") + dim + "plane can not be used where " + dim + " is periodic"));
  }
}

class ComputeMistake : public testing::TestWithParam<Mistake> {};

TEST_P(ComputeMistake, IsNamed)
{
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({{Vec3(0, 0, 0)}});
  simulation("fix integrate all nve/sphere\npair_style zero 1.0\npair_coeff * *\ntimestep 1e-5");
  EXPECT_TRUE(refuses(simulation, GetParam().lines, GetParam().regex));
}
const Mistake compute_mistakes[] = {
    {"compute c all gran/eepa/contacts 5 6",
     "compute gran/eepa/contacts takes no arguments, 2 given: 5"},
    {"compute c all gran/eepa/dt x",
     "compute gran/eepa/dt: keyword .x. is unknown: it must be particles"},
    {"compute c all gran/eepa/energy x", "compute gran/eepa/energy takes no arguments, 1 given: x"},
    {"compute c all gran/eepa/energy/atom x",
     "compute gran/eepa/energy/atom takes no arguments, 1 given: x"},
    {"compute c all gran/eepa/energy/atom\nrun 0",
     "compute gran/eepa/energy/atom needs pair_style gran/eepa or fix wall/gran/eepa"},
    {"group g id 1\ncompute c g gran/eepa/energy",
     "compute gran/eepa/energy: group g is not allowed: it must be all"},
    {"compute c all gran/eepa/energy\nrun 0",
     "compute gran/eepa/energy needs pair_style gran/eepa or fix wall/gran/eepa"},
    {"compute c all gran/eepa/contacts\nrun 0",
     "compute gran/eepa/contacts needs pair_style gran/eepa"},
    {"compute c all gran/eepa/dt\nrun 0",
     "compute gran/eepa/dt needs pair_style gran/eepa or fix wall/gran/eepa"},
};
INSTANTIATE_TEST_SUITE_P(Lines, ComputeMistake, testing::ValuesIn(compute_mistakes));

// After an error the instance is still usable: nothing half done is left behind.
TEST(AfterAnError, TheNextCommandWorks)
{
  Simulation simulation;
  simulation.open_box(3.0);
  simulation.create({{Vec3(0, 0, 0)}, {Vec3(0.99, 0, 0)}});
  simulation("fix integrate all nve/sphere\npair_style gran/eepa linear\n"
             "pair_coeff 1 1 1e4 2e4 0 0 0\ntimestep 1e-5");
  EXPECT_NE(error_of(simulation, "pair_coeff 1 1 5e4 2e4 0 0 0"), "");
  EXPECT_NE(error_of(simulation, "pair_style gran/eepa linear exponent 3"), "");
  EXPECT_NE(error_of(simulation, "fix w all wall/gran/eepa linear coeff 1 1 0 0 0 wall zplane"),
            "");
  simulation("run 0 post no");
  EXPECT_NEAR(simulation.particle(2).f.x(), 100.0, 1e-9);
}

}    // namespace
