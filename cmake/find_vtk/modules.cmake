# Those that LAMMPS's VTK package links.
set(vtk_modules CommonCore IOCore CommonDataModel IOXML IOLegacy IOParallelXML)
