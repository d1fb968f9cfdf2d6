# Compiler flags, in two interface targets that every target of this project links.

add_library(tyndall_warnings INTERFACE)
target_compile_options(tyndall_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
if(TYNDALL_WERROR)
  target_compile_options(tyndall_warnings INTERFACE -Werror)
endif()

add_library(tyndall_options INTERFACE)
target_compile_features(tyndall_options INTERFACE cxx_std_20)
# Fused multiply-adds differ between processors and compilers; images must not.
# errno and trapping mathematics are never used, and stop vectorisation.
target_compile_options(tyndall_options INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(TYNDALL_NATIVE)
  target_compile_options(tyndall_options INTERFACE -march=native)
endif()
if(TYNDALL_SANITIZE)
  target_compile_options(tyndall_options INTERFACE -fsanitize=${TYNDALL_SANITIZE} -fno-omit-frame-pointer
                                                   -fno-sanitize-recover=all)
  target_link_options(tyndall_options INTERFACE -fsanitize=${TYNDALL_SANITIZE})
endif()
