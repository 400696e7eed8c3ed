# ROS 1 bags, if librosbag_storage is there: ROSBAG_LIBRARIES is set. Debian pairs it with the pluginlib of ROS 2, so
# that neither its pkg-config file nor its CMake package can be used as it stands: the parts are found one by one.
set(RELOCK_ROSBAG AUTO CACHE STRING "Read ROS 1 bags: ON, OFF, or AUTO for: if librosbag_storage is installed")

function(relock_find_rosbag)
  find_path(ROSBAG_INCLUDE_DIR rosbag/bag.h)
  set(includes ${ROSBAG_INCLUDE_DIR})
  foreach(name pluginlib class_loader rcpputils rcutils ament_index_cpp)  # of ROS 2, each in a folder of its own
    find_path(ROSBAG_${name}_DIR ${name} PATH_SUFFIXES ${name} NO_CACHE)
    if(ROSBAG_${name}_DIR)
      list(APPEND includes ${ROSBAG_${name}_DIR})
    endif()
  endforeach()
  set(libraries)
  foreach(name rosbag_storage roscpp_serialization rostime cpp_common console_bridge)
    find_library(ROSBAG_${name}_LIBRARY ${name})
    list(APPEND libraries ${ROSBAG_${name}_LIBRARY})
  endforeach()
  if("${includes};${libraries}" MATCHES "NOTFOUND")
    return()
  endif()

  list(REMOVE_DUPLICATES includes)

  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_INCLUDES ${includes})
  set(CMAKE_REQUIRED_LIBRARIES ${libraries})
  set(CMAKE_REQUIRED_QUIET ON)
  set(CMAKE_REQUIRED_FLAGS "-w")
  check_cxx_source_compiles("#include <rosbag/bag.h>
    int main() { rosbag::Bag bag; bag.open(\"none\"); }" ROSBAG_COMPILES)
  if(NOT ROSBAG_COMPILES)
    return()
  endif()
  # By path and not as a target, so that an installed relock needs no target of that name.
  set(ROSBAG_INCLUDES ${includes} PARENT_SCOPE)
  set(ROSBAG_LIBRARIES ${libraries} PARENT_SCOPE)
endfunction()

# Links what reads ROS bags, if it is there.
function(relock_link_rosbag target)
  if(ROSBAG_LIBRARIES)
    target_include_directories(${target} SYSTEM PRIVATE ${ROSBAG_INCLUDES})
    target_link_libraries(${target} PRIVATE ${ROSBAG_LIBRARIES})
  endif()
endfunction()

if(NOT RELOCK_ROSBAG STREQUAL OFF)
  relock_find_rosbag()
  if(RELOCK_ROSBAG STREQUAL ON AND NOT ROSBAG_LIBRARIES)
    message(FATAL_ERROR "RELOCK_ROSBAG is ON and ROS bags cannot be read: "
                        "install librosbag-storage-dev")
  endif()
endif()
