# A dependency provider: where a preset (or you) names this file in CMAKE_PROJECT_TOP_LEVEL_INCLUDES, a package that
# find_package does not find is fetched, once, into SPLINERTIA_DEPS_DIR. Nothing is installed, nothing needs root, and
# nothing that is fetched is run while configuring, except by the kind "build".
cmake_minimum_required(VERSION 3.24)
include_guard(GLOBAL)
cmake_path(SET splinertia_deps NORMALIZE "${CMAKE_CURRENT_LIST_DIR}/../build/deps")
set(SPLINERTIA_DEPS_DIR "${splinertia_deps}" CACHE PATH "Where fetched packages are kept")
set(SPLINERTIA_DEPS_SOURCES git apt build pip CACHE STRING "Where to fetch from, in this order")
option(SPLINERTIA_FETCH_OPTIONAL_PACKAGES "Fetch also what only some tests, tools and examples use" OFF)

# package | kind | what to get. The folder in SPLINERTIA_DEPS_DIR is named after the first three cells.
#   git: tag, url, the commit that the tag must be   apt: package   pip: version, name, sha256 of the source archive
#   build: as git, and the CMake options that turn off what we do not need: for a package that must be compiled
# git and pip also: the folder that holds the headers there, and its name below include/ here. sophuspy carries
# upstream's headers of April 2018.
set(splinertia_sources
  "Eigen3|git|3.4.0|https://gitlab.com/libeigen/eigen.git|3147391d946bb4b6c68edd901f2add6ac1f31f8c|Eigen|Eigen"
  "Eigen3|apt|libeigen3-dev"
  "Sophus|git|1.24.6|https://github.com/strasdat/Sophus.git|d0b7315a0d90fc6143defa54596a3a95d9fa10ec|sophus|sophus"
  "Sophus|pip|1.2.0|sophuspy|a88d106589fa3d89777226f1df4f419a7aaafa441fc2070092726aa4573eed9f|sophuspy/include/original|sophus"
  "Catch2|git|v2.13.10|https://github.com/catchorg/Catch2.git|182c910b4b63ff587a3440e08f84f70497e49a81|single_include/catch2|catch2"
  "Catch2|apt|catch2"
  "CLI11|git|v2.4.2|https://github.com/CLIUtils/CLI11.git|6c7b07a878ad834957b98d0f9ce1dbe0cb204fc9|include/CLI|CLI"
  "CLI11|apt|libcli11-dev"
  "Ceres|apt|libceres-dev"
  "Boost|apt|libboost-dev"
  "yaml-cpp|apt|libyaml-cpp-dev"
  "yaml-cpp|build|0.8.0|https://github.com/jbeder/yaml-cpp.git|f7320141120f720aecc4c32be25586e7da9eb978|\
-DYAML_CPP_BUILD_CONTRIB=OFF -DYAML_CPP_BUILD_TOOLS=OFF")
if(NOT SPLINERTIA_FETCH_OPTIONAL_PACKAGES)
  list(FILTER splinertia_sources EXCLUDE REGEX "^(Ceres|Boost)[|]")
endif()

# Runs a command quietly; a failure is a line of the verbose log and <ok> = FALSE.
function(splinertia_run ok seconds)
  execute_process(COMMAND ${ARGN} TIMEOUT ${seconds} RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(code EQUAL 0)
    set(${ok} TRUE PARENT_SCOPE)
  else()
    set(${ok} FALSE PARENT_SCOPE)
    message(VERBOSE "  ${ARGN}: ${code} ${text}")
  endif()
endfunction()

# Clones <tag> of <url> into the new folder <source>. <ok> is TRUE if that is <commit>.
function(splinertia_clone ok tag url commit source)
  set(${ok} FALSE PARENT_SCOPE)
  find_program(SPLINERTIA_GIT git)
  mark_as_advanced(SPLINERTIA_GIT)
  string(REGEX MATCH "//[^/]+" host "${url}")
  get_property(unreachable GLOBAL PROPERTY splinertia_unreachable)
  if(NOT SPLINERTIA_GIT OR host IN_LIST unreachable)
    return()
  endif()
  # Ask for the tag first: a clone from a host out of reach would keep everybody waiting.
  set(git ${CMAKE_COMMAND} -E env GIT_TERMINAL_PROMPT=0 "${SPLINERTIA_GIT}" -c advice.detachedHead=false)
  splinertia_run(answers 10 ${git} ls-remote --exit-code "${url}" "refs/tags/${tag}")
  if(NOT answers)
    set_property(GLOBAL APPEND PROPERTY splinertia_unreachable "${host}")
    return()
  endif()
  splinertia_run(cloned 300 ${git} clone --quiet --depth 1 --branch "${tag}" "${url}" "${source}")
  if(cloned)
    execute_process(COMMAND "${SPLINERTIA_GIT}" -C "${source}" rev-parse HEAD
      OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(head STREQUAL commit)
      set(${ok} TRUE PARENT_SCOPE)
    else()
      message(WARNING "${url} ${tag} is ${head}, not ${commit} as expected: not used")
    endif()
  endif()
endfunction()

# splinertia_fetch_<kind>(<prefix> ...the row's cells): fills the empty folder <prefix>, or leaves it without headers.

function(splinertia_fetch_git prefix tag url commit folder include_name)
  splinertia_clone(ok "${tag}" "${url}" "${commit}" "${prefix}/source")
  if(ok)
    file(COPY "${prefix}/source/${folder}/" DESTINATION "${prefix}/include/${include_name}")
  endif()
  file(REMOVE_RECURSE "${prefix}/source")
endfunction()

# A static library, optimised whatever the preset: only the choice of standard library is passed on. Old releases know
# nothing of CMake 4 and GCC 15, which took away policies before 3.5 and <cstdint> inside other headers.
function(splinertia_fetch_build prefix tag url commit options)
  splinertia_clone(ok "${tag}" "${url}" "${commit}" "${prefix}/source")
  if(ok)
    separate_arguments(options)
    splinertia_run(ok 120 ${CMAKE_COMMAND} -S "${prefix}/source" -B "${prefix}/build" -G "${CMAKE_GENERATOR}"
      "-DCMAKE_MAKE_PROGRAM=${CMAKE_MAKE_PROGRAM}" "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
      "-DCMAKE_CXX_FLAGS=${splinertia_stdlib} -include cstdint" -DCMAKE_BUILD_TYPE=Release
      -DCMAKE_POLICY_VERSION_MINIMUM=3.5 -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF ${options})
  endif()
  if(ok)
    splinertia_run(ok 600 ${CMAKE_COMMAND} --build "${prefix}/build" --config Release)
  endif()
  if(ok)
    splinertia_run(ok 60 ${CMAKE_COMMAND} --install "${prefix}/build" --config Release --prefix "${prefix}")
  endif()
  if(ok)
    file(REMOVE_RECURSE "${prefix}/source" "${prefix}/build")
  else()
    file(REMOVE_RECURSE "${prefix}")
  endif()
endfunction()

# Downloads <package>, and what it needs and this machine lacks, into the new folder <folder>, by the command <apt>.
function(splinertia_apt_download ok package folder apt)
  file(MAKE_DIRECTORY "${folder}")
  execute_process(COMMAND ${apt} --simulate --no-install-recommends install "${package}"
    OUTPUT_VARIABLE text ERROR_QUIET TIMEOUT 60)
  string(REGEX MATCHALL "Inst [^ ]+" lacking "${text}")
  list(TRANSFORM lacking REPLACE "Inst " "")
  list(REMOVE_ITEM lacking "${package}")
  splinertia_run(done 300 ${CMAKE_COMMAND} -E chdir "${folder}" ${apt} download "${package}" ${lacking})
  set(${ok} ${done} PARENT_SCOPE)
endfunction()

# Package lists are 100 MB: they are read once, for all packages of the table that might be wanted, and not kept.
function(splinertia_fetch_apt prefix package)
  find_program(SPLINERTIA_APT apt-get)
  find_program(SPLINERTIA_DPKG dpkg-deb)
  mark_as_advanced(SPLINERTIA_APT SPLINERTIA_DPKG)
  if(NOT SPLINERTIA_APT OR NOT SPLINERTIA_DPKG)
    return()
  endif()
  set(archives "${SPLINERTIA_DEPS_DIR}/archives")
  if(NOT EXISTS "${archives}/${package}")
    set(work "${SPLINERTIA_DEPS_DIR}/apt.part")
    file(REMOVE_RECURSE "${work}")
    file(MAKE_DIRECTORY "${archives}" "${work}/lists/partial" "${work}/cache/archives/partial")
    set(apt "${SPLINERTIA_APT}" -qq -o "Dir::State::Lists=${work}/lists" -o "Dir::Cache=${work}/cache"
      -o APT::Sandbox::User=root -o Acquire::Languages=none -o Acquire::Retries=2 -o Acquire::http::Timeout=20)
    splinertia_run(ok 180 ${apt} update)
    set(rows ${splinertia_sources})
    list(FILTER rows INCLUDE REGEX "[|]apt[|]")
    foreach(row IN LISTS rows)
      string(REGEX REPLACE ".*[|]" "" wanted "${row}")
      if(NOT EXISTS "${archives}/${wanted}")
        splinertia_apt_download(ok "${wanted}" "${work}/new/${wanted}" "${apt}")
        if(ok)
          file(RENAME "${work}/new/${wanted}" "${archives}/${wanted}")
        endif()
      endif()
    endforeach()
    file(REMOVE_RECURSE "${work}")
  endif()
  file(GLOB packed "${archives}/${package}/*.deb")
  foreach(archive IN LISTS packed)
    splinertia_run(ok 60 "${SPLINERTIA_DPKG}" -x "${archive}" "${prefix}")
    if(NOT ok)
      file(REMOVE_RECURSE "${prefix}" "${archives}/${package}")
      return()
    endif()
  endforeach()
  # BLAS and LAPACK have folders of their own, and installing would link one of several into the common folder.
  file(GLOB libraries "${prefix}/usr/lib/*/*/libblas.so.3" "${prefix}/usr/lib/*/*/liblapack.so.3")
  foreach(library IN LISTS libraries)
    cmake_path(GET library FILENAME name)
    cmake_path(GET library PARENT_PATH folder)
    cmake_path(GET folder FILENAME folder_name)
    file(CREATE_LINK "${folder_name}/${name}" "${folder}/../${name}" SYMBOLIC)
  endforeach()
endfunction()

function(splinertia_fetch_pip prefix version name sha256 folder include_name)
  find_program(SPLINERTIA_PYTHON NAMES python3 python)
  mark_as_advanced(SPLINERTIA_PYTHON)
  if(NOT SPLINERTIA_PYTHON)
    return()
  endif()
  file(MAKE_DIRECTORY "${prefix}/source")
  splinertia_run(ok 300 "${SPLINERTIA_PYTHON}" "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/fetch_source_archive.py"
    "${name}" "${version}" "${sha256}" "${prefix}/source")
  if(ok)
    file(ARCHIVE_EXTRACT INPUT "${prefix}/source/${name}-${version}.tar.gz" DESTINATION "${prefix}/source")
    file(COPY "${prefix}/source/${name}-${version}/${folder}/" DESTINATION "${prefix}/include/${include_name}")
  endif()
  file(REMOVE_RECURSE "${prefix}/source")
endfunction()

# Sets <prefix> to a folder that holds <package>: one fetched earlier, or fetched now from the first source that works.
# The work is done in a folder *.part that is renamed when complete, under a lock: other configures may run beside us.
function(splinertia_provide package prefix)
  file(LOCK "${SPLINERTIA_DEPS_DIR}" DIRECTORY GUARD FUNCTION TIMEOUT 900)
  set(rows "")
  foreach(kind IN LISTS SPLINERTIA_DEPS_SOURCES)
    set(row ${splinertia_sources})
    list(FILTER row INCLUDE REGEX "^${package}[|]${kind}[|]")
    list(APPEND rows ${row})
  endforeach()
  # What others compiled is for the compiler's usual standard library.
  string(REGEX MATCH "-stdlib=libc[+][+]" splinertia_stdlib "${CMAKE_CXX_FLAGS}")
  if(splinertia_stdlib AND rows MATCHES "[|]build[|]")
    list(FILTER rows INCLUDE REGEX "[|]build[|]")
  endif()
  foreach(step IN ITEMS look fetch)
    foreach(row IN LISTS rows)
      string(REPLACE "|" ";" cells "${row}")
      list(POP_FRONT cells package kind)
      list(GET cells 0 version)
      set(folder "${SPLINERTIA_DEPS_DIR}/${package}-${kind}-${version}")
      if(kind STREQUAL "build")
        string(APPEND folder "${splinertia_stdlib}")
      endif()
      if(step STREQUAL "fetch")
        message(STATUS "${package} is not installed, fetching it (${kind})")
        file(REMOVE_RECURSE "${folder}.part")
        file(MAKE_DIRECTORY "${folder}.part")
        cmake_language(CALL splinertia_fetch_${kind} "${folder}.part" ${cells})
        if(EXISTS "${folder}.part/include" OR EXISTS "${folder}.part/usr/include")
          file(RENAME "${folder}.part" "${folder}")
        endif()
        file(REMOVE_RECURSE "${folder}.part")
      endif()
      if(EXISTS "${folder}")
        set(${prefix} "${folder}" PARENT_SCOPE)
        return()
      endif()
    endforeach()
  endforeach()
  message(STATUS "${package} could not be fetched (--log-level=VERBOSE says why)")
endfunction()

# Python packages that tests use, and those that tests of cameras use: module to import | requirement of pip.
set(splinertia_python_packages
  "rosbags|rosbags==0.11.*" "numpy|numpy<3" "matplotlib|matplotlib==3.*" "evo|evo==1.38.*" "allantools|allantools==2024.6")
set(splinertia_python_camera_packages "numpy|numpy<3" "cv2|opencv-python-headless>=4.8,<6" "pycolmap|pycolmap>=3.11,<5")

# splinertia_provide_python(<folder> <python> <packages>...): sets <folder> to one for PYTHONPATH, with programs in its
# bin/, that holds those packages which <python> lacks, fetched once by pip; to nothing where none is lacking or pip is
# out of reach.
function(splinertia_provide_python folder python)
  set(${folder} "" PARENT_SCOPE)
  set(modules ${ARGN})
  list(TRANSFORM modules REPLACE "[|].*" "")
  execute_process(COMMAND "${python}" -c "import sys, importlib.util as u
print(*sys.version_info[:2], sep='.')
print(*[m for m in sys.argv[1:] if u.find_spec(m) is None], sep=';', end='')" ${modules}
    RESULT_VARIABLE failed OUTPUT_VARIABLE text ERROR_QUIET)
  if(failed)
    message(STATUS "splinertia's tests skip what needs Python, because ${python} cannot be run")
    return()
  endif()
  string(REGEX MATCH "^[^\n]*" version "${text}")
  string(REGEX REPLACE "^[^\n]*\n" "" missing "${text}")
  if(NOT missing)
    return()
  endif()
  list(JOIN missing "|" pattern)
  set(requirements ${ARGN})
  list(FILTER requirements INCLUDE REGEX "^(${pattern})[|]")
  list(TRANSFORM requirements REPLACE ".*[|]" "")
  string(MD5 hash "${requirements}")
  set(target "${SPLINERTIA_DEPS_DIR}/python${version}-${hash}")
  file(LOCK "${SPLINERTIA_DEPS_DIR}" DIRECTORY GUARD FUNCTION TIMEOUT 900)
  list(JOIN missing ", " names)
  if(NOT EXISTS "${target}")
    message(STATUS "${python} lacks ${names}, fetching them for the tests (pip)")
    file(REMOVE_RECURSE "${target}.part")
    splinertia_run(ok 600 "${python}" -m pip install --quiet --disable-pip-version-check --only-binary ":all:"
      --target "${target}.part" ${requirements})
    if(NOT ok)
      file(REMOVE_RECURSE "${target}.part")
      message(STATUS "splinertia's tests skip what needs the Python packages ${names}: pip could not fetch them "
        "(--log-level=VERBOSE says why)")
      return()
    endif()
    file(RENAME "${target}.part" "${target}")
  endif()
  message(STATUS "splinertia's tests use the Python packages ${names} in ${target}")
  set(${folder} "${target}" PARENT_SCOPE)
endfunction()

# Only names a place to look: the find_package that called us then goes on as usual, with <package>_ROOT set.
set(splinertia_configs "${CMAKE_CURRENT_LIST_DIR}/fetched")
macro(splinertia_provide_dependency method package)
  if("${splinertia_sources}" MATCHES "(^|;)${package}[|]")
    find_package(${package} CONFIG QUIET BYPASS_PROVIDER)
    if(NOT ${package}_FOUND AND NOT splinertia_headers)
      splinertia_provide(${package} ${package}_ROOT)
      if(EXISTS "${${package}_ROOT}/usr")
        string(APPEND ${package}_ROOT "/usr")
        if(EXISTS "${splinertia_configs}/${package}Config.cmake")   # ours, in place of the package's own
          set(${package}_DIR "${splinertia_configs}")
        endif()
      endif()
    endif()
  endif()
endmacro()
cmake_language(SET_DEPENDENCY_PROVIDER splinertia_provide_dependency SUPPORTED_METHODS FIND_PACKAGE)
