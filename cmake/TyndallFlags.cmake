# Compiler flags, in two interface targets that every target of this project links.

add_library(tyndall_warnings INTERFACE)
target_compile_options(tyndall_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
# gcc's -Wconversion leaves out changes of sign, clang's does not; an index of type int is fine.
target_compile_options(tyndall_warnings INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)
# gcc 12 sees uninitialized members in every empty std::optional that it inlines.
target_compile_options(tyndall_warnings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
if(TYNDALL_WERROR)
  target_compile_options(tyndall_warnings INTERFACE -Werror)
endif()

add_library(tyndall_options INTERFACE)
target_compile_features(tyndall_options INTERFACE cxx_std_20)
# Fused multiply-adds differ between processors and compilers; images must not.
# errno and trapping mathematics are never used, and stop vectorization.
target_compile_options(tyndall_options INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(TYNDALL_NATIVE)
  target_compile_options(tyndall_options INTERFACE -march=native)
endif()
if(TYNDALL_SANITIZE)
  target_compile_options(tyndall_options INTERFACE -fsanitize=${TYNDALL_SANITIZE} -fno-omit-frame-pointer
                                                   -fno-sanitize-recover=all)
  target_link_options(tyndall_options INTERFACE -fsanitize=${TYNDALL_SANITIZE})
endif()

# Compiling again what was compiled before costs nothing where ccache is there.
find_program(TYNDALL_CCACHE ccache)
mark_as_advanced(TYNDALL_CCACHE)
if(PROJECT_IS_TOP_LEVEL AND TYNDALL_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${TYNDALL_CCACHE})
endif()
