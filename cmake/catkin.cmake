# catkin where it is there: messages, and where executables go. Without it the core and the tools are built all the same.
set(catkin_FOUND FALSE)
if(KNOT_UTM_ROS)
  # catkin installs setup.bash to where CMAKE_INSTALL_PREFIX was when configured, whatever `cmake --install --prefix`
  # says. Built on its own, the package installs these files itself; in a workspace that is the workspace's task.
  if(CMAKE_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR AND NOT DEFINED CATKIN_INSTALL_INTO_PREFIX_ROOT)
    set(CATKIN_INSTALL_INTO_PREFIX_ROOT FALSE)
    set(KNOT_UTM_INSTALLS_SETUP TRUE)
  endif()
  set(message_packages actionlib_msgs geometry_msgs std_msgs)
  set(node_packages actionlib diagnostic_updater dynamic_reconfigure rosbag roscpp rosgraph_msgs sensor_msgs std_srvs tf2_msgs tf2_ros visualization_msgs)
  # The environment of the tests is written now, with those of its paths that are there: on a first configuration none.
  if(NOT DEFINED CATKIN_DEVEL_PREFIX)
    file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/devel/lib/python3/dist-packages ${CMAKE_BINARY_DIR}/devel/lib/pkgconfig)
  endif()
  find_package(catkin QUIET COMPONENTS message_generation ${message_packages} ${node_packages})
endif()

# Built on its own the devel space has the package's folder in share/, as an installed one has: of a source folder rosrun
# leaves out all that lies in its build/, and finds the programs of every other folder that was built in.
if(catkin_FOUND AND KNOT_UTM_INSTALLS_SETUP)
  file(WRITE ${CATKIN_DEVEL_PREFIX}/.catkin "")
  file(MAKE_DIRECTORY ${CATKIN_DEVEL_PREFIX}/share/knot_utm/msg)
  foreach(part package.xml action cfg config launch srv)
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${part} ${CATKIN_DEVEL_PREFIX}/share/knot_utm/${part} SYMBOLIC)
  endforeach()
  file(GLOB messages msg/*.msg)
  foreach(message ${messages})
    get_filename_component(name ${message} NAME)
    file(CREATE_LINK ${message} ${CATKIN_DEVEL_PREFIX}/share/knot_utm/msg/${name} SYMBOLIC)
  endforeach()
endif()

if(catkin_FOUND)
  add_message_files(DIRECTORY msg FILES
                    ColorBar.msg Crosshead.msg KnotRecord.msg KnotShape.msg KnotState.msg RecorderStatus.msg SpecimenInfo.msg
                    TestStatus.msg)
  add_service_files(DIRECTORY srv FILES Reset.srv StartTest.srv)
  add_action_files(DIRECTORY action FILES Move.action RunTest.action)
  # The messages are in the Python package that python/ holds. In devel space its __init__.py stands for both; installed, there
  # is that of python/ only. catkin_python_setup() would do the same, but it installs to where CMAKE_INSTALL_PREFIX was when
  # configured, whatever `cmake --install --prefix` says.
  set(PACKAGE_PYTHONPATH ${PROJECT_SOURCE_DIR}/python)
  configure_file(${catkin_EXTRAS_DIR}/templates/__init__.py.in
                 ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_PYTHON_DESTINATION}/__init__.py @ONLY)
  set(${PROJECT_NAME}_CATKIN_PYTHON_SETUP_HAS_PACKAGE_INIT TRUE)
  generate_dynamic_reconfigure_options(cfg/Machine.cfg cfg/View.cfg)
  generate_messages(DEPENDENCIES ${message_packages})
  get_target_property(EIGEN3_INCLUDE_DIRS Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  # Installed into /usr itself catkin's file lies elsewhere than the exported targets.
  if(NOT CMAKE_INSTALL_PREFIX STREQUAL /usr)
    set(installed_targets CFG_EXTRAS knot_utm-config.cmake)
  endif()
  catkin_package(INCLUDE_DIRS include LIBRARIES knot_utm_ros knot_utm_bags knot_utm_core
                 CATKIN_DEPENDS message_runtime ${message_packages} ${node_packages} DEPENDS EIGEN3 ${installed_targets})
  set(KNOT_UTM_EXECUTABLE_DIR ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  if(KNOT_UTM_INSTALLS_SETUP)  # of a workspace rosrun finds it among the sources
    file(MAKE_DIRECTORY ${KNOT_UTM_EXECUTABLE_DIR})
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/python/knot_utm/panel/panel_node ${KNOT_UTM_EXECUTABLE_DIR}/panel_node SYMBOLIC)
  endif()
else()
  include(GNUInstallDirs)
  set(CATKIN_PACKAGE_BIN_DESTINATION lib/knot_utm)
  set(CATKIN_PACKAGE_LIB_DESTINATION ${CMAKE_INSTALL_LIBDIR})
  set(CATKIN_PACKAGE_PYTHON_DESTINATION lib/python3/dist-packages/knot_utm)
  set(CATKIN_PACKAGE_SHARE_DESTINATION share/knot_utm)
  set(KNOT_UTM_EXECUTABLE_DIR ${PROJECT_BINARY_DIR}/devel/lib/knot_utm)
endif()

# Executables find the package's libraries beside themselves, sourced environment or not.
set(CMAKE_INSTALL_RPATH "$ORIGIN/..")

# Everything but the tests.
add_custom_target(programs)
if(catkin_FOUND)
  add_dependencies(programs ${${PROJECT_NAME}_EXPORTED_TARGETS})
endif()

# One executable, with the flags of the package, where `rosrun` looks for it.
function(knot_utm_executable name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE knot_utm_core)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${KNOT_UTM_EXECUTABLE_DIR})
  add_dependencies(programs ${name})
  install(TARGETS ${name} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endfunction()
