# For EEPA_ARCH=dispatch: the engines of contact_engine.cpp once more, for x86-64-v3, beside those of eepa_styles.
#
# Inline functions and templates, those of Eigen and the standard library too, are weak symbols: of two
# objects that have one, the linker keeps either, for all callers. One with AVX2 must not get to code that every
# processor runs. So all symbols of this object but its entry become local, and its COMDAT groups, of
# which the linker would still keep one by name, are dissolved. Its code has a section of its own,
# outside of which a test finds no AVX.

find_program(EEPA_GNU_LD NAMES ld.bfd ld REQUIRED)
find_program(EEPA_GNU_OBJCOPY NAMES objcopy REQUIRED)
mark_as_advanced(EEPA_GNU_LD EEPA_GNU_OBJCOPY)

add_library(eepa_x86_64_v3_objects OBJECT contact_engine.cpp)
set_target_properties(eepa_x86_64_v3_objects PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_compile_options(eepa_x86_64_v3_objects PRIVATE $<TARGET_PROPERTY:eepa_styles,COMPILE_OPTIONS>)
target_link_libraries(eepa_x86_64_v3_objects PRIVATE eepa::kernel LAMMPS::headers eepa::options)
target_compile_options(eepa_x86_64_v3_objects PRIVATE -march=x86-64-v3)
target_compile_definitions(eepa_x86_64_v3_objects PRIVATE EEPA_MAKE_ENGINE=eepa_make_engine_x86_64_v3)

set(object "${CMAKE_CURRENT_BINARY_DIR}/x86_64_v3.o")
file(CONFIGURE OUTPUT x86_64_v3.ld CONTENT "SECTIONS { .text_x86_64_v3 : { *(.text .text.*) } }\n")
add_custom_command(OUTPUT "${object}"
  COMMAND "${EEPA_GNU_LD}" -r --force-group-allocation -T "${CMAKE_CURRENT_BINARY_DIR}/x86_64_v3.ld"
    -o "${object}" $<TARGET_OBJECTS:eepa_x86_64_v3_objects>
  COMMAND "${EEPA_GNU_OBJCOPY}" --keep-global-symbol=eepa_make_engine_x86_64_v3 "${object}"
  DEPENDS $<TARGET_OBJECTS:eepa_x86_64_v3_objects> "${CMAKE_CURRENT_BINARY_DIR}/x86_64_v3.ld"
  COMMENT "Keeping the code for x86-64-v3 apart"
  COMMAND_EXPAND_LISTS VERBATIM)
# An archive, so that programs of other folders can be linked with it.
add_library(eepa_x86_64_v3 STATIC "${object}")
set_target_properties(eepa_x86_64_v3 PROPERTIES LINKER_LANGUAGE CXX)
target_compile_definitions(eepa_styles PRIVATE EEPA_HAS_X86_64_V3)
target_link_libraries(eepa_styles PUBLIC eepa_x86_64_v3)
