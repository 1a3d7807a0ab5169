# How every file is compiled.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 99)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "" FORCE)
endif()
# Optimised, asserts off, lines for backtraces. Full debug information (the ABI check reads it) is for src/capi alone:
# it doubles the time that files with Eigen take to compile.
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1 -DNDEBUG")

find_program(IFSM_CCACHE ccache)
if(IFSM_CCACHE)
  # Relative to the checkout, so that another clone of it finds what this one compiled; sloppy as precompiled headers ask.
  set(launcher ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=/ CCACHE_NOHASHDIR=1
               CCACHE_SLOPPINESS=pch_defines,time_macros ${IFSM_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
endif()

# Contraction off: every compiler and every Highway target then gives the same bits.
add_compile_options(-Wall -Wextra -ffp-contract=off)
add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wconversion>)
if(IFSM_SANITIZE)
  # Half of what their build takes is the optimiser's work on instrumented code.
  string(REPLACE -O2 -O1 CMAKE_CXX_FLAGS_RELWITHDEBINFO "${CMAKE_CXX_FLAGS_RELWITHDEBINFO}")
  add_compile_options(-fsanitize=${IFSM_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  if(IFSM_SANITIZE MATCHES undefined)
    # With Eigen these two double a file's time. Null pointers trap by themselves; src/io and src/capi, which read what
    # others wrote, take alignment back.
    add_compile_options(-fno-sanitize=null,alignment)
  endif()
  add_link_options(-fsanitize=${IFSM_SANITIZE})
endif()
