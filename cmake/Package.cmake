# `cpack` in the build folder makes a Debian package that needs nothing but Debian: lmp-eepa with its LAMMPS, the
# plugin, coarsen, documentation, examples. It is for the Debian release and, with EEPA_ARCH, the processors that
# it was compiled for: a package for others is made with -D EEPA_ARCH=baseline or dispatch.

include_guard(GLOBAL)

set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_NAME eepa)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_VENDOR "the eepa developers")
set(CPACK_PACKAGE_CONTACT "the eepa developers" CACHE STRING "Maintainer of the package: Name <address>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "elasto-plastic adhesive contact law for LAMMPS")
set(CPACK_PACKAGE_DESCRIPTION
"Contacts between spheres, and between spheres and walls of any shape, for the discrete element method: stiffnesses
of their own for loading, unloading and pull-off, friction, rolling resistance. The coefficients follow the particle
diameter, so that one input file has the same bulk response with coarse particles as with fine ones.
.
lmp-eepa is LAMMPS with these styles. coarsen says how coarse the particles of a simulation may be.")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_STRIP_FILES ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# Libraries by dpkg-shlibdeps. What coarsen and the scripts of the examples import is in scripts/setup.sh, too.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(TARGET LAMMPS::lammps)
  get_target_property(_eepa_library LAMMPS::lammps IMPORTED_LOCATION)
  get_filename_component(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${_eepa_library}" DIRECTORY)
endif()
set(CPACK_DEBIAN_PACKAGE_DEPENDS "openmpi-bin, python3, python3-numpy, python3-scipy, python3-matplotlib, \
python3-meshio, python3-pandas, python3-statsmodels, python3-yaml, python3-jinja2, python3-plotly, snakemake")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libeigen3-dev")

include(CPack)
