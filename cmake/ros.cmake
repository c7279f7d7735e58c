# The thin edge to ROS, and the nodes.
file(GLOB ros_sources CONFIGURE_DEPENDS src/ros/*.cpp)
add_library(knot_utm_ros ${ros_sources})
add_dependencies(knot_utm_ros ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
target_include_directories(knot_utm_ros SYSTEM
                           PUBLIC ${catkin_INCLUDE_DIRS}
                                  $<BUILD_INTERFACE:${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION}>)
target_link_libraries(knot_utm_ros PUBLIC knot_utm_core ${catkin_LIBRARIES})

file(GLOB nodes CONFIGURE_DEPENDS src/nodes/*.cpp)
foreach(source ${nodes})
  get_filename_component(name ${source} NAME_WE)
  knot_utm_executable(${name} ${source})
  target_link_libraries(${name} PRIVATE knot_utm_ros)
endforeach()

# Listening on loopback only: for the nodes by the library above, for the programs of others that they are launched with
# (rosout, rviz) preloaded, and for the ROS master by the environment.
add_library(knot_utm_loopback SHARED src/ros/loopback_bind.cpp)
target_link_libraries(knot_utm_loopback PRIVATE knot_utm_compiler)
add_dependencies(programs knot_utm_loopback)
install(TARGETS knot_utm_loopback LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
catkin_add_env_hooks(60.knot_utm_loopback SHELLS sh DIRECTORY ${PROJECT_SOURCE_DIR}/cmake)
