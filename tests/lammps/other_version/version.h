// SPDX-License-Identifier: GPL-2.0-only
// First on the include path of a plugin that must be refused: see tests/CMakeLists.txt.
#define LAMMPS_VERSION "1 Jan 2020"
