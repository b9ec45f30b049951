# Where the source of a LAMMPS release comes from: Debian's archive, else LAMMPS's own repository.

include_guard(GLOBAL)

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
