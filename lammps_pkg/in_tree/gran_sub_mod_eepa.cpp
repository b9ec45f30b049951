// SPDX-License-Identifier: GPL-2.0-only
#include "gran_sub_mod_eepa.h"

#include "granular_model.h"

#include <eepa/contact.h>
#include <eepa_commands/commands.h>
#include <eepa_commands/mixing.h>
#include <eepa_commands/parameter_table.h>
#include <eepa_commands/validation.h>

#include "comm.h"
#include "error.h"

#include <cmath>
#include <stdexcept>
#include <vector>

using namespace LAMMPS_NS;
using namespace Granular_NS;

namespace {

// LAMMPS stores the word NULL as this number.
constexpr double not_given = -1.0;

/// The parameters of a normal law, in the order in which they are typed. Friction is LAMMPS's.
std::vector<double eepa::Parameters::*> members_of(eepa::Law law)
{
  std::vector<double eepa::Parameters::*> members;
  eepa::for_each_number([&](const eepa::Number &number) {
    const bool positional = eepa::is_positional(number) && number.member != &eepa::Parameters::mu;
    if (positional || (number.law && *number.law == law)) members.push_back(number.member);
  });
  return members;
}

}    // namespace

template <class NormalLaw>
GranSubModNormalKernel<NormalLaw>::GranSubModNormalKernel(GranularModel *gm, LAMMPS *lmp) :
    GranSubModNormal(gm, lmp), coefficients()
{
  num_coeffs = static_cast<int>(members_of(NormalLaw::law).size()) + 2;
  size_history = 1;    // delta_max; its sign turns with i and j and is not read
  // refuses dampings that take the force for that of an elastic contact, and limit_damping
  cohesive_flag = 1;
}

template <class NormalLaw>
eepa::Parameters GranSubModNormalKernel<NormalLaw>::read_parameters(const double *from) const
{
  eepa::Parameters parameters;
  for (const auto member : members_of(NormalLaw::law)) parameters.*member = *from++;
  return parameters;
}

template <class NormalLaw> void GranSubModNormalKernel<NormalLaw>::coeffs_to_local()
{
  const eepa::Parameters parameters = read_parameters(coeffs);
  eepa::LawSettings settings;
  settings.law = NormalLaw::law;
  settings.scaled = coeffs[diameter_place()] != not_given;
  if (settings.scaled) settings.reference_diameter = coeffs[diameter_place()];
  eepa::Words warnings;
  try {
    for (const auto &wrong : eepa::validate(settings).errors) throw std::invalid_argument(wrong);
    eepa::require_valid(parameters, settings, warnings);
  } catch (const std::invalid_argument &invalid) {
    error->all(FLERR, "Granular normal model {}: {}", name, invalid.what());
  }
  if (comm->me == 0)
    for (const auto &warning : warnings)
      error->warning(FLERR, "Granular normal model {}: {}", name, warning);
  damp = coeffs[dashpot_place()];
  if (!(damp >= 0.0) || std::isinf(damp))
    error->all(FLERR, "Granular normal model {}: damping = {} is not allowed: it must be >= 0",
               name, damp);
  coefficients = eepa::resolve(parameters, settings);
}

template <class NormalLaw>
void GranSubModNormalKernel<NormalLaw>::mix_coeffs(double *icoeffs, double *jcoeffs)
{
  const int diameter = diameter_place(), dashpot = dashpot_place();
  if (icoeffs[diameter] != jcoeffs[diameter])
    error->all(FLERR, "Granular normal model {}: types with d_ref = {} and {} can not be mixed",
               name, icoeffs[diameter], jcoeffs[diameter]);
  eepa::Parameters mixed;
  std::string why;
  if (!eepa::mix(read_parameters(icoeffs), read_parameters(jcoeffs), mixed, why))
    error->all(FLERR, "Granular normal model {}: {}", name, why);
  double *to = coeffs;
  for (const auto member : members_of(NormalLaw::law)) *to++ = mixed.*member;
  coeffs[dashpot] = mix_geom(icoeffs[dashpot], jcoeffs[dashpot]);
  coeffs[diameter] = icoeffs[diameter];
  coeffs_to_local();
}

template <class NormalLaw> double GranSubModNormalKernel<NormalLaw>::calculate_forces()
{
  static_assert(NormalLaw::law != eepa::Law::plateau, "its friction bound has a part without mu");
  const bool pair = gm->contact_type == PAIR;
  eepa::Scale scale = eepa::contact_scale(
      coefficients, pair ? eepa::size_of_pair(gm->radi, gm->radj) : eepa::size_at_wall(gm->radi));
  scale.effective_radius = eepa::effective_radius(gm->radi, pair ? gm->radj : HUGE_VAL);
  double &max_overlap = gm->history[history_index];
  const eepa::NormalForce normal =
      NormalLaw::force(coefficients, scale, gm->delta, std::fabs(max_overlap));
  if (gm->history_update) max_overlap = normal.max_overlap;
  // LAMMPS multiplies it with mu
  friction_bound = eepa::max(normal.coulomb_force, 0.0);
  return normal.force;
}

template <class NormalLaw> void GranSubModNormalKernel<NormalLaw>::set_fncrit()
{
  Fncrit = friction_bound;
}

namespace LAMMPS_NS {
namespace Granular_NS {
  template class GranSubModNormalKernel<eepa::LinearLaw<eepa::UnitExponent>>;
  template class GranSubModNormalKernel<eepa::LudingLaw>;
}    // namespace Granular_NS
}    // namespace LAMMPS_NS
