# `cpack` in the build folder makes two Debian packages that need nothing but Debian:
#
#   eepa          lmp-eepa with its LAMMPS, the plugin, coarsen, examples, documentation, headers
#   eepa-coarsen  no files: the Python libraries and Snakemake that coarsen needs, most of what apt would fetch
#
# They are for the Debian release and, with EEPA_ARCH, the processors that they were compiled for.
# scripts/package.sh makes them for every x86-64, with the site.

include_guard(GLOBAL)

set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_NAME eepa)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_VENDOR "the eepa developers")
# Debian's own variables for who makes a package.
set(_eepa_maintainer "the eepa developers")
if(DEFINED ENV{DEBEMAIL})
  set(_eepa_maintainer "the eepa developers <$ENV{DEBEMAIL}>")
  if(DEFINED ENV{DEBFULLNAME})
    set(_eepa_maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
  endif()
endif()
if(NOT CPACK_PACKAGE_CONTACT)    # Name <address>
  set(CPACK_PACKAGE_CONTACT "${_eepa_maintainer}")
endif()
# A synopsis of its own for each package, in the first line of its description.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# Each Debian release has another Open MPI, so the version names the release: 1.0.0-1~deb12.
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
if(EXISTS /etc/os-release)
  file(STRINGS /etc/os-release _eepa_lines REGEX "^(ID|VERSION_ID|VERSION_CODENAME)=")
  foreach(_eepa_line IN LISTS _eepa_lines)
    string(REGEX MATCH "^([A-Z_]+)=\"?([^\"]*)" _eepa_line "${_eepa_line}")
    set(_eepa_os_${CMAKE_MATCH_1} "${CMAKE_MATCH_2}")
  endforeach()
  string(REPLACE debian deb _eepa_os_ID "${_eepa_os_ID}")
  if(NOT _eepa_os_VERSION_ID)    # one that is not released yet
    set(_eepa_os_VERSION_ID "${_eepa_os_VERSION_CODENAME}")
  endif()
  string(APPEND CPACK_DEBIAN_PACKAGE_RELEASE "~${_eepa_os_ID}${_eepa_os_VERSION_ID}")
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL lammps plugin coarsen examples doc kernel debian debian_coarsen)
foreach(_eepa_component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER "${_eepa_component}" _eepa_component)
  set(CPACK_COMPONENT_${_eepa_component}_GROUP eepa)
endforeach()
set(CPACK_COMPONENT_DEBIAN_COARSEN_GROUP eepa_coarsen)
install(FILES cmake/debian/lintian-overrides DESTINATION "${CMAKE_INSTALL_DATADIR}/lintian/overrides" RENAME eepa
  COMPONENT debian EXCLUDE_FROM_ALL)
install(FILES cmake/debian/copyright DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/eepa-coarsen"
  COMPONENT debian_coarsen EXCLUDE_FROM_ALL)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

set(CPACK_DEBIAN_EEPA_PACKAGE_NAME eepa)
set(CPACK_DEBIAN_EEPA_DESCRIPTION "elasto-plastic adhesive contact law for LAMMPS
Contacts between spheres, and between spheres and walls of any shape, for the
discrete element method: stiffnesses of their own for loading, unloading and
pull-off, friction, rolling resistance. The coefficients follow the particle
diameter, so that one input file has the same bulk response with coarse
particles as with fine ones.

lmp-eepa is LAMMPS with these styles. coarsen says how coarse the particles of
a simulation may be; the package eepa-coarsen has what it needs.")
# Libraries by dpkg-shlibdeps. The scripts of examples write meshes with NumPy.
set(CPACK_DEBIAN_EEPA_PACKAGE_SHLIBDEPS ON)
if(TARGET LAMMPS::lammps)
  get_target_property(_eepa_library LAMMPS::lammps IMPORTED_LOCATION)
  get_filename_component(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${_eepa_library}" DIRECTORY)
endif()
set(CPACK_DEBIAN_EEPA_PACKAGE_DEPENDS "openmpi-bin, python3, python3-numpy")
# Matplotlib is not recommended, for apt would fetch five times as much by default.
set(CPACK_DEBIAN_EEPA_PACKAGE_SUGGESTS "eepa-coarsen, libeigen3-dev, python3-matplotlib, python3-meshio")
set(CPACK_DEBIAN_EEPA_PACKAGE_CONTROL_EXTRA
  "${PROJECT_SOURCE_DIR}/cmake/debian/postinst" "${PROJECT_SOURCE_DIR}/cmake/debian/prerm")
set(CPACK_DEBIAN_EEPA_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_EEPA_COARSEN_PACKAGE_NAME eepa-coarsen)
set(CPACK_DEBIAN_EEPA_COARSEN_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_EEPA_COARSEN_DESCRIPTION "what coarsen of the package eepa needs (metapackage)
coarsen says how coarse the particles of a simulation may be: it predicts the
error of a particle diameter, compares diameters in runs, calibrates
coefficients and reports.

This is a metapackage: it has no files, and depends on the Python libraries and
on Snakemake, which are more than all else that the package eepa needs.")
# What coarsen imports is in scripts/setup.sh, too.
set(CPACK_DEBIAN_EEPA_COARSEN_PACKAGE_DEPENDS "eepa (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), \
python3, python3-numpy, python3-scipy, python3-pandas, python3-statsmodels, python3-yaml, python3-jinja2, \
python3-plotly, python3-matplotlib, snakemake")

set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/cmake/debian/finish.cmake")
set(CPACK_EEPA_CHANGELOG "${PROJECT_SOURCE_DIR}/CHANGELOG.md")
set(CPACK_EEPA_STRIP "${CMAKE_STRIP}")
set(CPACK_EEPA_LIBDIR "${CMAKE_INSTALL_LIBDIR}")
set(CPACK_EEPA_DATADIR "${CMAKE_INSTALL_DATADIR}")

include(CPack)
