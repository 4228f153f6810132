# Compile options of the suite's own targets; all packages use this one function.

option(PCRB_WERROR "Treat warnings as errors" OFF)
set(PCRB_SANITIZE "" CACHE STRING "Sanitizers for all targets, e.g. address,undefined")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
option(PCRB_UNITY "Compile several sources of a target in one go: most of the time goes into headers" ON)
find_program(PCRB_CCACHE ccache)
if(PCRB_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER ${PCRB_CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${PCRB_CCACHE})
endif()

# Sets C++17, warnings and reproducible floating point on a target.
function(pcrb_set_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_17)
  set_target_properties(${target} PROPERTIES
    CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off)
  if(PCRB_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(PCRB_SANITIZE)
    target_compile_options(${target} PRIVATE
      -fsanitize=${PCRB_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
    target_link_options(${target} PUBLIC -fsanitize=${PCRB_SANITIZE})
  endif()
endfunction()

# For code that is compiled for longer than it runs, tests above all: most of what handles points is in other libraries.
function(pcrb_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-O1>)
endfunction()

# Compiles sixteen sources of a target in one go. Names in unnamed namespaces must then differ within the target.
function(pcrb_set_unity_build target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${PCRB_UNITY} UNITY_BUILD_BATCH_SIZE 16)
endfunction()
