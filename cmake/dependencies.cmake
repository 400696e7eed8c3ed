# Everything that relock is linked to, one line each. relock's own build reads this file, and so does the
# relockConfig.cmake of an installed relock, because a static library needs what it was built with.

# A library that comes without CMake or pkg-config files, as external::NAME.
macro(relock_find_library name variable)
  find_library(${variable} ${name} REQUIRED)
  if(NOT TARGET external::${name})
    add_library(external::${name} UNKNOWN IMPORTED)
    set_target_properties(external::${name} PROPERTIES IMPORTED_LOCATION ${${variable}})
  endif()
endmacro()

find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs video calib3d OPTIONAL_COMPONENTS tracking aruco objdetect)
find_package(fmt REQUIRED)
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(Ceres REQUIRED)  # least squares, with covariances
find_package(Boost REQUIRED)  # its headers: quantiles
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(LIBAV REQUIRED IMPORTED_TARGET libavformat libavcodec libavutil libswscale)
pkg_check_modules(HTTPLIB REQUIRED cpp-httplib)  # serves the labelling page
pkg_check_modules(DLIB dlib-1)  # without it, `dlib` is listed and says what it needs
relock_find_library(csv CSV_LIBRARY)
relock_find_library(apriltag APRILTAG_LIBRARY)
