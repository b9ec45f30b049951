# Given to CMake as CMAKE_PROJECT_INCLUDE by bench.py: the files of the tests are compiled a few at a
# time, which takes half as long as one by one.
foreach(target IN ITEMS test_kernel test_parser)
  cmake_language(EVAL CODE "cmake_language(DEFER CALL eepa_compile_together ${target})")
endforeach()
function(eepa_compile_together target)
  if(TARGET ${target})
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
  endif()
endfunction()
