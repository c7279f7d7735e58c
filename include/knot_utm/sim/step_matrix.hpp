#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/contact/surface_contact.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/half_turn.hpp"
#include "knot_utm/solver/block_matrix.hpp"

namespace knot_utm {

/// Adds a 3 x 3 matrix to the positions' part of a block.
template <int D>
inline void add(Block<D>& block, const Mat3& m, double times) {
  for (int j = 0; j < 3; ++j) block.column[j] += times * Lanes{m(0, j), m(1, j), m(2, j), 0.0};
}

/// The matrix of a time step's linear system, and where its blocks are stored: those of the rod, (i, i) to (i, i+2),
/// and those between strands in contact. Its pattern has room for contacts that are about to come, between strands at
/// most twice as far apart as where the normal law begins, and for every foot to slide on by a segment. It is rebuilt
/// when a contact leaves it. With more room it would be rebuilt less often, but every factorisation would take longer.
/// The order of elimination, and so the rounding, follows from the pattern. A step that was not accepted therefore
/// leaves the pattern as it was.
template <int D>
class StepMatrix {
 public:
  /// Stored indices of blocks (i + k, i + l), k, l < 3, as [3 k + l]; -1 beyond the rod's end.
  using Stencil = std::array<int, 9>;
  /// Stored indices of blocks (a0 + k, b0 + l) and their mirrors (b0 + l, a0 + k), as [3 k + l].
  using ContactBlocks = std::array<std::pair<int, int>, 9>;

  /// Of a whole rod, or of the half of one that is its own `image` (HalfRod).
  explicit StepMatrix(int nodes, const HalfTurn* image = nullptr) : nodes_(nodes), image_(image) {
    clear_rooms();
    build();
  }

  /// Begins a step: the pattern is that of the last accepted one.
  void begin();
  /// The step was accepted.
  void commit() { rebuilt_ = false; }

  /// Saves or loads the room of the pattern, as the last accepted step left it.
  void state(Archive& archive);

  /// Finds the blocks of every active contact; `contacts` as ContactPoint says, ascending in a0. `values()` then has
  /// these blocks, with undefined values.
  void locate(const std::vector<ContactPoint>& contacts) {
    if (find(contacts)) return;
    find_rooms(contacts);
    build();
    find(contacts);
  }

  /// Zeros all blocks except those of the stencils, which CentrelineTerms::add_stiffness overwrites.
  void set_zero_beyond_band();

  /// Of half a rod: the nodes behind the half move as the images that they are.
  void tie(std::vector<Lanes>& right);

  BlockMatrix<D>& values() { return matrix_; }
  Block<D>& block(int stored_index) { return matrix_.block(stored_index); }
  /// Block (first + k, first + l), k, l < 3.
  Block<D>& band(int first, int k, int l) { return block(stencil(first)[static_cast<std::size_t>(3 * k + l)]); }
  const Stencil& stencil(int node) const { return present_.stencils[static_cast<std::size_t>(node)]; }
  /// The blocks of the n-th active contact.
  const ContactBlocks& contact_blocks(std::size_t n) const { return present_.located[n].blocks; }

  /// Adds the stiffness of a contact, between strands the n-th active one.
  void add(const ContactPoint& contact, const ContactModel& model, std::size_t n);
  /// The same with friction at the surfaces; `turns` as the contact was evaluated with.
  void add(const ContactPoint& contact, const SurfacePoint& surface, const SurfaceModel& model,
           const SectionTurns& turns, std::size_t n);

 private:
  struct Located {
    int a0, b0;
    ContactBlocks blocks;
  };
  /// Room for a contact of nodes a to a + 2 with any of the nodes `first` to `last`.
  struct Room {
    int a, first, last;
    void state(Archive& archive) { archive(a, first, last); }
  };
  /// The room of a pattern, and all that follows from it.
  struct Pattern {
    std::vector<Room> rooms;
    BlockPattern blocks;
    std::vector<Stencil> stencils;
    std::vector<int> beyond_band;  // stored indices of blocks that are in no stencil
    std::vector<Located> located;  // active contacts, ascending in a0
  };
  /// Rooms sorted by one of their nodes, the key.
  struct SortedRooms {
    std::vector<Room> rooms;
    std::vector<int> begin, filled;  // key -> first of rooms

    void sort(const std::vector<Room>& of, int Room::*key, int nodes);
    /// Calls visit(room) for all that have a key of `first` to `last`.
    template <typename Visit>
    void visit(int first, int last, Visit visit) const {
      const int end = begin[static_cast<std::size_t>(last) + 1];
      for (int n = begin[static_cast<std::size_t>(std::max(first, 0))]; n < end; ++n)
        visit(rooms[static_cast<std::size_t>(n)]);
    }
  };

  /// Blocks (k, l) of a contact's nodes a0..a0+2 and b0..b0+2.
  using Places = std::array<std::array<Block<D>*, 6>, 6>;

  void clear_rooms();
  /// Whether strand b lies on the other half. Its image then stands for it, whose nodes run the other way.
  bool mirrored(const ContactPoint& contact) const { return image_ && contact.b0 + 1 >= image_->half(); }
  int b_of(const ContactPoint& contact) const {
    return mirrored(contact) ? image_->nodes - 3 - contact.b0 : contact.b0;
  }
  /// Whether its stiffness is gathered first and then folded onto the half: one with the other half, or near the
  /// middle.
  bool is_gathered(const ContactPoint& contact) const {
    return image_ && !contact.on_roller() && std::max(contact.a0, contact.b0) + 2 >= image_->nodes - image_->half();
  }
  Places stored(const ContactPoint& contact, std::size_t n);
  Places places(const ContactPoint& contact, std::size_t n);  ///< where to add its stiffness
  void fold(const ContactPoint& contact, std::size_t n);
  void turn_columns(Block<D>* row) const;

  /// Adds the change of a spin's lever with the length of its edge.
  void add_lengthening(const Places& to, int strand, int first, const double* weights, double torque,
                       const SectionTurns& turns);
  /// `kStrands`: between strands, where a foot slides as the contact moves; else on a roller.
  template <bool kStrands>
  void add_columns(const ContactPoint& contact, const SurfacePoint& surface, const SurfaceModel& model,
                   const SectionTurns& turns, const Places& to);
  bool find(const std::vector<ContactPoint>& contacts);
  bool look_up(Located& contact) const;
  void find_rooms(const std::vector<ContactPoint>& contacts);
  void build();
  void find_neighbours();
  void find_stencils();  // and the blocks beyond the band

  int nodes_;
  const HalfTurn* image_;
  Pattern present_, accepted_;  // accepted_: of the last accepted step, where the pattern was rebuilt since
  BlockMatrix<D> matrix_;
  std::vector<Located> before_;  // what Pattern::located was at the last look
  SortedRooms by_a_, by_first_;
  SortingSet row_;
  Neighbours neighbours_;
  std::array<Block<D>, 36> gathered_;
  bool rebuilt_ = false;  // since the last accepted step
};

extern template class StepMatrix<3>;
extern template class StepMatrix<4>;

}  // namespace knot_utm
