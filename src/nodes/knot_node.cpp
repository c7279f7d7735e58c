#include "knot_utm/ros/process.hpp"

int main(int argc, char** argv) { return knot_utm::run_knot_node(argc, argv); }
