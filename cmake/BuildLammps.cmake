# How LAMMPS is compiled: its packages, flags, VTK and Kokkos.

include_guard(GLOBAL)

include(ProcessorCount)

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
function(_eepa_kokkos_arguments source date version variable)
  _eepa_require_kokkos_version("${source}" ${date} "${version}")
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
