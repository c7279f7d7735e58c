// A method's text, and the --set of a command line: whatever follows a line "--set" is one override a line.
#include <vector>

#include "fuzz/target.hpp"
#include "knot_utm/io/method.hpp"

namespace knot_utm {

void fuzz(const std::string& text) {
  const std::string mark = "\n--set\n";
  const std::size_t end = text.find(mark);
  std::vector<std::string> overrides;
  for (std::size_t from = end; from != std::string::npos && overrides.size() < 16;) {
    from += from == end ? mark.size() : 1;
    const std::size_t to = text.find('\n', from);
    overrides.push_back(text.substr(from, to == std::string::npos ? to : to - from));
    from = to;
  }
  const Method method = parse_method(text.substr(0, end), "fuzz.yaml", overrides);
  check_method(method);

  // What was understood can be written, and means the same when read again.
  const std::string written = method_yaml(method);
  try {
    promise(method_yaml(parse_method(written, "fuzz.yaml")) == written, "a resolved method reads back to the same");
  } catch (const InvalidInput& refused) {
    std::fprintf(stderr, "%s\n%s", refused.what(), written.c_str());
    promise(false, "a resolved method is one that can be read");
  }
}

}  // namespace knot_utm
