include(GNUInstallDirs)

# A room of the house: every .cpp in its folder as one static library, relock::NAME.
#   relock_room(NAME [EXCEPT FILE...])
function(relock_room name)
  cmake_parse_arguments(ROOM "" "" "EXCEPT" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  foreach(file IN LISTS ROOM_EXCEPT)
    list(REMOVE_ITEM sources ${CMAKE_CURRENT_SOURCE_DIR}/${name}/${file})
  endforeach()
  add_library(relock_${name} STATIC ${sources})
  add_library(relock::${name} ALIAS relock_${name})
  set_target_properties(relock_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(relock_${name} PUBLIC cxx_std_20)
  target_include_directories(relock_${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}>
                                                   $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/relock>)
endfunction()

# Links those of OpenCV's modules that this OpenCV has; its headers are not held to our warnings.
#   relock_link_opencv(TARGET PRIVATE|PUBLIC MODULE...)
function(relock_link_opencv target visibility)
  target_include_directories(${target} SYSTEM ${visibility} "$<BUILD_INTERFACE:${OpenCV_INCLUDE_DIRS}>")
  foreach(module IN LISTS ARGN)
    if(TARGET opencv_${module})
      target_link_libraries(${target} ${visibility} opencv_${module})
    endif()
  endforeach()
endfunction()
