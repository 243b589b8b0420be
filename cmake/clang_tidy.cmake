# Target `tidy`: clang-tidy over every source of core io render apps, again when one of them, a header
# or .clang-tidy changed.  Where sources are joined (preset `sanitize`) it reads the headers once for
# eight of them.
find_program(SCARP_RUN_CLANG_TIDY run-clang-tidy)
if(NOT SCARP_RUN_CLANG_TIDY)
  return()
endif()

set(folders core core/analysis io render apps apps/bench)
set(read .clang-tidy)
foreach(folder ${folders})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.[ch]pp)
  list(APPEND read ${sources})
  if(IS_DIRECTORY ${PROJECT_BINARY_DIR}/${folder}) # else not configured: SCARP_RENDER is off
    get_property(targets DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} PROPERTY BUILDSYSTEM_TARGETS)
    set_property(TARGET ${targets} PROPERTY
      UNITY_BUILD_CODE_BEFORE_INCLUDE "// NOLINTNEXTLINE(bugprone-suspicious-include): joined by CMake")
  endif()
endforeach()
list(JOIN folders "|" any_folder)
add_custom_command(
  OUTPUT tidy.ok
  COMMAND ${SCARP_RUN_CLANG_TIDY} -quiet -p ${PROJECT_BINARY_DIR}
          # The flags are those of GCC.
          -extra-arg=-Wno-unknown-warning-option -extra-arg=-Wno-unused-command-line-argument
          "^${PROJECT_SOURCE_DIR}/(${any_folder})/[^/]*$"
          "^${PROJECT_BINARY_DIR}/(${any_folder})/CMakeFiles/[^/]*/Unity/"
  COMMAND ${CMAKE_COMMAND} -E touch tidy.ok
  DEPENDS ${read}
  WORKING_DIRECTORY ${PROJECT_BINARY_DIR}
  COMMENT "clang-tidy"
  VERBATIM)
add_custom_target(tidy DEPENDS tidy.ok)
