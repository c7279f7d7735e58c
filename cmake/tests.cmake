enable_testing()
find_package(GTest REQUIRED)
include(GoogleTest)

# No test restores a specimen that another one has tied: ctest runs this file before any test.
file(WRITE ${PROJECT_BINARY_DIR}/without_cache.cmake "set(ENV{KNOT_UTM_NO_CACHE} 1)\n")
set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${PROJECT_BINARY_DIR}/without_cache.cmake)

# What the tests of the core are linked with.
set(tested_core knot_utm_core)
if(KNOT_UTM_SANITIZED_TESTS)
  set(tested_core knot_utm_core_sanitized)
endif()

# knot_utm_tests(NAME LABEL SOURCE...): an executable of GoogleTest and its tests, which carry a label for `ctest -L`. What they
# compute is in the library, and they themselves are compiled with little optimisation.
function(knot_utm_tests name label)
  add_executable(${name} ${ARGN})
  target_compile_options(${name} PRIVATE -O1)
  target_include_directories(${name} PRIVATE test)
  target_link_libraries(${name} PRIVATE yaml-cpp ZLIB::ZLIB GTest::gtest_main GTest::gmock)
  # To those files only that use them: what a file does not use need not compile it anew.
  foreach(source ${ARGN})
    file(STRINGS ${source} uses REGEX "KNOT_UTM_SOURCE_DIR|KNOT_UTM_TOOLS_DIR|run/command.hpp")
    if(uses)
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS
                   KNOT_UTM_SOURCE_DIR="${PROJECT_SOURCE_DIR}" KNOT_UTM_TOOLS_DIR="${KNOT_UTM_EXECUTABLE_DIR}")
    endif()
  endforeach()
  gtest_discover_tests(${name} NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT 1800 LABELS ${label} ${test_properties})
endfunction()

# The core's tests, one executable a room.
set(room_tests)
foreach(room ${core_rooms})
  file(GLOB sources CONFIGURE_DEPENDS test/${room}/*_test.cpp)
  if(sources)
    knot_utm_tests(test_${room} quick ${sources})
    target_link_libraries(test_${room} PRIVATE ${tested_core})
    list(APPEND room_tests test_${room})
  endif()
endforeach()
foreach(room method verdict run study) # some run the programs
  add_dependencies(test_${room} compare tensile_test)
endforeach()
add_custom_target(core_tests DEPENDS ${room_tests})

# What stands on lanes, for processors without AVX2.
if(KNOT_UTM_X86_64_V3)
  knot_utm_tests(narrow_lanes_tests quick test/numeric/lanes_test.cpp)
  target_compile_options(narrow_lanes_tests PRIVATE -mno-avx)
  target_link_libraries(narrow_lanes_tests PRIVATE Eigen3::Eigen knot_utm_compiler)
  target_include_directories(narrow_lanes_tests PRIVATE include)
endif()

# Counts what a step takes from the heap by a malloc of its own.
knot_utm_tests(allocation_test quick test/allocation/allocation_test.cpp)
target_link_libraries(allocation_test PRIVATE knot_utm_core)

# Symmetries on random scenes, on the core as it is installed: under sanitizers they take sixty times as long. The seed is
# fixed: the same scenes every time. For others, and more of them, run property_tests itself with RC_PARAMS="max_success=1000".
find_package(rapidcheck REQUIRED)
file(GLOB property_sources CONFIGURE_DEPENDS test/properties/*_test.cpp)
set(test_properties ENVIRONMENT "RC_PARAMS=seed=1 max_success=25")
knot_utm_tests(property_tests quick ${property_sources})
unset(test_properties)
target_link_libraries(property_tests PRIVATE knot_utm_core rapidcheck)

# Physics that takes long, on the core as it is installed.
file(GLOB validation_sources CONFIGURE_DEPENDS test/validation/*_test.cpp)
knot_utm_tests(validation_tests slow ${validation_sources})
target_link_libraries(validation_tests PRIVATE knot_utm_core)

# knot_utm_python_tests(LABEL FILE...): tests in Python, which go by the names of their files. They find the package and what
# they share without being told where these are. The limit is for a hang: a busy machine needs many times what an idle one does.
set(python_environment "KNOT_UTM_TOOLS_DIR=${KNOT_UTM_EXECUTABLE_DIR}"
                       "PYTHONPATH=${PROJECT_SOURCE_DIR}/python:${PROJECT_SOURCE_DIR}/test/python" PYTHONDONTWRITEBYTECODE=1)
function(knot_utm_python_tests label)
  foreach(file ${ARGN})
    get_filename_component(name ${file} NAME_WE)
    add_test(NAME ${name} COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/${file})
    set_tests_properties(${name} PROPERTIES TIMEOUT 3600 SKIP_RETURN_CODE 77 LABELS ${label}
                                            ENVIRONMENT "${python_environment}")
  endforeach()
endfunction()

# What scripts/bench makes of its runs, the scripts themselves, the
# documents against the code, and the panel beside the picture in rviz.
knot_utm_python_tests(quick bits_test.py rooms_test.py bench/bench_test.py bench/counted_work_test.py python/scripts/scripts_test.py doc/doc_test.py
                      raw/raw_test.py python/panel/panel_test.py)
# Studies and fits: their parts, what the scripts make of small ones, the same from Python, and as jobs on this machine and of Slurm.
# The report: what is made of a run, and what a browser and a printer make of that. README's numbers and lines, and the examples.
knot_utm_python_tests(launched python/sweep/design_test.py python/sweep/rank_test.py python/sweep/plots_test.py python/sweep/sweep_test.py
                      python/sweep/python_test.py python/sweep/workflow_test.py python/fit/fit_test.py
                      python/report/report_test.py python/report/batch_test.py python/report/browser_test.py
                      python/report/export_test.py python/scripts/material_test.py
                      python/scripts/knot_test.py doc/readme_test.py examples_test.py)
# The longest of them begin first.
set_tests_properties(browser_test sweep_test report_test workflow_test fit_test batch_test PROPERTIES COST 90)

# The recipe for a friction law in CONTRIBUTING.md, by following it.
knot_utm_python_tests(launched contributing/friction_law_test.py)
get_target_property(eigen_folder Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
set_tests_properties(friction_law_test PROPERTIES ENVIRONMENT "CXX=${CMAKE_CXX_COMPILER};KNOT_UTM_EIGEN=${eigen_folder}")

# The tutorial, from a clone on, which gets what stands in build/.
if(KNOT_UTM_EXECUTABLE_DIR STREQUAL "${PROJECT_SOURCE_DIR}/build/devel/lib/knot_utm")
  add_test(NAME tutorial_test COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/doc/tutorial_test.py)
  set_tests_properties(tutorial_test PROPERTIES TIMEOUT 3600 LABELS launched)
endif()

# In a workspace, installing is the workspace's own business.
if(NOT catkin_FOUND OR KNOT_UTM_INSTALLS_SETUP)
  add_test(NAME install_test COMMAND ${PROJECT_SOURCE_DIR}/test/install_test ${PROJECT_BINARY_DIR})
  add_test(NAME package_test COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/package_test.py ${PROJECT_BINARY_DIR})
  # Each writes its list of installed files to the same place.
  set_tests_properties(install_test package_test PROPERTIES RESOURCE_LOCK install_manifest LABELS launched)
endif()

if(catkin_FOUND)
  # Conversions, markers and bags need no master.
  file(GLOB ros_test_sources CONFIGURE_DEPENDS test/ros/*_test.cpp)
  knot_utm_tests(ros_tests quick ${ros_test_sources})
  target_link_libraries(ros_tests PRIVATE knot_utm_ros)
  add_dependencies(ros_tests tensile_test write_curve_bag)

  # The whole system, launched as a user does it: with the scripts, which take what stands in build/.
  set(launched_tests)
  if(CATKIN_DEVEL_PREFIX STREQUAL "${PROJECT_SOURCE_DIR}/build/devel")
    file(GLOB launched_tests CONFIGURE_DEPENDS test/ros/launched/*_test.py)
  endif()
  foreach(test ${launched_tests})
    get_filename_component(name ${test} NAME_WE)
    add_test(NAME ${name} COMMAND ${CATKIN_DEVEL_PREFIX}/env.sh ${PYTHON_EXECUTABLE} -B ${test})
    # One at a time, from the beginning: each is four processes already, which mostly wait for one another.
    set_tests_properties(${name} PROPERTIES TIMEOUT 3600 LABELS launched COST 100 RESOURCE_LOCK launched_system
                         ENVIRONMENT "PYTHONPATH=${PROJECT_SOURCE_DIR}/bench:${PROJECT_SOURCE_DIR}/test/ros")
  endforeach()
endif()

# Headers that all tests read. A compiler cache cannot look behind precompiled headers.
if(NOT CMAKE_CXX_COMPILER_LAUNCHER)
  knot_utm_precompile("${room_tests};validation_tests" <gmock/gmock.h> <gtest/gtest.h> <Eigen/Core> <Eigen/Geometry>
                      <functional> <string> <vector>)
  if(catkin_FOUND)
    target_precompile_headers(ros_tests PRIVATE <gmock/gmock.h> <gtest/gtest.h> <Eigen/Core> <ros/ros.h>)
  endif()
endif()
