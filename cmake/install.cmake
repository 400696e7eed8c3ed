# What `cmake --install` installs, how find_package(relock) finds it, and the Debian package of it.
include(CMakePackageConfigHelpers)
set(relock_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/relock)

# What a plug-in is compiled with. It links nothing of relock.
add_library(relock_plugin INTERFACE)
add_library(relock::plugin ALIAS relock_plugin)
set_target_properties(relock_plugin PROPERTIES EXPORT_NAME plugin)
target_compile_features(relock_plugin INTERFACE cxx_std_20)
target_compile_options(relock_plugin INTERFACE -fvisibility=hidden)
target_include_directories(relock_plugin INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                   $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/relock>)
target_link_options(relock_plugin INTERFACE
  -Wl,-z,defs  # a function that is missing is told now, not when the plug-in is loaded
  $<BUILD_INTERFACE:-Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/plugin.map>
  $<INSTALL_INTERFACE:-Wl,--version-script=$<INSTALL_PREFIX>/${relock_cmake_dir}/plugin.map>)
add_executable(relock::relock ALIAS relock)

set(rooms core sequences detectors trackers eval cli)
list(TRANSFORM rooms PREPEND relock_ OUTPUT_VARIABLE libraries)
install(TARGETS relock relock_plugin EXPORT relockPluginTargets)
install(TARGETS ${libraries} EXPORT relockTargets)
foreach(set relockPluginTargets relockTargets)
  install(EXPORT ${set} NAMESPACE relock:: DESTINATION ${relock_cmake_dir})
endforeach()
install(DIRECTORY ${rooms} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/relock FILES_MATCHING PATTERN "*.h")
install(DIRECTORY recordings DESTINATION ${CMAKE_INSTALL_DATADIR}/relock
        PATTERN CMakeLists.txt EXCLUDE
        PATTERN "*.cmake" EXCLUDE
        PATTERN "*.cpp" EXCLUDE
        PATTERN "*.h" EXCLUDE)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)

configure_package_config_file(cmake/relockConfig.cmake.in ${PROJECT_BINARY_DIR}/relockConfig.cmake
                              INSTALL_DESTINATION ${relock_cmake_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/relockConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/relockConfig.cmake ${PROJECT_BINARY_DIR}/relockConfigVersion.cmake
              cmake/dependencies.cmake cmake/plugin.map
        DESTINATION ${relock_cmake_dir})

if(PROJECT_IS_TOP_LEVEL)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_NAME relock)
  set(CPACK_PACKAGE_CONTACT "relock developers <relock@example.org>")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "scores trackers and detectors on blurred pictures and missing frames")
  set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"relock replays recordings with their true times and gaps to trackers and
detectors, built in or plugged in, and scores whether they keep the target,
how long until they have it back, and how exactly they say where it is.
This package has the program, its recordings, and the headers and libraries
for programs and plug-ins of your own.")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox")  # draws plots
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake, libopencv-dev")  # to build plug-ins
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # needs dpkg-dev
  include(CPack)
endif()
