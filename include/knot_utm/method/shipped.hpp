#pragma once

#include <string>
#include <vector>

namespace knot_utm {

/// The folders in which files that come with the package are looked for, with the layout of config/. The first belongs
/// to the installation of the running executable, and the second to the sources from which it was built.
std::vector<std::string> shipped_folders();

/// The file to which `method` refers: a path, relative to the folder `base`, or the name of a method in one of the
/// `shipped` folders or in its `standards/`, with or without its extension. A path to which no file belongs is returned
/// as it is; reading it then reports the error. Throws InvalidInput (key "method"), which lists the shipped methods,
/// where a name is not one of them.
std::string find_method(const std::string& method, const std::string& base = "",
                        const std::vector<std::string>& shipped = shipped_folders());

/// What comes with the package of a kind (methods, materials, knots, standards or studies): a line for each, with its
/// name and what it is. All kinds where `kind` is empty. Throws InvalidInput (key "--list") for any other word.
std::string shipped_listing(const std::string& kind, const std::vector<std::string>& shipped = shipped_folders());

}  // namespace knot_utm
