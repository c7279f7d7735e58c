#pragma once

#include <algorithm>

namespace knot_utm {

/// Which subscribers lack the last message. ROS says who came in the order of their coming, but maybe only after a
/// message that was published meanwhile has reached them.
class Latecomers {
 public:
  /// A message was published to so many subscribers.
  void published(int subscribers) { early_ = std::max(subscribers - known_, 0); }

  /// A subscriber came. Returns whether it lacks the last message.
  bool came() {
    ++known_;
    if (early_ == 0) return true;
    --early_;
    return false;
  }

  /// A subscriber went.
  void gone() { --known_; }

 private:
  int known_ = 0;  ///< number of subscribers whose coming was said
  int early_ = 0;  ///< number of those who have the last message, and whose coming was not said yet
};

}  // namespace knot_utm
