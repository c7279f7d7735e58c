# What writes and reads bags is a library of its own: a tool that has no more to do with ROS loads no more of it.
set(bag_sources color_scale conversions curve_bag markers run_bag)
list(TRANSFORM bag_sources REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/src/ros/\\1.cpp")
add_library(knot_utm_bags ${bag_sources})
target_link_options(knot_utm_bags PUBLIC LINKER:--as-needed)
# The thin edge to ROS, and the nodes.
file(GLOB ros_sources CONFIGURE_DEPENDS src/ros/*.cpp)
list(REMOVE_ITEM ros_sources ${bag_sources})
add_library(knot_utm_ros ${ros_sources})
foreach(library knot_utm_bags knot_utm_ros)
  add_dependencies(${library} ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
  target_include_directories(${library} SYSTEM
                             PUBLIC ${catkin_INCLUDE_DIRS}
                                    $<BUILD_INTERFACE:${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION}>)
  target_link_libraries(${library} PUBLIC knot_utm_core ${catkin_LIBRARIES})
endforeach()
target_link_libraries(knot_utm_ros PUBLIC knot_utm_bags PRIVATE yaml-cpp)

# The headers of ROS take two seconds to read, and every file reads them (cmake/rooms.cmake).
if(NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set_target_properties(knot_utm_bags knot_utm_ros PROPERTIES DEFINE_SYMBOL "" UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 4)
  knot_utm_precompile("knot_utm_bags;knot_utm_ros" <Eigen/Core> <Eigen/Geometry> <functional> <ros/ros.h> <rosbag/bag.h>
                      <rosbag/view.h> <string> <vector> <visualization_msgs/MarkerArray.h>)
endif()

file(GLOB nodes CONFIGURE_DEPENDS src/nodes/*.cpp)
foreach(source ${nodes})
  get_filename_component(name ${source} NAME_WE)
  knot_utm_executable(${name} ${source})
  target_link_libraries(${name} PRIVATE knot_utm_ros)
endforeach()

# ROS_HOSTNAME=localhost for whoever sources setup.bash: master, roslaunch and nodes in Python then listen on loopback only.
catkin_add_env_hooks(60.knot_utm_loopback SHELLS sh DIRECTORY ${PROJECT_SOURCE_DIR}/cmake)
