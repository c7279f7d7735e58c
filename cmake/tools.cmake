# Every file of src/tools is one executable that needs no ROS master; with catkin they write bags too.
find_package(CLI11 REQUIRED)
file(GLOB tools CONFIGURE_DEPENDS src/tools/*.cpp)
if(NOT catkin_FOUND)
  list(FILTER tools EXCLUDE REGEX write_curve_bag)  # writes nothing but a bag
endif()
set_source_files_properties(src/tools/compare.cpp src/tools/tensile_test.cpp PROPERTIES
                            COMPILE_DEFINITIONS KNOT_UTM_PYTHON_DIR="${PROJECT_SOURCE_DIR}/python")
foreach(source ${tools})
  get_filename_component(name ${source} NAME_WE)
  knot_utm_executable(${name} ${source})
  target_link_libraries(${name} PRIVATE CLI11::CLI11)
  if(catkin_FOUND)
    target_link_libraries(${name} PRIVATE knot_utm_bags)
    target_compile_definitions(${name} PRIVATE KNOT_UTM_HAS_ROS)
  endif()
endforeach()

# Raw data of testing machines are read in Python.
file(MAKE_DIRECTORY ${KNOT_UTM_EXECUTABLE_DIR})
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/python/knot_utm/importing/import_instron.py
     ${KNOT_UTM_EXECUTABLE_DIR}/import_instron SYMBOLIC)
install(PROGRAMS python/knot_utm/importing/import_instron.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION}
        RENAME import_instron)
