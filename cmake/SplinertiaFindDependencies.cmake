# Finds Eigen and Sophus however they were installed, and says which. Used by the build and by the installed package;
# downloads nothing (SplinertiaProvideDependencies.cmake does, where a preset asks for it).

# splinertia_find(<package> <target> <header>): makes sure that <target> exists, from the package's own config file or,
# where there is none (Sophus before 1.1, a bare folder of headers), from the folder that holds <header>. Such a folder
# is found by CMAKE_PREFIX_PATH, or named by <package>_DIR. Tells its caller <package>_VERSION, _FOLDER, and _SUMMARY.
function(splinertia_find package target header)
  if(TARGET ${target})
    set(${package}_SUMMARY "${package}: ${target} of the enclosing project" PARENT_SCOPE)
    return()
  endif()
  # <package>_DIR first, because find_package forgets one without a config file in it.
  set(folders PATH_SUFFIXES include eigen3 include/eigen3)
  find_path(splinertia_headers ${header} PATHS ${${package}_DIR} ${folders} NO_DEFAULT_PATH NO_CACHE)
  if(NOT splinertia_headers)
    find_path(splinertia_headers ${header} ${folders} NO_CACHE)   # no reason to fetch then
    find_package(${package} CONFIG QUIET)   # never with a version: Eigen 5 refuses a request for 3.4
    find_path(splinertia_headers ${header} HINTS ${${package}_ROOT} ${${package}_INCLUDE_DIRS} ${folders} NO_CACHE)
  endif()
  set(folder "${${package}_DIR}")
  set(kind "")
  if(NOT TARGET ${target})
    if(NOT splinertia_headers)
      return()
    endif()
    string(REGEX REPLACE "/$" "" splinertia_headers "${splinertia_headers}")
    add_library(${target} INTERFACE IMPORTED)
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${splinertia_headers}")
    set(folder "${splinertia_headers}")
    set(kind ", headers only")
  endif()
  string(STRIP "${package} ${${package}_VERSION}" name)
  set(${package}_SUMMARY "${name} in ${folder}${kind}" PARENT_SCOPE)
  set(${package}_FOLDER "${folder}" PARENT_SCOPE)
  set(${package}_VERSION "${${package}_VERSION}" PARENT_SCOPE)
endfunction()

# splinertia_find_ceres(): makes the target Ceres::ceres if Ceres is installed. Packagers compile it for the compiler's usual
# standard library, so with -stdlib=libc++ it is left out.
macro(splinertia_find_ceres)
  if(NOT CMAKE_CXX_FLAGS MATCHES "-stdlib=libc[+][+]")
    set(CMAKE_MESSAGE_LOG_LEVEL NOTICE)   # its config file lists all of SuiteSparse
    find_package(Ceres CONFIG QUIET)
    unset(CMAKE_MESSAGE_LOG_LEVEL)
  endif()
endmacro()

splinertia_find(Eigen3 Eigen3::Eigen Eigen/Core)
splinertia_find(Sophus Sophus::Sophus sophus/so3.hpp)

set(splinertia_missing "")
if(NOT TARGET Eigen3::Eigen)
  set(splinertia_missing "Eigen 3.4 or newer")
elseif(Eigen3_VERSION AND Eigen3_VERSION VERSION_LESS 3.4)
  set(splinertia_missing "Eigen 3.4 or newer, and this is ${Eigen3_SUMMARY}")
elseif(NOT TARGET Sophus::Sophus)
  set(splinertia_missing "Sophus")
endif()

if(splinertia_missing STREQUAL "")
  if(NOT splinertia_FIND_QUIETLY)
    message(STATUS "splinertia uses ${Eigen3_SUMMARY}")
    message(STATUS "splinertia uses ${Sophus_SUMMARY}")
  endif()
else()
  string(CONCAT splinertia_missing "splinertia needs ${splinertia_missing}. Install it or name its folder in "
    "CMAKE_PREFIX_PATH. To have it fetched, configure splinertia with one of its presets (cmake --preset default; "
    "CMake 3.25 or newer).")
  if(CMAKE_FIND_PACKAGE_NAME STREQUAL "splinertia")   # the installed package: the caller decides how bad it is
    set(splinertia_NOT_FOUND_MESSAGE "${splinertia_missing}")
    set(splinertia_FOUND FALSE)
  else()
    message(FATAL_ERROR "${splinertia_missing}")
  endif()
endif()
