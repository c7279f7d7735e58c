#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace knot_utm {

/// What a command answered.
struct Answer {
  int code = -1;     ///< it ended with; -1: it did not end by itself
  std::string text;  ///< all that it said, errors too
};

/// Runs a line of the shell, where no program has a cache unless the line says so.
inline Answer answer_of(const std::string& line) {
  Answer out;
  setenv("KNOT_UTM_NO_CACHE", "1", 1);
  FILE* pipe = popen((line + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return out;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) out.text += static_cast<char>(c);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) out.code = WEXITSTATUS(status);
  return out;
}

/// One of the package's commands, and its arguments.
inline std::string tool(const std::string& name, const std::string& arguments) {
  return "'" + std::string(KNOT_UTM_TOOLS_DIR) + "/" + name + "' " + arguments;
}

}  // namespace knot_utm
