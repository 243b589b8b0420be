# scarp_options: what every target of the project compiles with.  No -ffast-math: NaN must stay
# detectable, and the sum's order is part of the result.
add_library(scarp_options INTERFACE)
target_include_directories(scarp_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(scarp_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>) # GCC bug 105651
# Neither changes a value: the first says that nobody reads errno, the second that nobody reads the
# processor's exception flags.  Without them no loop with a square root or a choice is vectorised.
target_compile_options(scarp_options INTERFACE -fno-math-errno -fno-trapping-math)
if(SCARP_WERROR)
  target_compile_options(scarp_options INTERFACE -Werror)
endif()
if(SCARP_NATIVE)
  target_compile_options(scarp_options INTERFACE -march=native)
endif()
if(SCARP_SANITIZE)
  target_compile_options(scarp_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(scarp_options INTERFACE -fsanitize=address,undefined)
endif()
