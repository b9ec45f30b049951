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
include(ProcessorCount)

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
  list(APPEND EEPA_LAMMPS_ARGS -D PKG_EEPA=on)
endif()

# Debian's suite and version of its source package, and the tag in LAMMPS's own repository.
set(_eepa_debian_4Feb2025 trixie 20250204+dfsg.1-2)
set(_eepa_debian_4Jul2026 forky 20260704+dfsg-2)

set(_eepa_own_source_hint
  "Alternative: unpack any LAMMPS of 4 Feb 2025 to 4 Jul 2026 yourself and give its folder "
  "with -D LAMMPS_SOURCE_DIR=...")
string(CONCAT _eepa_own_source_hint ${_eepa_own_source_hint})

# Puts the source of EEPA_LAMMPS_RELEASE at `tree`, either complete or not at all.
function(_eepa_fetch_source tree)
  list(GET _eepa_debian_${EEPA_LAMMPS_RELEASE} 0 suite)
  list(GET _eepa_debian_${EEPA_LAMMPS_RELEASE} 1 version)
  # Removes what a killed fetch left behind. No other fetch is running: the caller holds the lock.
  get_filename_component(parent "${tree}" DIRECTORY)
  get_filename_component(name "${tree}" NAME)
  file(GLOB stale "${parent}/.fetch.${name}.*")
  if(stale)
    file(REMOVE_RECURSE ${stale})
  endif()

  set(failures "")
  find_program(EEPA_APT_GET apt-get)
  mark_as_advanced(EEPA_APT_GET)
  if(EEPA_APT_GET)
    message(STATUS "LAMMPS ${EEPA_LAMMPS_RELEASE}: fetching Debian's source package lammps ${version} "
      "(130 to 220 MB, once)")
    execute_process(
      COMMAND sh "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/fetch_lammps_debian.sh" "${tree}" ${suite} ${version}
      RESULT_VARIABLE status)
    if(status EQUAL 0)
      return()
    elseif(status EQUAL 2)
      string(APPEND failures "  - this machine's apt has no Debian archive configured\n")
    elseif(status EQUAL 3)
      string(APPEND failures
        "  - Debian's suite ${suite} has moved on and no longer has lammps ${version}\n")
    else()
      string(APPEND failures
        "  - apt could not fetch lammps ${version} from Debian's suite ${suite}; its words are above\n")
    endif()
  endif()

  # For systems without Debian's archive. It could not be tried where this was developed (no such
  # network there), and only HTTPS protects the download.
  set(url "https://github.com/lammps/lammps/archive/refs/tags/patch_${EEPA_LAMMPS_RELEASE}.tar.gz")
  set(work "${parent}/.fetch.${name}.github")
  message(STATUS "LAMMPS ${EEPA_LAMMPS_RELEASE}: downloading ${url}")
  file(DOWNLOAD "${url}" "${work}/lammps.tar.gz"
    STATUS status INACTIVITY_TIMEOUT 60 TLS_VERIFY ON SHOW_PROGRESS)
  list(GET status 0 code)
  list(GET status 1 words)
  if(code EQUAL 0)
    file(ARCHIVE_EXTRACT INPUT "${work}/lammps.tar.gz" DESTINATION "${work}/unpacked")
    file(GLOB found "${work}/unpacked/*/cmake/CMakeLists.txt")
    if(found)
      list(GET found 0 found)
      get_filename_component(found "${found}" DIRECTORY)
      get_filename_component(found "${found}" DIRECTORY)
      file(RENAME "${found}" "${tree}")
      file(REMOVE_RECURSE "${work}")
      return()
    endif()
    set(words "the archive holds no LAMMPS source tree")
  endif()
  file(REMOVE_RECURSE "${work}")
  string(APPEND failures "  - ${url}: ${words}\n")
  message(FATAL_ERROR "LAMMPS ${EEPA_LAMMPS_RELEASE} could not be obtained:\n${failures}"
    "${_eepa_own_source_hint}")
endfunction()

# A make or ninja that runs this configure would pass its job server and settings on.
set(_eepa_clean_env ${CMAKE_COMMAND} -E env --unset=MAKEFLAGS --unset=MAKELEVEL --unset=NINJA_STATUS)

# LAMMPS's packages that granular models use: clumps and bonds (RIGID, MOLECULE, BPM), fluid drag and servo
# control (EXTRA-FIX), rattlers and stress profiles (EXTRA-COMPUTE), contact times (MISC: pair tracker), output
# (EXTRA-DUMP).
set(_eepa_packages GRANULAR RIGID MOLECULE BPM MISC EXTRA-FIX EXTRA-COMPUTE EXTRA-DUMP OPENMP PLUGIN)

# A quarter of a granular run is spent in LAMMPS itself: neighbour lists, communication, integration. Products and
# sums are rounded separately; otherwise the results of a run would depend on whether the processor has a fused
# instruction. The user's own flags come last and win.
string(STRIP "${eepa_arch_flag} -ffp-contract=off $ENV{CXXFLAGS}" _eepa_flags)

# What `native` means on this machine: a cache may be shared by machines with different processors.
set(_eepa_machine "")
if(eepa_arch_flag STREQUAL "-march=native")
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -march=native -x c++ -dM -E /dev/null
    OUTPUT_VARIABLE _eepa_machine ERROR_QUIET)
endif()

# The configuration file of VTK, or nothing. In a project of its own, because finding VTK needs C and defines some
# hundred targets.
function(_eepa_find_vtk variable)
  set(folder "${CMAKE_BINARY_DIR}/CMakeFiles/find_vtk")
  file(REMOVE_RECURSE "${folder}")
  execute_process(
    COMMAND ${_eepa_clean_env} ${CMAKE_COMMAND} -S "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/find_vtk"
      -B "${folder}" -G "${CMAKE_GENERATOR}" -D "CMAKE_MAKE_PROGRAM=${CMAKE_MAKE_PROGRAM}"
      -D "CMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}" ${EEPA_LAMMPS_ARGS}
    OUTPUT_VARIABLE words ERROR_VARIABLE words)
  set(file "")
  if(words MATCHES "found VTK ([0-9.]+) by ([^\n]+)")
    set(file "${CMAKE_MATCH_2}")
    message(STATUS "Found VTK: ${file} (found version \"${CMAKE_MATCH_1}\")")
  endif()
  set(${variable} "${file}" PARENT_SCOPE)
endfunction()

# Arguments that add KOKKOS to LAMMPS, with the Kokkos in its tree or with an installed one.
function(_eepa_kokkos_arguments source version variable)
  if(NOT date EQUAL 20250204)
    message(FATAL_ERROR "EEPA_KOKKOS=on needs LAMMPS 4 Feb 2025, and ${source} has ${version}: "
      "the classes of KOKKOS differ between versions, and gran/eepa/kk was written for that one")
  endif()
  if(NOT IS_DIRECTORY "${source}/src/KOKKOS")
    message(FATAL_ERROR "EEPA_KOKKOS=on: ${source} has no src/KOKKOS")
  endif()
  if(EXISTS "${source}/lib/kokkos/CMakeLists.txt" AND NOT Kokkos_ROOT)
    set(${variable} -D PKG_KOKKOS=on -D Kokkos_ENABLE_SERIAL=on -D Kokkos_ENABLE_OPENMP=on PARENT_SCOPE)
    return()
  endif()
  # `separable_compilation`: only sources that include Kokkos are compiled with its compiler
  find_package(Kokkos 4.5.01 QUIET CONFIG COMPONENTS separable_compilation)
  if(NOT Kokkos_FOUND)
    message(FATAL_ERROR "EEPA_KOKKOS=on needs Kokkos 4.5.01 or newer, and finds none: "
      "${source} has no lib/kokkos (Debian's source package leaves it out). Install Kokkos and give its folder "
      "with -D Kokkos_ROOT=..., or give a LAMMPS source tree that has lib/kokkos with -D LAMMPS_SOURCE_DIR=...")
  endif()
  message(STATUS "Found Kokkos: ${Kokkos_DIR} (found version \"${Kokkos_VERSION}\", ${Kokkos_DEVICES})")
  set(${variable} -D PKG_KOKKOS=on -D EXTERNAL_KOKKOS=on -D "Kokkos_DIR=${Kokkos_DIR}" PARENT_SCOPE)
endfunction()

# Configures and builds LAMMPS's library in `build`.
function(_eepa_build_lammps source build)
  file(MAKE_DIRECTORY "${build}")
  set(png OFF)
  if(PNG_FOUND)
    set(png ON)
  endif()
  set(graphics "")
  if(IS_DIRECTORY "${source}/src/GRAPHICS")
    # `dump image` moved into a package of its own after 4 Feb 2025.
    set(graphics -D PKG_GRAPHICS=on)
  endif()
  set(packages ${_eepa_packages})
  list(TRANSFORM packages REPLACE "(.+)" "-DPKG_\\1=on")
  if(_eepa_vtk)
    list(APPEND packages -D PKG_VTK=on -D "VTK_DIR=${CMAKE_CURRENT_FUNCTION_LIST_DIR}/find_vtk"
      -D "EEPA_VTK_CONFIG=${_eepa_vtk}")
  endif()
  set(launcher "")
  if(CMAKE_CXX_COMPILER_LAUNCHER)
    set(launcher -D "CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}")
  endif()
  execute_process(
    COMMAND ${_eepa_clean_env} ${CMAKE_COMMAND} -S "${source}/cmake" -B "${build}" -G "${CMAKE_GENERATOR}"
      -D "CMAKE_MAKE_PROGRAM=${CMAKE_MAKE_PROGRAM}"
      -D "CMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}" ${launcher}
      -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_STANDARD=17 -D CMAKE_EXPORT_COMPILE_COMMANDS=on
      -D "CMAKE_CXX_FLAGS=${_eepa_flags}"
      -D BUILD_SHARED_LIBS=on -D BUILD_MPI=on -D BUILD_OMP=on
      ${packages} ${graphics} ${kokkos}
      -D WITH_PNG=${png} -D WITH_JPEG=off -D WITH_GZIP=off -D WITH_FFMPEG=off -D WITH_CURL=off
      ${EEPA_LAMMPS_ARGS}
    OUTPUT_FILE "${build}/eepa_configure.log" ERROR_FILE "${build}/eepa_configure.log"
    RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    file(READ "${build}/eepa_configure.log" words)
    message(FATAL_ERROR "LAMMPS in ${source} could not be configured "
      "(this is ${build}/eepa_configure.log):\n${words}")
  endif()

  set(jobs "$ENV{CMAKE_BUILD_PARALLEL_LEVEL}")
  if(NOT jobs MATCHES "^[1-9][0-9]*$")
    ProcessorCount(jobs)
    if(jobs LESS 1)
      set(jobs 1)
    endif()
  endif()
  execute_process(
    COMMAND ${_eepa_clean_env} ${CMAKE_COMMAND} --build "${build}" --parallel ${jobs}
    COMMAND sh "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/build_progress.sh" "${build}/eepa_build.log"
    RESULTS_VARIABLE statuses)
  foreach(status IN LISTS statuses)
    if(NOT status EQUAL 0)
      execute_process(COMMAND tail -n 40 "${build}/eepa_build.log" OUTPUT_VARIABLE words)
      message(FATAL_ERROR "LAMMPS could not be built; the end of ${build}/eepa_build.log:\n${words}")
    endif()
  endforeach()
endfunction()

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

# Version of the LAMMPS source tree: as a number such as 20250204, and in words.
function(_eepa_read_version source date_variable version_variable)
  file(STRINGS "${source}/src/version.h" version REGEX "LAMMPS_VERSION")
  if(NOT version MATCHES "\"([0-9]+) ([A-Z][a-z][a-z])[a-z]* ([0-9][0-9][0-9][0-9])\"")
    message(FATAL_ERROR "${source}/src/version.h names no version of the form \"4 Feb 2025\": ${version}")
  endif()
  set(day ${CMAKE_MATCH_1})
  set(year ${CMAKE_MATCH_3})
  set(version "${CMAKE_MATCH_1} ${CMAKE_MATCH_2} ${CMAKE_MATCH_3}")
  list(FIND _eepa_months ${CMAKE_MATCH_2} month)
  math(EXPR date "${year} * 10000 + (${month} + 1) * 100 + ${day}")
  if(date LESS 20250204)
    message(FATAL_ERROR "LAMMPS ${version} in ${source} is too old: 4 Feb 2025 is the oldest that will do")
  endif()
  set(${date_variable} ${date} PARENT_SCOPE)
  set(${version_variable} "${version}" PARENT_SCOPE)
endfunction()

# The command that compiled LAMMPS's main class, as a list; empty if compile_commands.json has none.
function(_eepa_read_command build variable)
  file(STRINGS "${build}/compile_commands.json" command REGEX "\"command\": .*/src/lammps\\.cpp\"")
  string(REGEX REPLACE "^.*\"command\": \"(.*)\",?$" "\\1" command "${command}")
  string(REGEX REPLACE "\\\\(.)" "\\1" command "${command}")
  separate_arguments(command UNIX_COMMAND "${command}")
  set(${variable} "${command}" PARENT_SCOPE)
endfunction()

# Defines LAMMPS::headers by that command. The exported target of LAMMPS does not have all definitions: LAMMPS
# keeps most of them private.
function(_eepa_define_headers command date)
  set(definitions "")
  set(includes "")
  set(previous "")
  foreach(argument IN LISTS command)
    if(previous STREQUAL "-isystem" OR previous STREQUAL "-I")
      list(APPEND includes "${argument}")
    elseif(argument MATCHES "^-I(.+)")
      list(APPEND includes "${CMAKE_MATCH_1}")
    elseif(argument MATCHES "^-D(.+)" AND NOT argument STREQUAL "-Dlammps_EXPORTS")
      list(APPEND definitions "${CMAKE_MATCH_1}")
    endif()
    set(previous "${argument}")
  endforeach()
  # A compiler passes over folders that are not there, and CMake does not.
  foreach(folder IN LISTS includes)
    if(NOT IS_DIRECTORY "${folder}")
      list(REMOVE_ITEM includes "${folder}")
    endif()
  endforeach()
  add_library(LAMMPS::headers INTERFACE IMPORTED GLOBAL)
  target_include_directories(LAMMPS::headers SYSTEM INTERFACE ${includes})
  target_compile_definitions(LAMMPS::headers INTERFACE ${definitions} EEPA_LAMMPS_DATE=${date})
endfunction()

# Takes LAMMPS_BUILD_DIR as it is: nothing in it is changed or built.
function(_eepa_take_lammps)
  set(given "LAMMPS_BUILD_DIR=${LAMMPS_BUILD_DIR}")
  get_filename_component(build "${LAMMPS_BUILD_DIR}" ABSOLUTE BASE_DIR "${CMAKE_SOURCE_DIR}")
  if(LAMMPS_SOURCE_DIR)
    message(FATAL_ERROR "${given} and LAMMPS_SOURCE_DIR=${LAMMPS_SOURCE_DIR} are both given: the folder of a "
      "build knows its source, so give one of them")
  elseif(NOT IS_DIRECTORY "${build}")
    message(FATAL_ERROR "${given}: there is no such folder")
  elseif(NOT EXISTS "${build}/compile_commands.json")
    if(EXISTS "${build}/CMakeCache.txt")
      message(FATAL_ERROR "${given} has no compile_commands.json, which says how LAMMPS was compiled. This "
        "writes it, and compiles nothing anew:\n  cmake -D CMAKE_EXPORT_COMPILE_COMMANDS=on ${build}")
    endif()
    message(FATAL_ERROR "${given} is no folder in which LAMMPS was built with CMake: it has neither "
      "compile_commands.json nor CMakeCache.txt")
  endif()
  _eepa_read_command("${build}" command)
  if(NOT command)
    message(FATAL_ERROR "${given} is no folder in which LAMMPS was built with CMake: its compile_commands.json "
      "says nothing about src/lammps.cpp")
  endif()
  list(GET command 0 compiler)
  if(compiler MATCHES "(^|/)(s?ccache|distcc)$")
    list(GET command 1 compiler)
  endif()
  list(GET command -1 file)
  get_filename_component(source "${file}" ABSOLUTE BASE_DIR "${build}")
  get_filename_component(source "${source}" DIRECTORY)
  get_filename_component(source "${source}" DIRECTORY)
  if(NOT EXISTS "${source}/src/version.h")
    message(FATAL_ERROR "${given} was built from ${source}, where there is no src/version.h any more: the "
      "plugin needs that source")
  endif()
  _eepa_read_version("${source}" date version)
  if(NOT "-DLMP_PLUGIN" IN_LIST command)
    message(FATAL_ERROR "${given}: this LAMMPS ${version} has no PLUGIN package and can load no plugin. Build it "
      "with\n  cmake -D PKG_PLUGIN=on ${build}")
  endif()
  get_filename_component(compiler "${compiler}" REALPATH)
  get_filename_component(own "${CMAKE_CXX_COMPILER}" REALPATH)
  if(NOT compiler STREQUAL own)
    message(WARNING "${given} was compiled by ${compiler}, and the plugin will be by ${own}. Give the former with "
      "-D CMAKE_CXX_COMPILER, unless you know that both agree on the layout of classes")
  endif()
  _eepa_define_headers("${command}" ${date})

  # OpenMP changes the layout of classes of LAMMPS (my_page.h), and its serial mpi.h is no MPI.
  set(openmp OFF)
  if(command MATCHES "(^|;)-[a-z]*openmp(;|=|$)")
    set(openmp ON)
    find_package(OpenMP REQUIRED COMPONENTS CXX)
    target_link_libraries(LAMMPS::headers INTERFACE OpenMP::OpenMP_CXX)
  endif()
  set(mpi ON)
  if(command MATCHES "/src/STUBS(;|$)")
    set(mpi OFF)
  else()
    find_package(MPI REQUIRED COMPONENTS CXX)
    target_link_libraries(LAMMPS::headers INTERFACE MPI::MPI_CXX)
  endif()

  set(machine "")
  if(EXISTS "${build}/CMakeCache.txt")
    file(STRINGS "${build}/CMakeCache.txt" machine REGEX "^LAMMPS_MACHINE:[^=]*=.+")
    string(REGEX REPLACE "^[^=]*=" "_" machine "${machine}")
  endif()
  set(library "${build}/liblammps${machine}${CMAKE_SHARED_LIBRARY_SUFFIX}")
  if(mpi AND EXISTS "${library}")
    add_library(LAMMPS::lammps SHARED IMPORTED GLOBAL)
    set_target_properties(LAMMPS::lammps PROPERTIES IMPORTED_LOCATION "${library}")
    target_link_libraries(LAMMPS::lammps INTERFACE LAMMPS::headers)
    message(STATUS "LAMMPS ${version}: ${library}")
  else()
    message(STATUS "LAMMPS ${version} in ${build} has no shared library with MPI: the plugin is built, and neither "
      "lmp nor the tests")
  endif()
  set(EEPA_LAMMPS_DATE ${date} PARENT_SCOPE)
  set(EEPA_LAMMPS_EXECUTABLE "${build}/lmp${machine}" PARENT_SCOPE)
  set(EEPA_LAMMPS_OPENMP ${openmp} PARENT_SCOPE)
  set(EEPA_LAMMPS_SOURCE "${source}" PARENT_SCOPE)
endfunction()

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
    _eepa_kokkos_arguments("${source}" "${version}" kokkos)
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
      message(STATUS "LAMMPS ${version}: building its shared library, once "
        "(about 5 minutes on two cores), in ${build}")
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

set(_eepa_months Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec)

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
