# For building from nothing. Headers that most files include are compiled once, which takes a third
# of the work away; files are compiled eight at a time, another third. Not with ccache, which keeps no
# result that used such headers, and compiles again what changed only.
if(CMAKE_CXX_COMPILER_LAUNCHER)
  set(precompile_by_default OFF)
else()
  set(precompile_by_default ON)
endif()
option(TYNDALL_PRECOMPILE "Precompile the headers that most files include" ${precompile_by_default})

option(TYNDALL_UNITY "Compile the files of the library and the program eight at a time" ${precompile_by_default})

# tyndall_precompile(<target> [<header>...]): the common headers and those given.
function(tyndall_precompile target)
  if(TYNDALL_PRECOMPILE)
    target_precompile_headers(
      ${target} PRIVATE <algorithm> <array> <cmath> <functional> <map> <memory> <optional> <span> <string> <string_view>
      <variant> <vector> ${ARGN})
  endif()
endfunction()

# tyndall_unity(<target>): what files of one target put in anonymous namespaces must have different names.
function(tyndall_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${TYNDALL_UNITY} UNITY_BUILD_BATCH_SIZE 8)
  if(TYNDALL_UNITY)
    # gcc 12 takes all files but the first for headers, and with more to inline it believes more short
    # strings and small vectors of Boost's to be too long for themselves.
    target_compile_options(
      ${target}
      PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage;-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>"
    )
  endif()
endfunction()
