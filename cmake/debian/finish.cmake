# What Debian's policy asks of the files of a package, and other installations do not need. cpack runs this between
# installing into folders of its own and packing these.

cmake_minimum_required(VERSION 3.20)

# _compress(FILE): FILE.gz in its place, which has the same bytes each time.
function(_compress file)
  execute_process(COMMAND gzip -9 -n -f "${file}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Of the changelog of the package: which version it is, and when that was made.
file(STRINGS "${CPACK_EEPA_CHANGELOG}" versions REGEX "^## \\[[0-9]")
list(GET versions 0 newest)
string(REGEX MATCH "[0-9]+-[0-9]+-[0-9]+$" day "${newest}")
execute_process(COMMAND date -u -R -d "${day}" OUTPUT_VARIABLE day OUTPUT_STRIP_TRAILING_WHITESPACE)
set(version "${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")

file(GLOB roots "${CPACK_TEMPORARY_DIRECTORY}/*")
foreach(root IN LISTS roots)
  get_filename_component(name "${root}" NAME)
  string(REPLACE "_" "-" name "${name}")
  set(prefix "${root}${CPACK_PACKAGING_INSTALL_PREFIX}")
  set(doc "${prefix}/${CPACK_EEPA_DATADIR}/doc/${name}")

  file(WRITE "${doc}/changelog.Debian" "eepa (${version}) unstable; urgency=medium

  * Version ${CPACK_PACKAGE_VERSION}: see changelog.gz of the package eepa.

 -- ${CPACK_PACKAGE_CONTACT}  ${day}
")
  _compress("${doc}/changelog.Debian")
  if(EXISTS "${doc}/CHANGELOG.md")
    file(RENAME "${doc}/CHANGELOG.md" "${doc}/changelog")
    _compress("${doc}/changelog")
  endif()

  file(GLOB pages "${prefix}/${CPACK_EEPA_DATADIR}/man/man1/*.1")
  foreach(page IN LISTS pages)
    _compress("${page}")
  endforeach()

  # cpack strips symbols, but not of LAMMPS's library, which is no target.
  file(GLOB binaries "${prefix}/bin/lmp-eepa" "${prefix}/${CPACK_EEPA_LIBDIR}/*/*.so*"
    "${prefix}/${CPACK_EEPA_LIBDIR}/lammps/plugins/*.so")
  if(binaries)
    execute_process(COMMAND "${CPACK_EEPA_STRIP}" --strip-unneeded -R .comment -R .note ${binaries}
      COMMAND_ERROR_IS_FATAL ANY)
  endif()

  # Results of examples are compressed, and would have the time at which that was done.
  file(GLOB_RECURSE compressed "${prefix}/${CPACK_EEPA_DATADIR}/eepa/*.gz")
  foreach(file IN LISTS compressed)
    execute_process(COMMAND gzip -d "${file}" COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX REPLACE "\\.gz$" "" file "${file}")
    _compress("${file}")
  endforeach()

  # The Python that has what apt installs is the system's, which need not be the first one on PATH.
  file(GLOB_RECURSE scripts "${prefix}/${CPACK_EEPA_DATADIR}/eepa/*.py")
  if(scripts)
    execute_process(COMMAND sed -i "1s|^#!/usr/bin/env python3\$|#!/usr/bin/python3|" ${scripts}
      COMMAND_ERROR_IS_FATAL ANY)
  endif()

  # Debian has the text of the licence once.
  if(EXISTS "${doc}/LICENSE")
    file(REMOVE "${doc}/LICENSE")
    file(CREATE_LINK ../../common-licenses/GPL-2 "${doc}/LICENSE" SYMBOLIC)
  endif()

  # Whatever the source tree's own are.
  execute_process(COMMAND chmod -R u=rwX,go=rX "${root}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
