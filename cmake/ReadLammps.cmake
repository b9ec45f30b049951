# What a LAMMPS says of itself: the version of its source, and the command that compiled it.

include_guard(GLOBAL)

set(_eepa_months Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec)

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
