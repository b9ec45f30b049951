# What `cmake --install` puts where. Nothing installed knows its absolute place, so that a prefix may be moved.
#
# Components, for cmake --install build --component NAME:
#   lammps     bin/lmp-eepa and, in a folder of its own, the liblammps that this project built
#   plugin     lib/lammps/plugins/eepaplugin.so, in the folder in which LAMMPS's own installation has plugins;
#              LAMMPS itself looks where LAMMPS_PLUGIN_PATH points
#   coarsen    bin/coarsen; below share/eepa what it needs, in the folders that it has in the source
#   examples   below share/eepa/examples
#   doc        share/doc/eepa: pages; html/, the site, where docs/build.sh has made it
#   kernel     the kernel's headers, and what find_package(eepa) reads; it gives eepa::kernel
#
# The target eepa_installed builds what is installed, and no tests.

include_guard(GLOBAL)
add_custom_target(eepa_installed)
include(CMakePackageConfigHelpers)

set(_eepa_data "${CMAKE_INSTALL_DATADIR}/eepa")
set(_eepa_doc "${CMAKE_INSTALL_DATADIR}/doc/eepa")
set(_eepa_plugins "${CMAKE_INSTALL_LIBDIR}/lammps/plugins")
set(_eepa_private "${CMAKE_INSTALL_LIBDIR}/eepa")

# _eepa_from_bin(VARIABLE FOLDER): FOLDER as seen from the programs. Absolute folders, which GNUInstallDirs
# allows, can not be seen from there.
function(_eepa_from_bin variable folder)
  foreach(path IN ITEMS "${CMAKE_INSTALL_BINDIR}" "${folder}")
    if(IS_ABSOLUTE "${path}")
      message(FATAL_ERROR "${path} is not allowed as a folder of the installation: CMAKE_INSTALL_BINDIR, "
        "CMAKE_INSTALL_LIBDIR and CMAKE_INSTALL_DATADIR must be relative to CMAKE_INSTALL_PREFIX")
    endif()
  endforeach()
  file(RELATIVE_PATH relative "/${CMAKE_INSTALL_BINDIR}" "/${folder}")
  set(${variable} "${relative}" PARENT_SCOPE)
endfunction()

if(TARGET eepaplugin)
  add_dependencies(eepa_installed eepaplugin)
  install(TARGETS eepaplugin LIBRARY DESTINATION "${_eepa_plugins}" COMPONENT plugin)
endif()

if(TARGET lmp)
  _eepa_from_bin(_eepa_relative "${_eepa_plugins}")
  target_compile_definitions(lmp PRIVATE "EEPA_PLUGIN_FOLDER=\"${_eepa_relative}\"")
  _eepa_from_bin(_eepa_relative "${_eepa_private}")
  set(_eepa_rpath "$ORIGIN/${_eepa_relative}")
  # The folder of MPI, where the loader does not look by itself.
  foreach(_eepa_library IN LISTS MPI_CXX_LIBRARIES)
    get_filename_component(_eepa_library "${_eepa_library}" REALPATH)
    get_filename_component(_eepa_folder "${_eepa_library}" DIRECTORY)
    if(NOT _eepa_folder IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES)
      list(APPEND _eepa_rpath "${_eepa_folder}")
    endif()
  endforeach()
  set_target_properties(lmp PROPERTIES INSTALL_RPATH "${_eepa_rpath}")
endif()

# A LAMMPS of the user's stays where it is, and its lmp loads the plugin.
if(TARGET lmp AND NOT LAMMPS_BUILD_DIR)
  add_dependencies(eepa_installed lmp)
  install(TARGETS lmp RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT lammps)
  install(FILES docs/man/lmp-eepa.1 DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT lammps)

  get_target_property(_eepa_library LAMMPS::lammps IMPORTED_LOCATION)
  get_filename_component(_eepa_library "${_eepa_library}" REALPATH)
  install(FILES "${_eepa_library}" DESTINATION "${_eepa_private}" COMPONENT lammps)
  # In a build folder CMake leaves an empty entry in the list of folders in which the loader looks, which means
  # the present folder. lmp-eepa itself has loaded all that liblammps needs.
  get_filename_component(_eepa_library "${_eepa_library}" NAME)
  install(CODE "file(RPATH_REMOVE
    FILE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${_eepa_private}/${_eepa_library}\")" COMPONENT lammps)
endif()

# coarsen finds what it needs in the folders of the source, and so does each example.
_eepa_from_bin(_eepa_relative "${_eepa_data}/coarsen")
file(READ "${PROJECT_SOURCE_DIR}/coarsen/bin/coarsen" _eepa_launcher)
string(REPLACE "installed=../share/eepa/coarsen    # set at installation\n" "installed=${_eepa_relative}\n"
  _eepa_launcher "${_eepa_launcher}")
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/install/coarsen" CONTENT "${_eepa_launcher}" @ONLY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS coarsen/bin/coarsen)
install(PROGRAMS "${PROJECT_BINARY_DIR}/install/coarsen" DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT coarsen)
install(DIRECTORY coarsen/coarsen DESTINATION "${_eepa_data}/coarsen" COMPONENT coarsen
  PATTERN "__pycache__" EXCLUDE)
install(FILES coarsen/README.md DESTINATION "${_eepa_data}/coarsen" COMPONENT coarsen)
install(FILES VERSION DESTINATION "${_eepa_data}" COMPONENT coarsen)
install(FILES scripts/mpi.env DESTINATION "${_eepa_data}/scripts" COMPONENT coarsen)
install(PROGRAMS scripts/wear_to_vtk.py DESTINATION "${_eepa_data}/scripts" COMPONENT coarsen)

install(DIRECTORY examples DESTINATION "${_eepa_data}" COMPONENT examples USE_SOURCE_PERMISSIONS
  PATTERN "__pycache__" EXCLUDE)

# Pages have the folders that they have in the source, and links to examples lead to where these are installed, so that
# the links between pages hold. Links from the pages of examples lead back.
install(FILES README.md CHANGELOG.md ARCHITECTURE.md CONTRIBUTING.md CITATION.cff LICENSE
  DESTINATION "${_eepa_doc}" COMPONENT doc)
file(GLOB_RECURSE _eepa_pages CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}"
  docs/*.md docs/*.rst tests/*.md walls/*.md lammps_pkg/*.md benchmarks/*.md benchmarks/*.png benchmarks/*.txt
  lammps_pkg/doc/*.rst lammps_pkg/doc/*.png lammps_pkg/doc/*.svg)
list(FILTER _eepa_pages EXCLUDE REGEX "/CMakeLists\\.txt$")
foreach(_eepa_page IN LISTS _eepa_pages)
  get_filename_component(_eepa_folder "${_eepa_page}" DIRECTORY)
  install(FILES "${_eepa_page}" DESTINATION "${_eepa_doc}/${_eepa_folder}" COMPONENT doc)
endforeach()
# _eepa_link(LINK FOLDER): in an installation LINK leads to FOLDER, both as seen from its prefix.
function(_eepa_link link folder)
  get_filename_component(parent "${link}" DIRECTORY)
  get_filename_component(name "${link}" NAME)
  file(RELATIVE_PATH relative "/${parent}" "/${folder}")
  set(made "${PROJECT_BINARY_DIR}/install/links/${link}")
  file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/install/links/${parent}")
  file(CREATE_LINK "${relative}" "${made}" SYMBOLIC)
  install(FILES "${made}" DESTINATION "${parent}" COMPONENT doc)
endfunction()
foreach(_eepa_name IN ITEMS examples coarsen)
  _eepa_link("${_eepa_doc}/${_eepa_name}" "${_eepa_data}/${_eepa_name}")
endforeach()
foreach(_eepa_name IN ITEMS docs lammps_pkg)
  _eepa_link("${_eepa_data}/${_eepa_name}" "${_eepa_doc}/${_eepa_name}")
endforeach()
# What Debian expects beside documentation.
install(FILES cmake/debian/copyright DESTINATION "${_eepa_doc}" COMPONENT doc)
# The site, where docs/build.sh has made it in this build folder.
install(DIRECTORY "${PROJECT_BINARY_DIR}/site/" DESTINATION "${_eepa_doc}/html" COMPONENT doc OPTIONAL
  PATTERN ".buildinfo" EXCLUDE)
install(FILES docs/man/coarsen.1 DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT coarsen)

set_target_properties(eepa_kernel PROPERTIES EXPORT_NAME kernel)
set(_eepa_config "${CMAKE_INSTALL_DATADIR}/cmake/eepa")
install(DIRECTORY kernel/eepa DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT kernel)
install(TARGETS eepa_kernel EXPORT eepaTargets COMPONENT kernel)
install(EXPORT eepaTargets NAMESPACE eepa:: DESTINATION "${_eepa_config}" COMPONENT kernel)
configure_package_config_file(cmake/eepaConfig.cmake.in "${PROJECT_BINARY_DIR}/install/eepaConfig.cmake"
  INSTALL_DESTINATION "${_eepa_config}" NO_SET_AND_CHECK_MACRO)
# Headers alone: any pointer size will do.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/install/eepaConfigVersion.cmake"
  COMPATIBILITY SameMajorVersion ARCH_INDEPENDENT)
install(FILES "${PROJECT_BINARY_DIR}/install/eepaConfig.cmake"
  "${PROJECT_BINARY_DIR}/install/eepaConfigVersion.cmake" DESTINATION "${_eepa_config}" COMPONENT kernel)
