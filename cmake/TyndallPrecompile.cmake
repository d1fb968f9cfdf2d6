# Headers that most files include, compiled once: building from nothing takes a third less work.
# Not with ccache, which keeps no result that used them.
if(CMAKE_CXX_COMPILER_LAUNCHER)
  set(precompile_by_default OFF)
else()
  set(precompile_by_default ON)
endif()
option(TYNDALL_PRECOMPILE "Precompile the headers that most files include" ${precompile_by_default})

# tyndall_precompile(<target> [<header>...]): the common headers and those given.
function(tyndall_precompile target)
  if(TYNDALL_PRECOMPILE)
    target_precompile_headers(
      ${target} PRIVATE <algorithm> <array> <cmath> <functional> <map> <memory> <optional> <span> <string> <string_view>
      <variant> <vector> ${ARGN})
  endif()
endfunction()
