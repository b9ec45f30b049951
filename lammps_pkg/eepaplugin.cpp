// SPDX-License-Identifier: GPL-2.0-only

// Entry of eepaplugin.so: `plugin load eepaplugin.so`, or LAMMPS_PLUGIN_PATH.

#include "eepa_styles.h"

#include "error.h"
#include "lammps.h"
#include "lammpsplugin.h"
#include "library.h"
#include "lmptype.h"
#include "plugin.h"
#include "utils.h"
#include "version.h"

using namespace LAMMPS_NS;

namespace {

// The version and integer sizes that the plugin was compiled for. Both change the layout of
// classes, so a mismatch would crash a run or make it wrong; LAMMPS only logs the version and does
// not check integer sizes. They are asked for through the C library interface, which does not
// depend on that layout.
void require_same_lammps(LAMMPS *lmp)
{
  if (lammps_version(lmp) != utils::date2num(LAMMPS_VERSION))
    lmp->error->all(FLERR,
                    "plugin eepaplugin.so was compiled for LAMMPS version {} and can not be loaded "
                    "into version {}: compile it against that version",
                    utils::date2num(LAMMPS_VERSION), lammps_version(lmp));
  const auto tagint_size = static_cast<int>(sizeof(tagint));
  const auto bigint_size = static_cast<int>(sizeof(bigint));
  const auto imageint_size = static_cast<int>(sizeof(imageint));
  if (lammps_extract_setting(lmp, "tagint") != tagint_size ||
      lammps_extract_setting(lmp, "bigint") != bigint_size ||
      lammps_extract_setting(lmp, "imageint") != imageint_size)
    lmp->error->all(
        FLERR,
        "plugin eepaplugin.so was compiled for tagint, bigint and imageint of {}, {} and "
        "{} bytes and can not be loaded into a LAMMPS with {}, {} and {}: compile it with "
        "the same LAMMPS_SIZES",
        tagint_size, bigint_size, imageint_size, lammps_extract_setting(lmp, "tagint"),
        lammps_extract_setting(lmp, "bigint"), lammps_extract_setting(lmp, "imageint"));
}

// LAMMPS has one list of plugins for all its instances in a process, and does not enter a style that is
// in it a second time, not even in the lists of styles of another instance.
bool registered_from_here(const EepaStyle &style, void *handle)
{
  const int index = plugin_find(style.category, style.name);
  return index >= 0 && plugin_get_info(index)->handle == handle;
}

}    // namespace

// LAMMPS calls this for each of its instances, since each opens the library.
extern "C" void lammpsplugin_init(void *lammps, void *handle, void *register_function)
{
  auto *lmp = static_cast<LAMMPS *>(lammps);
  require_same_lammps(lmp);
  const auto register_plugin = reinterpret_cast<lammpsplugin_regfunc>(register_function);
  for (const auto &style : eepa_styles()) {
    lammpsplugin_t plugin;
    plugin.version = LAMMPS_VERSION;
    plugin.style = style.category;
    plugin.name = style.name;
    plugin.info = style.info;
    plugin.author = "the eepa developers, version " EEPA_VERSION;
    plugin.handle = handle;
    if (style.make_pair)
      plugin.creator.v1 = reinterpret_cast<lammpsplugin_factory1 *>(style.make_pair);
    else if (style.make_fix)
      plugin.creator.v2 = reinterpret_cast<lammpsplugin_factory2 *>(style.make_fix);
    else
      plugin.creator.v2 = reinterpret_cast<lammpsplugin_factory2 *>(style.make_compute);
    const bool registered = registered_from_here(style, handle);
    if (!registered) (*register_plugin)(&plugin, lmp);
    // The second: LAMMPS has it from a copy of this library in another file.
    if (registered || !has_eepa_style(lmp, style)) register_eepa_style(lmp, style);
  }
}
