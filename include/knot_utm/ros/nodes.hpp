#pragma once

namespace knot_utm {

/// The main functions of the nodes (run_node). Each returns the exit code of its process.
int run_utm_node(int argc, char** argv);       ///< the machine
int run_knot_node(int argc, char** argv);      ///< the physics
int run_recorder_node(int argc, char** argv);  ///< writes what a test measures

}  // namespace knot_utm
