# For a Ceres out of Debian's packages, extracted into the folder Ceres_ROOT. The config file in there asks for those of
# everything that Ceres was built with, and for Eigen in one version exactly. Programs need the headers and two libraries.
file(GLOB splinertia_libraries "${Ceres_ROOT}/lib/*/libceres.so" "${Ceres_ROOT}/lib/*/libglog.so")
add_library(Ceres::ceres INTERFACE IMPORTED)
target_include_directories(Ceres::ceres INTERFACE "${Ceres_ROOT}/include")
target_link_libraries(Ceres::ceres INTERFACE ${splinertia_libraries} Eigen3::Eigen)
# The old form of a program's run-time path also holds for the libraries of its libraries.
target_link_options(Ceres::ceres INTERFACE LINKER:--disable-new-dtags)
