#pragma once

#include <sys/types.h>

#include <string>

namespace knot_utm {

/// A process that recovers the recorder's folder if the recorder is killed. It sleeps as long as the recorder lives. If
/// the recorder ends while its folder is neither complete nor released, the keeper recovers the folder and ends. It has
/// a session of its own, so that signals to the recorder's process group do not reach it.
class Keeper {
 public:
  /// Starts the executable `keeper`, which stands beside the running one. Throws std::runtime_error where that cannot
  /// be done.
  Keeper();
  ~Keeper();  ///< waits until the process has ended
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;
  Keeper(Keeper&&) = delete;
  Keeper& operator=(Keeper&&) = delete;

  /// Registers the folder that is to be recovered from now on. False where the keeper has died.
  bool watch(const std::string& folder);
  bool release();  ///< from now on nothing is to be recovered

 private:
  bool tell(const std::string& folder);

  int socket_ = -1;
  pid_t process_ = -1;
};

/// The main function of the keeper. The recorder sends it messages through the socket that is its standard input.
/// Returns the exit code.
int keep();

}  // namespace knot_utm
