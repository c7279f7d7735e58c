# Executables are installed where they are made (knot_utm_executable).
set(libraries knot_utm_core)
if(catkin_FOUND)
  list(APPEND libraries knot_utm_bags knot_utm_ros)
  if(KNOT_UTM_INSTALLS_SETUP)
    set(setup ${PROJECT_BINARY_DIR}/catkin_generated/installspace)
    # catkin writes _setup_util.py to installspace only where it installs the file itself; that of devel is the same.
    install(PROGRAMS ${CATKIN_DEVEL_PREFIX}/_setup_util.py ${setup}/env.sh DESTINATION .)
    foreach(shell bash sh zsh)
      install(FILES ${setup}/setup.${shell} ${setup}/local_setup.${shell} DESTINATION .)
    endforeach()
    install(CODE "file(TOUCH \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/.catkin\")")
  endif()
  install(DIRECTORY launch DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION} FILES_MATCHING PATTERN "*.launch")
endif()
install(TARGETS ${libraries}
        ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
        LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
install(DIRECTORY include/knot_utm DESTINATION include FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY config DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
# roslaunch and rosrun look for panel_node here, too.
if(catkin_FOUND)
  install(DIRECTORY panel DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION} USE_SOURCE_PERMISSIONS
          PATTERN "__pycache__" EXCLUDE)
endif()
install(DIRECTORY report DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION} FILES_MATCHING PATTERN "*.py" PATTERN "*.j2"
        PATTERN "__pycache__" EXCLUDE)
