# The installed package: headers, targets and look-up, in one place that is independent of the architecture.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(splinertia_package_dir "${CMAKE_INSTALL_DATADIR}/cmake/splinertia")

install(DIRECTORY include/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.hpp")
install(TARGETS splinertia EXPORT splinertiaTargets)
install(EXPORT splinertiaTargets NAMESPACE splinertia:: DESTINATION "${splinertia_package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/splinertiaConfigVersion.cmake"
  VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES
  cmake/splinertiaConfig.cmake
  cmake/SplinertiaFindDependencies.cmake
  "${PROJECT_BINARY_DIR}/splinertiaConfigVersion.cmake"
  DESTINATION "${splinertia_package_dir}")
