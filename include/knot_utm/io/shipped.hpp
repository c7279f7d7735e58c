#pragma once

#include <string>
#include <vector>

namespace knot_utm {

/// The folders that may hold what comes with the package, as config/ of the sources does: first that of the
/// installation which the running executable belongs to, then that of the sources it was built from.
std::vector<std::string> shipped_folders();

/// The file that is meant by `method`: a path, seen from the folder `base`, or the name of a method of the `shipped`
/// folders, with or without its ending. A path of no file is given back, for whoever reads it to complain of. Throws
/// InvalidInput (key "method"), which names the shipped methods, where a name is none of theirs.
std::string find_method(const std::string& method, const std::string& base = "",
                        const std::vector<std::string>& shipped = shipped_folders());

}  // namespace knot_utm
