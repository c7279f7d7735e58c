#include "knot_utm/sim/step_matrix.hpp"

#include <string>

#include "knot_utm/numeric/index.hpp"
#include "knot_utm/sim/force_term.hpp"
#include "surface_columns.hpp"

namespace knot_utm {
namespace {

constexpr int kRoomNodes = 4;  // of the other strand: three of a segment, one that it may slide on to

}  // namespace

template <int D>
bool StepMatrix<D>::find(const std::vector<ContactPoint>& contacts) {
  std::vector<Located>& located = present_.located;
  located.swap(before_);
  located.clear();
  // Most contacts stand where they stood at the last look: both lists ascend, so one walk meets them.
  auto row = before_.cbegin();
  for (const ContactPoint& contact : contacts) {
    if (!contact.active()) continue;
    const int b0 = b_of(contact);
    while (row != before_.cend() && row->a0 < contact.a0) ++row;
    auto same = row;
    while (same != before_.cend() && same->a0 == contact.a0 && same->b0 != b0) ++same;
    if (same != before_.cend() && same->a0 == contact.a0) {
      located.push_back(*same);
      continue;
    }
    Located found = {contact.a0, b0, {}};
    // The segment's points that come one after the other are often between the same nodes.
    if (!located.empty() && located.back().a0 == found.a0 && located.back().b0 == found.b0) {
      found = located.back();
    } else if (!look_up(found)) {
      located.swap(before_);  // of use once more where the step is rejected
      return false;
    }
    located.push_back(found);
  }
  return true;
}

template <int D>
bool StepMatrix<D>::look_up(Located& contact) const {
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const std::pair<int, int> stored = present_.blocks.indices(contact.a0 + k, contact.b0 + l);
      if (stored.first < 0) return false;
      contact.blocks[at(3 * k + l)] = stored;
    }
  return true;
}

template <int D>
void StepMatrix<D>::find_rooms(const std::vector<ContactPoint>& contacts) {
  if (!rebuilt_) std::swap(present_, accepted_);
  rebuilt_ = true;
  clear_rooms();
  for (const ContactPoint& contact : contacts) {
    // Those that stay apart need no room; those about to touch soon would.
    if (!contact.active() && contact.overlap < 2.0 * contact.begins) continue;
    // A foot goes on as it slides; one that does not slide, to the segment that it is nearer to.
    const double slip = contact.slip.dot(contact.db);
    const bool backwards = (slip != 0.0 ? slip < 0.0 : contact.c[3] < contact.c[5]) != mirrored(contact);
    const int first = b_of(contact) - (backwards ? kRoomNodes - 3 : 0);
    present_.rooms.push_back({contact.a0, std::max(first, 0), std::min(first + kRoomNodes, nodes_) - 1});
  }
}

template <int D>
void StepMatrix<D>::build() {
  find_neighbours();
  present_.blocks.build(neighbours_);
  present_.located.clear();
  find_stencils();
  matrix_.set_pattern(present_.blocks);
}

template <int D>
void StepMatrix<D>::SortedRooms::sort(const std::vector<Room>& of, int Room::*key, int nodes) {
  begin.assign(at(nodes) + 1, 0);
  for (const Room& room : of) ++begin[at(room.*key) + 1];
  for (int i = 0; i < nodes; ++i) begin[at(i) + 1] += begin[at(i)];
  rooms.resize(of.size());
  filled.assign(begin.begin(), begin.end() - 1);
  for (const Room& room : of) rooms[at(filled[at(room.*key)]++)] = room;
}

template <int D>
void StepMatrix<D>::find_neighbours() {
  // Row i has the runs of the rooms that begin at node a = i - 2 to i and, mirrored, nodes a to a + 2 of the rooms
  // whose run it stands in. Put together row by row, it is sorted at once, and what rooms share costs nothing.
  by_a_.sort(present_.rooms, &Room::a, nodes_);
  by_first_.sort(present_.rooms, &Room::first, nodes_);
  neighbours_.begin.assign(1, 0);
  neighbours_.list.clear();
  row_.reset(nodes_);
  for (int i = 0; i < nodes_; ++i) {
    row_.insert_run(std::max(i - 2, 0), std::min(i + 2, nodes_ - 1));
    by_a_.visit(i - 2, i, [&](const Room& room) { row_.insert_run(room.first, room.last); });
    by_first_.visit(i - kRoomNodes + 1, i, [&](const Room& room) {
      if (room.last >= i) row_.insert_run(room.a, room.a + 2);
    });
    row_.erase(i);
    row_.take(neighbours_.list);
    neighbours_.begin.push_back(static_cast<int>(neighbours_.list.size()));
  }
}

template <int D>
void StepMatrix<D>::begin() {
  if (!rebuilt_) return;
  rebuilt_ = false;
  std::swap(present_, accepted_);
  matrix_.set_pattern(present_.blocks);
}

template <int D>
void StepMatrix<D>::state(Archive& archive) {
  archive.section("ROOM");
  begin();  // what has been tried since then does not count
  archive.list(present_.rooms);
  if (!archive.loads()) return;
  for (const Room& room : present_.rooms) {
    const bool there = room.a >= 0 && room.a < nodes_ - 2 && room.first >= 0 && room.last < nodes_ &&
                       room.first <= room.last && room.last - room.first < kRoomNodes;
    archive.require(there, "room for a contact at node", std::to_string(room.a));
  }
  build();
}

template <int D>
void StepMatrix<D>::find_stencils() {
  const BlockPattern& blocks = present_.blocks;
  std::vector<Stencil>& stencils = present_.stencils;
  Stencil none;
  none.fill(-1);
  stencils.assign(at(nodes_), none);
  present_.beyond_band.clear();
  for (int k = 0; k < nodes_; ++k) {
    const int i = blocks.node(k), diagonal = blocks.diagonal(k);
    stencils[at(i)][0] = diagonal;
    for (int a = 0; a < blocks.below(k); ++a) {
      const int j = blocks.node(blocks.rows(k)[a]), lower = diagonal + 1 + 2 * a, upper = lower + 1;
      const int apart = std::abs(j - i);
      if (apart > 2) {
        present_.beyond_band.push_back(lower);
        present_.beyond_band.push_back(upper);
        continue;
      }
      Stencil& first = stencils[at(std::min(i, j))];
      first[at(apart)] = i < j ? upper : lower;
      first[at(3 * apart)] = i < j ? lower : upper;
    }
  }
  // What node i shares with the next one stands in both stencils.
  for (int i = nodes_ - 2; i >= 0; --i) {
    Stencil& here = stencils[at(i)];
    const Stencil& next = stencils[at(i) + 1];
    here[4] = next[0];
    here[5] = next[1];
    here[7] = next[3];
    here[8] = next[4];
  }
}

template <int D>
void StepMatrix<D>::set_zero_beyond_band() {
  for (const int index : present_.beyond_band) block(index).set_zero();
}

template <int D>
void StepMatrix<D>::clear_rooms() {
  present_.rooms.clear();
  if (image_) present_.rooms.push_back({image_->half() - 4, image_->half(), image_->half() + 1});
}

template <int D>
void StepMatrix<D>::tie(std::vector<Lanes>& right) {
  for (int i = image_->half(); i < nodes_; ++i) {
    matrix_.set_identity_row(i);
    Block<D>& image = block(present_.blocks.index(i, image_->image(i)));
    for (int k = 0; k < 3; ++k) image.column[k] -= image_->column[k];
    if constexpr (D == 4) block(present_.blocks.index(i, image_->image_of_edge(i))).at(3, 3) += 1.0;
    right[at(i)] = Lanes{};
  }
}

template <int D>
auto StepMatrix<D>::stored(const ContactPoint& contact, std::size_t n) -> Places {
  Places out;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      out[at(k)][at(l)] = &band(contact.a0, k, l);
      if (contact.on_roller()) continue;
      const std::pair<int, int>& across = contact_blocks(n)[at(3 * k + l)];
      out[at(k)][at(3 + l)] = &block(across.first);
      out[at(3 + l)][at(k)] = &block(across.second);
      out[at(3 + k)][at(3 + l)] = &band(b_of(contact), k, l);
    }
  return out;
}

template <int D>
auto StepMatrix<D>::places(const ContactPoint& contact, std::size_t n) -> Places {
  if (!is_gathered(contact)) return stored(contact, n);
  Places out;
  for (std::size_t i = 0; i < gathered_.size(); ++i) {
    gathered_[i].set_zero();
    out[i / 6][i % 6] = &gathered_[i];
  }
  return out;
}

template <int D>
void StepMatrix<D>::fold(const ContactPoint& contact, std::size_t n) {
  const Places to = stored(contact, n);
  const Lanes moves = constant<Lanes>(1.0) - kSpin;
  for (int k = 0; k < 6; ++k) {
    Block<D>* row = &gathered_[at(6 * k)];
    if (mirrored(contact)) turn_columns(row + 3);
    const int strand = k - k % 3, node = (strand == 0 ? contact.a0 : contact.b0) + k % 3;
    const int first = strand == 0 ? contact.a0 : b_of(contact);
    const auto add = [&](int to_node, const auto& acts) {
      if (to_node >= image_->half()) return;
      for (std::size_t l = 0; l < 6; ++l)
        for (int j = 0; j < D; ++j) to[at(strand + to_node - first)][l]->column[j] += acts(row[l].column[j]);
    };
    add(node, [](const Lanes& own) { return own; });
    add(image_->image(node), [&](const Lanes& own) { return moves * (*image_ * own); });
    if (D == 4 && k % 3 < 2) add(image_->image_of_edge(node), [](const Lanes& own) { return -kSpin * own; });
  }
}

/// Of strand b on the other half: from columns of its nodes to those of their images, which run the other way.
template <int D>
void StepMatrix<D>::turn_columns(Block<D>* row) const {
  const Block<D> b[3] = {row[0], row[1], row[2]};
  for (int l = 0; l < 3; ++l) {
    for (int j = 0; j < 3; ++j) {
      row[l].column[j] = image_->turn(j, j) * b[2 - l].column[j];
      if (image_->aligned) continue;
      for (int i = 1; i < 3; ++i) row[l].column[j] += image_->turn((j + i) % 3, j) * b[2 - l].column[(j + i) % 3];
    }
    if constexpr (D == 4) row[l].column[3] = l < 2 ? -b[1 - l].column[3] : Lanes{};
  }
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
  const Places to = places(contact, n);
  for (int k = 0; k < 6; ++k)
    for (int l = 0; l < 6; ++l) {
      const double both = c[k] * c[l];
      for (int j = 0; j < 3; ++j) to[at(k)][at(l)]->column[j] += both * still[j] + pushed[k] * du[l][j];
    }
  if (is_gathered(contact)) fold(contact, n);
}

template <int D>
void StepMatrix<D>::add(const ContactPoint& contact, const SurfacePoint& surface, const SurfaceModel& model,
                        const SectionTurns& turns, std::size_t n) {
  if constexpr (D == 4) {
    const Places to = places(contact, n);
    add_lengthening(to, 0, contact.a0, surface.s_a, model.on_a[3], turns);
    if (contact.on_roller()) return add_columns<false>(contact, surface, model, turns, to);
    add_lengthening(to, 3, contact.b0, surface.s_b, model.on_b[3], turns);
    add_columns<true>(contact, surface, model, turns, to);
    if (is_gathered(contact)) fold(contact, n);
  }
}

template <int D>
void StepMatrix<D>::add_lengthening(const Places& to, int strand, int first, const double* weights, double torque,
                                    const SectionTurns& turns) {
  for (int j = 0; j < 2; ++j) {
    const auto edge = at(first + j);
    const Lanes pull = (-torque * weights[j] / turns.length[edge]) * turns.tangent[edge];
    Block<D>&own = *to[at(strand + j)][at(strand + j)], &next = *to[at(strand + j)][at(strand + j + 1)];
    for (int i = 0; i < 3; ++i) {
      own.column[i][3] -= pull[i];
      next.column[i][3] += pull[i];
    }
  }
}

template <int D>
template <bool kStrands>
void StepMatrix<D>::add_columns(const ContactPoint& contact, const SurfacePoint& surface, const SurfaceModel& model,
                                const SectionTurns& turns, const Places& to) {
  constexpr double kSecondDifference[3] = {1.0, -2.0, 1.0};
  const double spins_a[3] = {surface.s_a[0], surface.s_a[1], 0.0}, spins_b[3] = {surface.s_b[0], surface.s_b[1], 0.0};
  double c[6];
  std::copy_n(contact.c, 6, c);
  Lanes rows_a[3], rows_b[3];  // weights of on_a and on_b in a node's row
  Lanes slides_b[3];           // what the motion of the foot does to it
  for (int k = 0; k < 3; ++k) {
    const double d = surface.d_a[k], beta = contact.beta[3 + k], bends = kSecondDifference[k];
    rows_a[k] = Lanes{d, d, d, spins_a[k]};
    rows_b[k] = Lanes{beta, beta, beta, spins_b[k]};
    slides_b[k] = beta * model.force - Lanes{bends, bends, bends, k < 2 ? surface.s_slope_b[k] : 0.0} * model.on_b;
  }
  const auto add_node = [&](int l, const std::array<SurfaceColumn, 4>& columns) {
    for (int k = 0; k < 3; ++k) {
      Block<D>& on_a = *to[at(k)][at(l)];
      for (int i = 0; i < 4; ++i) {
        const SurfaceColumn& column = columns[at(i)];
        on_a.column[i] += c[k] * column.force + rows_a[k] * column.on_a;
      }
      if constexpr (!kStrands) continue;
      Block<D>& on_b = *to[at(3 + k)][at(l)];
      for (int i = 0; i < 4; ++i) {
        const SurfaceColumn& column = columns[at(i)];
        on_b.column[i] += c[3 + k] * column.force + rows_b[k] * column.on_b + column.foot * slides_b[k];
      }
    }
  };
  const auto spin_a = spin_of_nodes(turns.pull, contact.a0, surface.s_a);
  for (int l = 0; l < 3; ++l)
    add_node(l, columns_of(model, SurfaceModel::kTurnA, SurfaceModel::kSpinA, c[l], surface.d_a[l], spin_a[at(l)],
                           spins_a[l]));
  if constexpr (kStrands) {
    const auto spin_b = spin_of_nodes(turns.pull, contact.b0, surface.s_b);
    for (int l = 0; l < 3; ++l)
      add_node(3 + l, columns_of(model, SurfaceModel::kTurnB, SurfaceModel::kSpinB, c[3 + l], contact.beta[3 + l],
                                 spin_b[at(l)], spins_b[l]));
  }
}

template class StepMatrix<3>;
template class StepMatrix<4>;

}  // namespace knot_utm
