#pragma once

#include <sys/types.h>

#include <string>

namespace knot_utm {

/// A process beside the recorder that outlives its violent end. As long as the recorder lives it sleeps; where the
/// recorder ends with a folder that is neither complete nor given up it recovers that folder and ends. It has a session
/// of its own, so that what is sent to the recorder's process group does not reach it.
class Keeper {
 public:
  /// Starts the executable `keeper` beside this one. Throws std::runtime_error where that cannot be done.
  Keeper();
  ~Keeper();  ///< waits for its end
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;
  Keeper(Keeper&&) = delete;
  Keeper& operator=(Keeper&&) = delete;

  /// From now on this folder is to be recovered; false where the keeper is gone.
  bool watch(const std::string& folder);
  bool release();  ///< nothing is to be recovered

 private:
  bool tell(const std::string& folder);

  int socket_ = -1;
  pid_t process_ = -1;
};

/// What the keeper does, told by the recorder through the socket that is its standard input. Returns its exit code.
int keep();

}  // namespace knot_utm
