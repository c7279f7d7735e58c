#pragma once

#include <dynamic_reconfigure/server.h>
#include <knot_utm/ViewConfig.h>

#include <functional>
#include <optional>

#include "knot_utm/ros/markers.hpp"

namespace knot_utm {

/// The parameters ~marker_rate, ~color_by and ~contact_forces of a node that draws pictures. They can be changed by
/// dynamic_reconfigure while the node runs. Where a value is not allowed all of them stay as they were, which the
/// client is told, and a line says what is allowed.
class ViewParameters {
 public:
  /// `on_change` receives the wall time between two pictures [s], at once and whenever a parameter has changed. Throws
  /// InvalidInput where a parameter has a value that is not allowed.
  ViewParameters(ScenePicture& picture, std::function<void(double)> on_change);

 private:
  void take(ViewConfig& wanted);

  ScenePicture& picture_;
  std::function<void(double)> on_change_;
  std::optional<ViewConfig> now_;
  dynamic_reconfigure::Server<ViewConfig> server_;
};

}  // namespace knot_utm
