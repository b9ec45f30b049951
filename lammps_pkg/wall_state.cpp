// SPDX-License-Identifier: GPL-2.0-only
#include "wall_state.h"

#include <eepa_commands/restart_numbers.h>
#include <eepa_commands/wall_commands.h>

#include "fmt/format.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace LAMMPS_NS::wall_state;

namespace {

const char *name_of(int index)
{
  static const char *const names[] = {"format",
                                      "count",
                                      "kind",
                                      "sides",
                                      "lo",
                                      "hi",
                                      "radius",
                                      "law",
                                      "exponent",
                                      "rolling spring",
                                      "twisting spring",
                                      "values a contact",
                                      "drive",
                                      "displacement",
                                      "displacement",
                                      "displacement",
                                      "origin of motion",
                                      "origin of motion",
                                      "origin of motion",
                                      "time before",
                                      "time step",
                                      "number of steps",
                                      "wiggle dimension",
                                      "wiggle A",
                                      "wiggle period",
                                      "velocity",
                                      "velocity",
                                      "velocity",
                                      "speed of the surface",
                                      "load mass",
                                      "load position",
                                      "load velocity",
                                      "load work",
                                      "load dissipation"};
  static_assert(sizeof(names) / sizeof(names[0]) == VECTOR, "a name for each number");
  if (index < VECTOR) return names[index];
  if (index < ROTATES) return "output";
  if (index < LOAD_AXIS) return "rotation";
  if (index < MORE_VECTOR) return index == SHAPE_CHECK ? "shape" : "load axis or region";
  return "output";
}

}    // namespace

std::string wall_state::damage(const std::vector<double> &state)
{
  const auto wrong = [&state](int index) {
    return fmt::format("{} = {}", name_of(index), state[index]);
  };
  for (int k = 0; k < N_STATE; k++)
    if (!std::isfinite(state[k])) return wrong(k);
  constexpr double huge = 9007199254740992.0;    // 2^53: larger integers are not exact
  const struct {
    int index;
    double least, most;
  } integers[] = {{KIND, 0, eepa::WallShape::kind_count - 1},
                  {SIDES, 0, 3},
                  {LAW, 0, eepa::law_count - 1},
                  {ROLLING_SPRING, 0, 1},
                  {TWISTING_SPRING, 0, 1},
                  {DRIVE, 0, eepa::drive_count - 1},
                  {VALUES_A_CONTACT, 1, 1000},
                  {TIME_STEPS, 0, huge},
                  {WIGGLE_AXIS, 0, 2},
                  {ROTATES, 0, 1},
                  {LOAD_AXIS, 0, 2},
                  {REGION_STEP, -1, huge},
                  {WEAR, 0, huge}};
  for (const auto &number : integers)
    if (!eepa::is_count(state[number.index], number.least, number.most)) return wrong(number.index);
  for (const int index : {EXPONENT, WIGGLE_PERIOD})
    if (state[index] <= 0.0) return wrong(index);
  for (const int index : {RADIUS, PLATEN_MASS, TIME_STEP, REGION_SIZE_BEFORE})
    if (state[index] < 0.0) return wrong(index);
  return "";
}
