# Obtains LAMMPS: its source, and a stock shared library built from it.
#
#   LAMMPS_BUILD_DIR       a folder in which LAMMPS was built with CMake; used as it is, nothing is built
#   LAMMPS_SOURCE_DIR      otherwise: a LAMMPS source tree (the folder with cmake/ and src/); used as it is
#   EEPA_LAMMPS_RELEASE    otherwise: the release to obtain, 4Feb2025 (default) or 4Jul2026
#   EEPA_CACHE_DIR         where source and library are kept: $EEPA_CACHE,
#                          else $XDG_CACHE_HOME/eepa, else $HOME/.cache/eepa
#   EEPA_LAMMPS_ARGS       more -D arguments for LAMMPS's own configuration (a list)
#   EEPA_KOKKOS            LAMMPS with its package KOKKOS: see docs/kokkos.md
#   EEPA_ARCH              LAMMPS is compiled for the same processor as the package (dispatch: for any
#                          x86-64, as all of the package but its loops over contacts); with
#                          -D EEPA_LAMMPS_ARGS=-DCMAKE_CXX_FLAGS=... you choose LAMMPS's flags yourself
#
# `dump vtk` is in the library where CMake finds VTK 9, `dump image` of PNG files where it finds PNG.
#
# Defines
#   LAMMPS::headers        include folders (as system ones: -Werror is for this project's code) and
#                          the very definitions that LAMMPS was compiled with; MPI and OpenMP
#   LAMMPS::lammps         the same and the shared library; not for a LAMMPS_BUILD_DIR without one
#   EEPA_LAMMPS_OPENMP     whether LAMMPS was compiled with OpenMP
#   EEPA_LAMMPS_EXECUTABLE the stock lmp of the same build
#   EEPA_LAMMPS_SOURCE     the source tree in use
#   EEPA_LAMMPS_DATE       its version as a number, such as 20250204; also a definition of LAMMPS::headers
#
# LAMMPS is built while configuring, not as a step of the build: its compile definitions,
# which the package must share, are known only after LAMMPS has been configured, and a cached
# library must cost later builds nothing. Source and library are kept outside the build folder,
# so that they survive its deletion.

include_guard(GLOBAL)
include(BuildLammps)
include(FetchLammps)
include(ReadLammps)
include(TakeLammps)

if(DEFINED ENV{EEPA_CACHE} AND NOT "$ENV{EEPA_CACHE}" STREQUAL "")
  set(_eepa_cache "$ENV{EEPA_CACHE}")
elseif(DEFINED ENV{XDG_CACHE_HOME} AND NOT "$ENV{XDG_CACHE_HOME}" STREQUAL "")
  set(_eepa_cache "$ENV{XDG_CACHE_HOME}/eepa")
elseif(DEFINED ENV{HOME} AND NOT "$ENV{HOME}" STREQUAL "")
  set(_eepa_cache "$ENV{HOME}/.cache/eepa")
else()
  set(_eepa_cache "${CMAKE_BINARY_DIR}/cache")
endif()
set(LAMMPS_BUILD_DIR "" CACHE PATH "Folder in which a LAMMPS of yours was built; empty: build one")
set(LAMMPS_SOURCE_DIR "" CACHE PATH "LAMMPS source tree to use; empty: obtain one")
set(EEPA_CACHE_DIR "${_eepa_cache}" CACHE PATH "Keeps the LAMMPS source and library")
set(EEPA_LAMMPS_RELEASE "4Feb2025" CACHE STRING "LAMMPS release to obtain")
set_property(CACHE EEPA_LAMMPS_RELEASE PROPERTY STRINGS 4Feb2025 4Jul2026)
set(EEPA_LAMMPS_ARGS "" CACHE STRING "More -D arguments for LAMMPS's configuration")
if(EEPA_STYLES STREQUAL "in_lammps")
  # GRANSURF, which came after 4 Feb 2025: surfaces that touch by the sub-models
  list(APPEND EEPA_LAMMPS_ARGS -D PKG_EEPA=on -D PKG_GRANSURF=on)
endif()

# Locks `path` against other configurations until the calling function ends, in whatever way it ends.
# This is a macro, because a function would release the lock at its own end.
macro(_eepa_lock path)
  get_filename_component(parent "${path}" DIRECTORY)
  file(MAKE_DIRECTORY "${parent}")
  file(LOCK "${path}.lock" GUARD FUNCTION TIMEOUT 0 RESULT_VARIABLE locked)
  if(NOT locked EQUAL 0)
    message(STATUS "another configuration is making ${path}; waiting for it (up to an hour)")
    file(LOCK "${path}.lock" GUARD FUNCTION TIMEOUT 3600 RESULT_VARIABLE locked)
    if(NOT locked EQUAL 0)
      message(FATAL_ERROR "${path}.lock: ${locked}")
    endif()
  endif()
endmacro()

function(_eepa_obtain_lammps)
  if(EEPA_LAMMPS_RELEASE AND NOT DEFINED _eepa_debian_${EEPA_LAMMPS_RELEASE})
    message(FATAL_ERROR
      "EEPA_LAMMPS_RELEASE=${EEPA_LAMMPS_RELEASE}: known are 4Feb2025 and 4Jul2026. ${_eepa_own_source_hint}")
  endif()
  get_filename_component(cache "${EEPA_CACHE_DIR}" ABSOLUTE BASE_DIR "${CMAKE_BINARY_DIR}")

  if(LAMMPS_SOURCE_DIR)
    get_filename_component(source "${LAMMPS_SOURCE_DIR}" REALPATH BASE_DIR "${CMAKE_SOURCE_DIR}")
    if(NOT EXISTS "${source}/cmake/CMakeLists.txt" OR NOT EXISTS "${source}/src/version.h")
      message(FATAL_ERROR "LAMMPS_SOURCE_DIR=${LAMMPS_SOURCE_DIR} is no LAMMPS source tree: "
        "it has no cmake/CMakeLists.txt or no src/version.h")
    endif()
    set(name user)
  else()
    set(source "${cache}/source/lammps-${EEPA_LAMMPS_RELEASE}")
    # A complete source needs no lock, so that a cache may be shared and read-only.
    if(NOT EXISTS "${source}/src/version.h")
      _eepa_lock("${source}")
      if(NOT EXISTS "${source}/src/version.h")
        _eepa_fetch_source("${source}")
      endif()
    endif()
    set(name ${EEPA_LAMMPS_RELEASE})
  endif()

  _eepa_read_version("${source}" date version)

  set(kokkos "")
  if(EEPA_KOKKOS)
    _eepa_kokkos_arguments("${source}" ${date} "${version}" kokkos)
  endif()

  # The key has everything that could make a library differ, so that configurations never share one by mistake.
  string(SHA256 key "${source}|${version}|${CMAKE_CXX_COMPILER}|${CMAKE_CXX_COMPILER_ID}|\
${CMAKE_CXX_COMPILER_VERSION}|${CMAKE_GENERATOR}|${MPI_CXX_LIBRARIES}|${PNG_LIBRARIES}|${_eepa_vtk}|\
${EEPA_LAMMPS_ARGS}|${_eepa_flags}|${_eepa_machine}|$ENV{LDFLAGS}|recipe 2${kokkos}")
  string(SUBSTRING ${key} 0 12 key)
  set(build "${cache}/build/lammps-${name}-${key}")
  set(library "${build}/liblammps${CMAKE_SHARED_LIBRARY_SUFFIX}")
  set(stamp "${build}/eepa_complete")

  # A tree of the user's may be under development: let its own build system say what is out of date.
  if(LAMMPS_SOURCE_DIR OR NOT EXISTS "${stamp}")
    _eepa_lock("${build}")
    if(NOT EXISTS "${stamp}")
      set(duration "about 5 minutes")
      if(EEPA_KOKKOS)
        set(duration "up to an hour with KOKKOS")
      endif()
      message(STATUS "LAMMPS ${version}: building its shared library, once (${duration} on two cores), in ${build}")
    endif()
    if(LAMMPS_SOURCE_DIR OR NOT EXISTS "${stamp}")
      _eepa_build_lammps("${source}" "${build}")
      file(WRITE "${stamp}" "LAMMPS ${version} from ${source}\n")
    endif()
  endif()
  message(STATUS "LAMMPS ${version}: ${library}")

  _eepa_read_command("${build}" command)
  if(NOT command)
    message(FATAL_ERROR "${build}/compile_commands.json says nothing about lammps.cpp; "
      "delete ${build} to build it again")
  endif()
  _eepa_define_headers("${command}" ${date})
  target_link_libraries(LAMMPS::headers INTERFACE MPI::MPI_CXX OpenMP::OpenMP_CXX)
  add_library(LAMMPS::lammps SHARED IMPORTED GLOBAL)
  set_target_properties(LAMMPS::lammps PROPERTIES IMPORTED_LOCATION "${library}")
  target_link_libraries(LAMMPS::lammps INTERFACE LAMMPS::headers)

  set(EEPA_LAMMPS_DATE ${date} PARENT_SCOPE)
  set(EEPA_LAMMPS_EXECUTABLE "${build}/lmp" PARENT_SCOPE)
  set(EEPA_LAMMPS_OPENMP ON PARENT_SCOPE)
  set(EEPA_LAMMPS_SOURCE "${source}" PARENT_SCOPE)
endfunction()

# Without Open MPI's old C++ interface, whose symbols every program that loads the plugin would need.
set(MPI_CXX_SKIP_MPICXX TRUE)
if(LAMMPS_BUILD_DIR)
  _eepa_take_lammps()
else()
  find_package(MPI REQUIRED COMPONENTS CXX)
  find_package(OpenMP REQUIRED COMPONENTS CXX)
  find_package(PNG QUIET)
  _eepa_find_vtk(_eepa_vtk)
  _eepa_obtain_lammps()
endif()
