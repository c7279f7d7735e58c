#include "knot_utm/ros/view_parameters.hpp"

#include <ros/node_handle.h>

#include <cmath>
#include <string>
#include <utility>

#include "knot_utm/io/number.hpp"
#include "knot_utm/rod/invalid_input.hpp"
#include "knot_utm/ros/test_setup.hpp"

namespace knot_utm {
namespace {

bool is_coloring(const std::string& word) { return word == View_tension || word == View_curvature; }

/// Before the server takes them, which would change without a word what it cannot use.
ros::NodeHandle with_checked_parameters() {
  const ros::NodeHandle own("~");
  const ViewConfig& least = ViewConfig::__getMin__();
  const ViewConfig& most = ViewConfig::__getMax__();
  ViewConfig set = ViewConfig::__getDefault__();
  const std::string rates = format_number(least.marker_rate) + " to " + format_number(most.marker_rate);
  read_parameter(own, "marker_rate", &set.marker_rate, rates.c_str());
  if (!(set.marker_rate >= least.marker_rate && set.marker_rate <= most.marker_rate))
    throw InvalidInput(own.resolveName("marker_rate"), format_number(set.marker_rate), rates);
  const char* colorings = "tension or curvature";
  read_parameter(own, "color_by", &set.color_by, colorings);
  if (!is_coloring(set.color_by))
    throw InvalidInput(own.resolveName("color_by"), "\"" + set.color_by + "\"", colorings);
  read_parameter(own, "contact_forces", &set.contact_forces, "true or false");
  return own;
}

}  // namespace

ViewParameters::ViewParameters(ScenePicture& picture, std::function<void(double)> on_change)
    : picture_(picture),
      on_change_(std::move(on_change)),
      now_(ViewConfig::__getDefault__()),
      server_(with_checked_parameters()) {
  server_.setCallback([this](ViewConfig& wanted, std::uint32_t) { take(wanted); });
}

void ViewParameters::take(ViewConfig& wanted) {
  if (std::isnan(wanted.marker_rate)) wanted.marker_rate = now_.marker_rate;
  if (!is_coloring(wanted.color_by)) wanted.color_by = now_.color_by;
  now_ = wanted;
  picture_.color_by(now_.color_by == View_tension ? ColorBy::kTension : ColorBy::kCurvature);
  picture_.show_contacts(now_.contact_forces);
  on_change_(1.0 / now_.marker_rate);
}

}  // namespace knot_utm
