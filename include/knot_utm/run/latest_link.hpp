#pragma once

#include <string>

namespace knot_utm {

/// Makes the link `out/latest` lead to the folder of a run that stands in a folder called `out`, such as `out/tighten`
/// or `out/tighten-2`, so that a command that reads `out/latest` reads the run that was written last. Returns the path
/// of the link. Returns an empty text, and makes no link, where the run stands elsewhere, where something that is no
/// link has that name, or where the file system has no links.
std::string point_latest_to(const std::string& folder);

}  // namespace knot_utm
