# Target `tidy`: clang-tidy over every source of core io render apps.  A file is checked again when
# .clang-tidy changed or its object was rebuilt: that is when it, a header of it or its flags changed.
find_program(SCARP_CLANG_TIDY clang-tidy)
if(NOT SCARP_CLANG_TIDY)
  return()
endif()

set(stamps)
foreach(folder core core/analysis io render apps apps/bench)
  if(NOT IS_DIRECTORY ${PROJECT_BINARY_DIR}/${folder})
    continue() # not configured: SCARP_RENDER is off
  endif()
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/tidy/${folder})
  get_property(targets DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources INCLUDE REGEX "\\.cpp$")
    foreach(source ${sources})
      cmake_path(GET source FILENAME file)
      set(stamp tidy/${folder}/${file}.ok)
      add_custom_command(
        OUTPUT ${stamp}
        COMMAND ${SCARP_CLANG_TIDY} --quiet -p ${PROJECT_BINARY_DIR}
                --extra-arg=-Wno-unknown-warning-option # the flags are those of GCC
                ${PROJECT_SOURCE_DIR}/${folder}/${file}
        COMMAND ${CMAKE_COMMAND} -E touch ${stamp}
        DEPENDS ${folder}/CMakeFiles/${target}.dir/${file}.o ${PROJECT_SOURCE_DIR}/.clang-tidy
        COMMENT "clang-tidy ${folder}/${file}"
        VERBATIM)
      list(APPEND stamps ${stamp})
    endforeach()
  endforeach()
endforeach()
add_custom_target(tidy DEPENDS ${stamps})
