# find_package(drape) gives the target drape::drape, a static library, and finds the libraries that it needs.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(fmt)
find_dependency(assimp)
find_dependency(PkgConfig)
pkg_check_modules(jsoncpp REQUIRED IMPORTED_TARGET jsoncpp)
pkg_check_modules(spirv_cross REQUIRED IMPORTED_TARGET spirv-cross-c-shared)
include(${CMAKE_CURRENT_LIST_DIR}/drapeTargets.cmake)
