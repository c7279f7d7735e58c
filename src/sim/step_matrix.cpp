#include "knot_utm/sim/step_matrix.hpp"

#include <algorithm>
#include <string>
#include <tuple>

namespace knot_utm {

namespace {

constexpr int kRoomNodes = 4;  // of the other strand: three of a segment, one that it may slide on to

}  // namespace

template <int D>
bool StepMatrix<D>::find(const std::vector<ContactPoint>& contacts) {
  located_.swap(before_);
  located_.clear();
  // Most contacts stand where they stood at the last look: both lists ascend, so one walk meets them.
  auto row = before_.cbegin();
  for (const ContactPoint& contact : contacts) {
    if (!contact.active()) continue;
    while (row != before_.cend() && row->a0 < contact.a0) ++row;
    auto same = row;
    while (same != before_.cend() && same->a0 == contact.a0 && same->b0 != contact.b0) ++same;
    if (same != before_.cend() && same->a0 == contact.a0) {
      located_.push_back(*same);
      continue;
    }
    located_.push_back({contact.a0, contact.b0, {}});
    if (!look_up(located_.back())) return false;
  }
  return true;
}

template <int D>
bool StepMatrix<D>::look_up(Located& contact) const {
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const std::pair<int, int> stored = pattern_.indices(contact.a0 + k, contact.b0 + l);
      if (stored.first < 0) return false;
      contact.blocks[static_cast<std::size_t>(3 * k + l)] = stored;
    }
  return true;
}

template <int D>
void StepMatrix<D>::find_rooms(const std::vector<ContactPoint>& contacts) {
  rebuilt_ = true;
  rooms_.clear();
  for (const ContactPoint& contact : contacts) {
    // Those that stay apart need no room; those about to touch soon would.
    if (!contact.active() && contact.overlap < 2.0 * contact.begins) continue;
    // A foot slides on the way it goes; one that does not, to the segment that it is nearer to.
    const double way = contact.slip.dot(contact.db);
    const bool backwards = way != 0.0 ? way < 0.0 : contact.c[3] < contact.c[5];
    const int first = contact.b0 - (backwards ? kRoomNodes - 3 : 0);
    rooms_.push_back({contact.a0, std::max(first, 0), std::min(first + kRoomNodes, nodes_) - 1});
  }
}

template <int D>
void StepMatrix<D>::build() {
  located_.clear();
  before_.clear();
  pairs_.clear();
  for (int i = 0; i + 1 < nodes_; ++i) pairs_.push_back({i, i + 1});
  for (int i = 0; i + 2 < nodes_; ++i) pairs_.push_back({i, i + 2});
  for (const Room& room : rooms_)
    for (int a = room.a; a <= room.a + 2; ++a)
      for (int b = room.first; b <= room.last; ++b)
        if (a != b) pairs_.push_back({a, b});
  pattern_.build(nodes_, pairs_);
  matrix_.set_pattern(pattern_);
  find_stencils();
  find_blocks_beyond_band();
}

template <int D>
void StepMatrix<D>::begin_step() {
  if (!rebuilt_) return;
  rebuilt_ = false;
  rooms_ = accepted_rooms_;
  build();
}

template <int D>
void StepMatrix<D>::commit() {
  if (!rebuilt_) return;
  rebuilt_ = false;
  accepted_rooms_ = rooms_;
}

template <int D>
void StepMatrix<D>::state(Archive& archive) {
  archive.section("ROOM");
  archive.list(accepted_rooms_);
  if (!archive.loads()) return;
  for (const Room& room : accepted_rooms_) {
    const bool there = room.a >= 0 && room.a < nodes_ - 2 && room.first >= 0 && room.last < nodes_ &&
                       room.first <= room.last && room.last - room.first < kRoomNodes;
    archive.require(there, "room for a contact at node", std::to_string(room.a));
  }
  rebuilt_ = true;
  begin_step();
}

template <int D>
void StepMatrix<D>::find_stencils() {
  stencils_.resize(static_cast<std::size_t>(nodes_));
  // What node i shares with the next one stands in both stencils.
  for (int i = nodes_ - 1; i >= 0; --i) {
    Stencil& here = stencils_[static_cast<std::size_t>(i)];
    here.fill(-1);
    here[0] = pattern_.diagonal(pattern_.position(i));
    if (i + 1 == nodes_) continue;
    const Stencil& next = stencils_[static_cast<std::size_t>(i) + 1];
    std::tie(here[1], here[3]) = pattern_.indices(i, i + 1);
    here[4] = next[0];
    if (i + 2 == nodes_) continue;
    std::tie(here[2], here[6]) = pattern_.indices(i, i + 2);
    here[5] = next[1];
    here[7] = next[3];
    here[8] = next[4];
  }
}

template <int D>
void StepMatrix<D>::find_blocks_beyond_band() {
  in_band_.assign(static_cast<std::size_t>(pattern_.blocks()), 0);
  for (const Stencil& stencil : stencils_)
    for (const int block : stencil)
      if (block >= 0) in_band_[static_cast<std::size_t>(block)] = 1;
  beyond_band_.clear();
  for (int block = 0; block < pattern_.blocks(); ++block)
    if (!in_band_[static_cast<std::size_t>(block)]) beyond_band_.push_back(block);
}

template <int D>
void StepMatrix<D>::set_zero_beyond_band() {
  for (const int index : beyond_band_) block(index).set_zero();
}

template <int D>
void StepMatrix<D>::add(const ContactPoint& contact, const ContactModel& model, std::size_t n) {
  // Kept here, as blocks written to might be a part of the model for all that is known of them.
  const Lanes still[3] = {model.still[0], model.still[1], model.still[2]};
  double c[6];
  std::copy_n(contact.c, 6, c);
  if (contact.on_roller()) {
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) {
        Block<D>& aa = band(contact.a0, k, l);
        for (int j = 0; j < 3; ++j) aa.column[j] += (c[k] * c[l]) * still[j];
      }
    return;
  }
  Lanes pushed[6];  // beta_k g - c_k gamma
  Lanes du[6];      // du/dq_l
  const Lanes du_s = contact.inverse_g * to_lanes(contact.db), du_r = contact.inverse_g * to_lanes(contact.x);
  for (int k = 0; k < 6; ++k) {
    pushed[k] = contact.beta[k] * model.force - c[k] * model.slide;
    du[k] = c[k] * du_s + contact.beta[k] * du_r;
  }
  const auto add_pair = [&](Block<D>& block, int k, int l) {
    const double both = c[k] * c[l];
    for (int j = 0; j < 3; ++j) block.column[j] += both * still[j] + pushed[k] * du[l][j];
  };
  const ContactBlocks& blocks = contact_blocks(n);
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const std::pair<int, int>& across = blocks[static_cast<std::size_t>(3 * k + l)];
      add_pair(band(contact.a0, k, l), k, l);
      add_pair(block(across.first), k, 3 + l);
      add_pair(block(across.second), 3 + l, k);
      add_pair(band(contact.b0, k, l), 3 + k, 3 + l);
    }
}

template <int D>
void StepMatrix<D>::add(const ContactPoint& contact, const EdgeContactModel& model, std::size_t n) {
  const ContactBlocks& blocks = contact_blocks(n);
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const std::pair<int, int>& across = blocks[static_cast<std::size_t>(3 * k + l)];
      knot_utm::add(band(contact.a0, k, l), model.stiffness(k, l), 1.0);
      knot_utm::add(band(contact.b0, k, l), model.stiffness(3 + k, 3 + l), 1.0);
      knot_utm::add(block(across.first), model.stiffness(k, 3 + l), 1.0);
      knot_utm::add(block(across.second), model.stiffness(3 + l, k), 1.0);
    }
}

template class StepMatrix<3>;
template class StepMatrix<4>;

}  // namespace knot_utm
