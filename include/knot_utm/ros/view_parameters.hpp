#pragma once

#include <dynamic_reconfigure/server.h>
#include <knot_utm/ViewConfig.h>

#include <functional>

#include "knot_utm/ros/markers.hpp"

namespace knot_utm {

/// What a node's own parameters ~marker_rate, ~color_by and ~contact_forces say of its picture, also while it runs, by
/// dynamic_reconfigure. A value that is not allowed is refused: the one before stays, whoever asked gets it, and a line
/// says what is allowed.
class ViewParameters {
 public:
  /// `on_change` gets the wall time between two pictures [s], now and whenever a parameter has changed. Throws
  /// InvalidInput where a parameter is not what it may be.
  ViewParameters(ScenePicture& picture, std::function<void(double)> on_change);

 private:
  void take(ViewConfig& wanted);

  ScenePicture& picture_;
  std::function<void(double)> on_change_;
  ViewConfig now_;
  dynamic_reconfigure::Server<ViewConfig> server_;
};

}  // namespace knot_utm
