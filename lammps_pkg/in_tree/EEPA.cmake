# Package EEPA. scripts/install_in_lammps.sh of the project eepa wrote this file and removes it.
#
# LAMMPS itself takes the styles and sub-models in src/EEPA and, with PKG_OPENMP and PKG_KOKKOS, those in src/OPENMP and
# src/KOKKOS. What they stand on is in lib/eepa.

pkg_depends(EEPA GRANULAR) # for sub-models of pair_style granular
if(CMAKE_CXX_STANDARD LESS 17)
  message(FATAL_ERROR "PKG_EEPA needs C++17: CMAKE_CXX_STANDARD=${CMAKE_CXX_STANDARD} must be 17 or more")
endif()
find_package(Eigen3 3.3 NO_MODULE)
if(NOT Eigen3_FOUND)
  message(FATAL_ERROR "PKG_EEPA needs Eigen 3.3 or newer: install it (Debian: libeigen3-dev) or give "
    "its folder with -D Eigen3_DIR=...")
endif()
target_link_libraries(lammps PRIVATE Eigen3::Eigen)
target_include_directories(lammps PRIVATE ${LAMMPS_LIB_SOURCE_DIR}/eepa)
file(GLOB EEPA_LIB_SOURCES CONFIGURE_DEPENDS ${LAMMPS_LIB_SOURCE_DIR}/eepa/eepa_*/[^.]*.cpp)
target_sources(lammps PRIVATE ${EEPA_LIB_SOURCES})

# With KOKKOS. The styles themselves are added by LAMMPS.
set(EEPA_KOKKOS_SOURCES)
if(PKG_KOKKOS AND EXISTS ${LAMMPS_SOURCE_DIR}/KOKKOS/pair_gran_eepa_kokkos.h)
  file(GLOB EEPA_KOKKOS_SOURCES CONFIGURE_DEPENDS ${LAMMPS_LIB_SOURCE_DIR}/eepa/kokkos/[^.]*.cpp)
  target_sources(lammps PRIVATE ${EEPA_KOKKOS_SOURCES})
  target_include_directories(lammps PRIVATE ${LAMMPS_LIB_SOURCE_DIR}/eepa/kokkos)
  list(APPEND EEPA_KOKKOS_SOURCES ${LAMMPS_SOURCE_DIR}/KOKKOS/pair_gran_eepa_kokkos.cpp
    ${LAMMPS_SOURCE_DIR}/KOKKOS/fix_wall_gran_eepa_kokkos.cpp)
elseif(PKG_KOKKOS)
  message(WARNING "PKG_EEPA has no gran/eepa/kk for this version of LAMMPS: it was written for 4 Feb 2025")
endif()

# As in the project's own build: a fused a b + c d would not have the same bits on all machines, nor
# exactly the opposite sign when i and j change places. The options of a source follow those of the target.
file(GLOB EEPA_ALL_SOURCES CONFIGURE_DEPENDS ${LAMMPS_SOURCE_DIR}/EEPA/[^.]*.cpp
  ${LAMMPS_SOURCE_DIR}/OPENMP/*_eepa_omp.cpp)
list(APPEND EEPA_ALL_SOURCES ${EEPA_LIB_SOURCES})
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang|IntelLLVM")
  set_property(SOURCE ${EEPA_ALL_SOURCES} ${EEPA_KOKKOS_SOURCES} APPEND PROPERTY COMPILE_OPTIONS
    -fno-math-errno -fno-trapping-math -ffp-contract=off)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set_property(SOURCE ${EEPA_ALL_SOURCES} APPEND PROPERTY COMPILE_OPTIONS -fno-semantic-interposition)
  set_property(SOURCE ${LAMMPS_SOURCE_DIR}/EEPA/pair_gran_eepa_force.cpp
    ${LAMMPS_SOURCE_DIR}/EEPA/contact_engine.cpp APPEND PROPERTY COMPILE_OPTIONS
    -fschedule-insns -fsched-pressure)
endif()

# nvcc would take their lanes from the processor's styles, and fuse sums and products on the GPU.
if(PKG_KOKKOS AND EXTERNAL_KOKKOS)
  find_package(Kokkos QUIET CONFIG COMPONENTS separable_compilation) # LAMMPS itself looks for it later
endif()
if(PKG_KOKKOS AND (Kokkos_ENABLE_CUDA OR "CUDA" IN_LIST Kokkos_DEVICES OR CMAKE_CXX_COMPILER MATCHES "nvcc_wrapper"))
  set_property(SOURCE ${EEPA_ALL_SOURCES} APPEND PROPERTY COMPILE_OPTIONS --host-only)
  set_property(SOURCE ${EEPA_KOKKOS_SOURCES} APPEND PROPERTY COMPILE_OPTIONS -fmad=false)
endif()
