# tessera_warnings: what every target of ours is compiled with; third party is SYSTEM.
add_library(tessera_warnings INTERFACE)
target_compile_options(
  tessera_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
)
# GCC 12 sees copies in std::string that overlap or are endless, and are not (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(tessera_warnings INTERFACE -Wno-restrict -Wno-stringop-overflow)
endif()
# GCC 14 follows paths through vectors and arrays that cannot be taken. GCC 12 and Clang find what is true of these.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  target_compile_options(
    tessera_warnings INTERFACE -Wno-array-bounds -Wno-free-nonheap-object -Wno-maybe-uninitialized
                               -Wno-stringop-overflow
  )
endif()
# With sanitizers GCC takes <regex> itself for uninitialized (GCC bug 105562).
if(TESSERA_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(tessera_warnings INTERFACE -Wno-maybe-uninitialized)
endif()
if(TESSERA_WARNINGS_AS_ERRORS)
  target_compile_options(tessera_warnings INTERFACE -Werror)
endif()

# tessera_sanitizers: ASan and UBSan for everything, also at link time.
if(TESSERA_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

# What libFuzzer needs to see where an input goes.
if(TESSERA_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
