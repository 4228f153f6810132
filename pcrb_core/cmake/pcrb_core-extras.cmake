# The imported target pcrb_core::pcrb_core and the suite's compile options and dependencies, for packages that
# find pcrb_core through catkin. All files lie beside the package's configuration in every space.
find_package(Eigen3 REQUIRED)
find_package(Threads REQUIRED)
include("${pcrb_core_DIR}/pcrb_compile_options.cmake")
include("${pcrb_core_DIR}/pcrb_dependencies.cmake")
if(NOT TARGET pcrb_core::pcrb_core)
  include("${pcrb_core_DIR}/pcrb_coreTargets.cmake")
endif()
