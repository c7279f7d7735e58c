# Executables are installed where they are made (knot_utm_executable).
if(catkin_FOUND)
  install(TARGETS knot_utm_bags knot_utm_ros
          ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
          LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
  if(KNOT_UTM_INSTALLS_SETUP)
    set(setup ${PROJECT_BINARY_DIR}/catkin_generated/installspace)
    # catkin writes _setup_util.py to installspace only where it installs the file itself; that of devel is the same.
    install(PROGRAMS ${CATKIN_DEVEL_PREFIX}/_setup_util.py ${setup}/env.sh DESTINATION .)
    foreach(shell bash sh zsh)
      install(FILES ${setup}/setup.${shell} ${setup}/local_setup.${shell} DESTINATION .)
    endforeach()
    install(CODE "file(TOUCH \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/.catkin\")")
  endif()
  install(DIRECTORY launch DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION} USE_SOURCE_PERMISSIONS
          PATTERN "__pycache__" EXCLUDE)
endif()

# For find_package(knot_utm) of others: knot_utm::knot_utm, and the headers that are meant for them.
set_target_properties(knot_utm_core PROPERTIES EXPORT_NAME knot_utm)
set_target_properties(knot_utm_compiler PROPERTIES EXPORT_NAME compiler)
install(TARGETS knot_utm_core knot_utm_compiler EXPORT knot_utm-targets
        ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
        LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
install(EXPORT knot_utm-targets NAMESPACE knot_utm:: DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/cmake)
if(NOT catkin_FOUND)
  include(CMakePackageConfigHelpers)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/knot_utm-config-version.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/knot_utm-config-version.cmake
          DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/cmake)
  install(FILES cmake/knot_utm-config.cmake.installspace.in DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/cmake
          RENAME knot_utm-config.cmake)
endif()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS cmake/public_headers.txt)
file(STRINGS cmake/public_headers.txt public_headers REGEX "^[^#]")
foreach(header ${public_headers})
  get_filename_component(room ${header} DIRECTORY)
  install(FILES include/knot_utm/${header} DESTINATION include/knot_utm/${room})
endforeach()
install(DIRECTORY config DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
if(catkin_FOUND)
  install(PROGRAMS python/knot_utm/panel/panel_node DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endif()
install(DIRECTORY python/knot_utm/ DESTINATION ${CATKIN_PACKAGE_PYTHON_DESTINATION} FILES_MATCHING PATTERN "*.py"
        PATTERN "*.j2" PATTERN "*.js" PATTERN "*.csv" PATTERN "__pycache__" EXCLUDE PATTERN "workflow" EXCLUDE)
