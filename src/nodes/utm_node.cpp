#include "knot_utm/ros/process.hpp"

int main(int argc, char** argv) { return knot_utm::run_utm_node(argc, argv); }
