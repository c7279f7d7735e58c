# Every file of src/tools is one executable that needs no ROS master; with catkin they write bags too.
find_package(CLI11 REQUIRED)
file(GLOB tools CONFIGURE_DEPENDS src/tools/*.cpp)
if(NOT catkin_FOUND)
  list(FILTER tools EXCLUDE REGEX import_instron)  # writes nothing but a bag
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
