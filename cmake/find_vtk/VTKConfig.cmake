# What LAMMPS finds as VTK. It asks for all of VTK, on Debian also for what needs Qt and Java to be found, and links
# a few modules: this hands it those of the VTK whose configuration file is EEPA_VTK_CONFIG.
include("${CMAKE_CURRENT_LIST_DIR}/modules.cmake")
set(VTK_FIND_COMPONENTS ${vtk_modules})
foreach(module IN LISTS vtk_modules)
  set(VTK_FIND_REQUIRED_${module} TRUE)
endforeach()
include("${EEPA_VTK_CONFIG}")
