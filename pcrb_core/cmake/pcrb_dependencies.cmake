# Small libraries that some distributions do not have (docs/platforms.md): the installed one, else the
# release that is named here, checked by its hash. Without a network a local copy will do:
# -DFETCHCONTENT_SOURCE_DIR_PCRB_CLI11=FOLDER, a folder with include/CLI/CLI.hpp.

# Fetches an archive; sets ${name}_SOURCE_DIR. A macro, since FetchContent sets that in its caller.
macro(pcrb_fetch name sha256)
  include(FetchContent)
  FetchContent_Declare(${name} URL ${ARGN} URL_HASH SHA256=${sha256})
  FetchContent_GetProperties(${name})
  if(NOT ${name}_POPULATED)
    message(STATUS "${name} is not installed: fetching it")
    FetchContent_Populate(${name})
  endif()
endmacro()

# Fetches an archive and makes an imported target of its include/.
function(pcrb_fetch_headers name target sha256)
  pcrb_fetch(${name} ${sha256} ${ARGN})
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  set_target_properties(${target} PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES ${${name}_SOURCE_DIR}/include
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${${name}_SOURCE_DIR}/include)
endfunction()

macro(pcrb_find_cli11)
  find_package(CLI11 QUIET)
  if(NOT TARGET CLI11::CLI11)
    pcrb_fetch_headers(pcrb_cli11 CLI11::CLI11
      8143d20b688e98ccce8e24562d3b68e5f47c12e896c42c7ca8553dbde5bed55d
      http://deb.debian.org/debian/pool/main/c/cli11/cli11_2.1.2+ds.orig.tar.xz
      http://archive.debian.org/debian/pool/main/c/cli11/cli11_2.1.2+ds.orig.tar.xz)
  endif()
endmacro()

macro(pcrb_find_nanoflann)
  find_package(nanoflann QUIET)
  if(NOT TARGET nanoflann::nanoflann)
    pcrb_fetch_headers(pcrb_nanoflann nanoflann::nanoflann
      97114f86c2afd9f4fea0c32a926b09904228491cd8a701ab5346f3656e8bb16c
      http://deb.debian.org/debian/pool/main/n/nanoflann/nanoflann_1.7.1+ds.orig.tar.xz
      http://archive.debian.org/debian/pool/main/n/nanoflann/nanoflann_1.7.1+ds.orig.tar.xz)
  endif()
endmacro()

# From 3.9 on it has objects that keep their order.
macro(pcrb_find_nlohmann_json)
  find_package(nlohmann_json 3.9 QUIET)
  if(NOT TARGET nlohmann_json::nlohmann_json)
    pcrb_fetch_headers(pcrb_nlohmann_json nlohmann_json::nlohmann_json
      d69f9deb6a75e2580465c6c4c5111b89c4dc2fa94e3a85fcd2ffcd9a143d9273
      http://deb.debian.org/debian/pool/main/n/nlohmann-json3/nlohmann-json3_3.11.2.orig.tar.gz
      http://archive.debian.org/debian/pool/main/n/nlohmann-json3/nlohmann-json3_3.11.2.orig.tar.gz)
  endif()
endmacro()

# The decoder of LZF: LZF_INCLUDE_DIR and LZF_LIBRARY.
macro(pcrb_find_lzf)
  find_path(LZF_INCLUDE_DIR lzf.h PATH_SUFFIXES liblzf)
  find_library(LZF_LIBRARY lzf)
  if(NOT LZF_INCLUDE_DIR OR NOT LZF_LIBRARY)
    pcrb_fetch(pcrb_lzf 9c5de01f7b9ccae40c3f619d26a7abec9986c06c36d260c179cedd04b89fb46a
      http://deb.debian.org/debian/pool/main/libl/liblzf/liblzf_3.6.orig.tar.gz
      http://archive.debian.org/debian/pool/main/libl/liblzf/liblzf_3.6.orig.tar.gz)
    add_library(pcrb_lzf_decoder STATIC ${pcrb_lzf_SOURCE_DIR}/lzf_d.c)
    set_target_properties(pcrb_lzf_decoder PROPERTIES POSITION_INDEPENDENT_CODE ON)
    set(LZF_INCLUDE_DIR ${pcrb_lzf_SOURCE_DIR})
    set(LZF_LIBRARY pcrb_lzf_decoder)
  endif()
endmacro()

# Libraries whose imported targets came later than the oldest CMake or distribution that the suite knows.

macro(pcrb_find_tinyxml2)
  find_package(tinyxml2 QUIET)
  if(NOT TARGET tinyxml2::tinyxml2)
    find_package(PkgConfig REQUIRED)
    pkg_check_modules(PCRB_TINYXML2 REQUIRED IMPORTED_TARGET tinyxml2)
    add_library(tinyxml2::tinyxml2 INTERFACE IMPORTED)
    set_target_properties(tinyxml2::tinyxml2 PROPERTIES INTERFACE_LINK_LIBRARIES PkgConfig::PCRB_TINYXML2)
  endif()
endmacro()

macro(pcrb_find_libarchive)
  find_package(LibArchive REQUIRED)
  if(NOT TARGET LibArchive::LibArchive)
    add_library(LibArchive::LibArchive INTERFACE IMPORTED)
    set_target_properties(LibArchive::LibArchive PROPERTIES
      INTERFACE_INCLUDE_DIRECTORIES "${LibArchive_INCLUDE_DIRS}" INTERFACE_LINK_LIBRARIES "${LibArchive_LIBRARIES}")
  endif()
endmacro()
