// SPDX-License-Identifier: GPL-2.0-only
#include "citations.h"

#include "citeme.h"
#include "lammps.h"

using namespace LAMMPS_NS;
using eepa::Law;
using eepa::LawSettings;
using eepa::Parameters;

namespace {

/// A paper and who has to cite it.
struct Citation {
  bool (*concerns)(const LawSettings &, const Parameters &);
  const char *text;    ///< first line for the screen, the rest for the log file
};

constexpr Citation citations[] = {
    {[](const LawSettings &law, const Parameters &) {
       return law.law != Law::luding;
     },
     "contact law gran/eepa: doi:10.1007/s10035-014-0506-4\n\n"
     "@Article{Thakur2014,\n"
     " author =  {S. C. Thakur and J. P. Morrissey and J. Sun and J. F. Chen and J. Y. Ooi},\n"
     " title =   {Micromechanical analysis of cohesive granular materials using the discrete\n"
     "            element method with an adhesive elasto-plastic contact model},\n"
     " journal = {Granular Matter},\n"
     " year =    2014,\n"
     " volume =  16,\n"
     " pages =   {383}\n"
     "}\n\n"},
    {[](const LawSettings &law, const Parameters &p) {
       return law.law == Law::luding || p.rolling == eepa::RollingModel::sds;
     },
     "law luding and rolling sds of gran/eepa: doi:10.1007/s10035-008-0099-x\n\n"
     "@Article{Luding2008,\n"
     " author =  {S. Luding},\n"
     " title =   {Cohesive, frictional powders: contact models for tension},\n"
     " journal = {Granular Matter},\n"
     " year =    2008,\n"
     " volume =  10,\n"
     " pages =   {235}\n"
     "}\n\n"},
    {[](const LawSettings &law, const Parameters &) {
       return law.law == Law::luding;
     },
     "law luding of gran/eepa, its restitution: arXiv:1503.03720\n\n"
     "@Article{Singh2015,\n"
     " author =  {A. Singh and V. Magnanimo and S. Luding},\n"
     " title =   {A contact model for sticking of adhesive meso-particles},\n"
     " journal = {arXiv},\n"
     " year =    2015,\n"
     " number =  {1503.03720}\n"
     "}\n\n"},
    {[](const LawSettings &law, const Parameters &) {
       return law.scaled;
     },
     "scale of gran/eepa: doi:10.1016/j.powtec.2015.05.051\n\n"
     "@Article{Thakur2016,\n"
     " author =  {S. C. Thakur and J. Y. Ooi and H. Ahmadian},\n"
     " title =   {Scaling of discrete element model parameters for cohesionless and cohesive\n"
     "            solid},\n"
     " journal = {Powder Technology},\n"
     " year =    2016,\n"
     " volume =  293,\n"
     " pages =   {130}\n"
     "}\n\n"},
    {[](const LawSettings &, const Parameters &p) {
       return p.rolling == eepa::RollingModel::constant;
     },
     "rolling constant of gran/eepa: doi:10.1016/j.powtec.2010.09.030\n\n"
     "@Article{Ai2011,\n"
     " author =  {J. Ai and J. F. Chen and J. M. Rotter and J. Y. Ooi},\n"
     " title =   {Assessment of rolling resistance models in discrete element simulations},\n"
     " journal = {Powder Technology},\n"
     " year =    2011,\n"
     " volume =  206,\n"
     " pages =   {269}\n"
     "}\n\n"},
    {[](const LawSettings &, const Parameters &p) {
       return p.twisting == eepa::TwistingModel::marshall;
     },
     "twisting marshall of gran/eepa: doi:10.1016/j.jcp.2008.11.006\n\n"
     "@Article{Marshall2009,\n"
     " author =  {J. S. Marshall},\n"
     " title =   {Discrete-element modeling of particulate aerosol flows},\n"
     " journal = {Journal of Computational Physics},\n"
     " year =    2009,\n"
     " volume =  228,\n"
     " pages =   {1541}\n"
     "}\n\n"},
};

}    // namespace

void LAMMPS_NS::cite_papers(LAMMPS *lmp, const LawSettings &law, const Parameters &parameters)
{
  if (!lmp->citeme) return;
  for (const Citation &citation : citations)
    if (citation.concerns(law, parameters)) lmp->citeme->add(citation.text);
}
