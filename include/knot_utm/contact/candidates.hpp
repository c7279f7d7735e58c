#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// Which segments of the rod may touch which. Segment i, 1 <= i <= N-2, is the piece of centreline around node i, out
/// to the middles of the edges that meet there, as long as they now are. The list holds every pair closer than `reach`
/// with a margin, and stays valid until a node has moved half of it. A step may take nodes further: that no strand then
/// slips through unseen is StrandPassage's to say.
class Candidates {
 public:
  struct Run {
    int first;  ///< consecutive segments first..last
    int last;
  };

  /// `reach` is the distance of centrelines that must be found [m]; pairs closer than `exclusion` along the rod
  /// never count [m]. `extent` is how far a segment reaches out along the edges at its node: a half as a rule, 1 where
  /// it stands for the whole of them [-].
  Candidates(const RodProperties& rod, double reach, double margin, double exclusion, double extent = 0.5);

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

  /// From now on the rod has parted at an edge, and the two segments that reach into it touch nothing.
  void part(int edge);

  /// Where the list was built: the list follows from it.
  void state(Archive& archive);

 private:
  struct Entry {
    std::int64_t key;
    int segment;
  };

  static constexpr int kWhole = -2;  // no segment reaches into it

  bool reaches_into_parted(int segment) const { return segment == parted_ || segment == parted_ + 1; }
  void build(const Points& position);
  void measure(const Points& position);
  /// Entries of the cells next to a cell, it included, three cells in a row; until the entries change.
  using Rows = std::array<std::pair<const Entry*, const Entry*>, 9>;
  Rows rows_around(std::int64_t own) const;
  /// Whether the rod is drawn out so far that it cannot come back to itself.
  bool is_taut(const Points& position) const;

  double reach_, margin_, exclusion_, extent_;
  Eigen::VectorXd arclength_;  // of the nodes
  Eigen::VectorXd size_;       // of segment i about its node [m]
  Points built_at_;
  int parted_ = kWhole;  // edge
  std::vector<std::size_t> begin_;
  std::vector<Run> runs_;
  std::vector<int> segments_;
  std::vector<std::pair<int, int>> pairs_;
  std::vector<Entry> entries_;  // segments by their cell; like found_ kept for its memory
  std::vector<int> found_;
};

}  // namespace knot_utm
