#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include "knot_utm/method/knot_sheet.hpp"
#include "knot_utm/run/run_folder.hpp"

namespace knot_utm {

/// Prints what is known of a knot before it is pulled, and writes its picture, KNOT.svg, into a folder. Throws
/// InvalidInput where there is no such knot, where it cannot be drawn, or where the picture exists and `overwrite` does
/// not allow to replace it. `option`: what names the knot, for messages.
inline void draw_knot(const std::string& knot, const char* option, const std::string& folder, bool overwrite) {
  const KnotSheet sheet = knot_sheet(knot, option);
  const std::string file = (std::filesystem::path(folder) / (sheet.name + ".svg")).string();
  require_new_file(option, file, {knot}, overwrite, "<svg");
  if (!folder.empty()) make_run_folder(folder);
  write_whole(file, sheet.picture);
  std::printf("%spicture: %s\n", sheet.facts.c_str(), file.c_str());
}

}  // namespace knot_utm
