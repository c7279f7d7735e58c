#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// Which segments of the rod may touch which. Segment i, 1 <= i <= N-2, is the piece of centreline around node i.
/// The list holds every pair closer than `reach` with a margin, and stays valid until a node has moved half of it.
class Candidates {
 public:
  struct Run {
    int first;  ///< consecutive segments first..last
    int last;
  };

  /// `reach` is the distance of centrelines that must be found [m]; pairs closer than `exclusion` along the rod
  /// never count [m].
  Candidates(const RodProperties& rod, double reach, double margin, double exclusion);

  /// Rebuilds the list where something moved far enough; true if it did.
  bool refresh(const Points& position);

  /// Neighbours of segment i as runs of consecutive segments.
  const Run* begin(int segment) const { return runs_.data() + begin_[static_cast<std::size_t>(segment)]; }
  const Run* end(int segment) const { return runs_.data() + begin_[static_cast<std::size_t>(segment) + 1]; }

  /// Segments that have neighbours, ascending.
  const std::vector<int>& segments() const { return segments_; }
  /// Pairs i < j.
  const std::vector<std::pair<int, int>>& pairs() const { return pairs_; }

  double exclusion() const { return exclusion_; }

  /// Where the list was built: the list follows from it.
  void state(Archive& archive);

 private:
  struct Entry {
    std::int64_t key;
    int segment;
  };

  void build(const Points& position);
  /// Whether the rod is drawn out so far that it cannot come back to itself.
  bool is_taut(const Points& position) const;

  double reach_, margin_, exclusion_;
  Eigen::VectorXd arclength_;  // of the nodes
  Eigen::VectorXd half_size_;  // of segment i about its node
  Points built_at_;
  std::vector<std::size_t> begin_;
  std::vector<Run> runs_;
  std::vector<int> segments_;
  std::vector<std::pair<int, int>> pairs_;
  std::vector<Entry> entries_;  // segments by their cell; like found_ kept for its memory
  std::vector<int> found_;
};

}  // namespace knot_utm
