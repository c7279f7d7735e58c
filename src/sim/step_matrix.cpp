#include "knot_utm/sim/step_matrix.hpp"

#include <string>

#include "knot_utm/numeric/index.hpp"
#include "knot_utm/sim/force_term.hpp"
#include "surface_columns.hpp"

namespace knot_utm {
namespace {

constexpr int kRoomNodes = 4;  // of the other strand: three of a segment, one that it may slide on to

/// Columns of a node, by the changes of its image.
std::array<SurfaceColumn, 4> by_image(const HalfTurn& image, const std::array<SurfaceColumn, 4>& columns) {
  std::array<SurfaceColumn, 4> out;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) out[at(j)].add(image.turn(i, j), columns[at(i)]);
  out[3] = SurfaceColumn(-1.0, columns[3]);
  return out;
}

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
  if (!reaches_middle(contact)) return stored(contact, n);
  Places out;
  for (std::size_t i = 0; i < gathered_.size(); ++i) {
    gathered_[i].set_zero();
    out[i / 6][i % 6] = &gathered_[i];
  }
  return out;
}

/// A row of a node acts on the node, where that is on the half, and turned on its image, where that is.
template <int D>
void StepMatrix<D>::fold(const ContactPoint& contact, std::size_t n) {
  if (!reaches_middle(contact)) return;
  const Places to = stored(contact, n);
  const Lanes moves = constant<Lanes>(1.0) - kSpin;
  for (int k = 0; k < 6; ++k) {
    const int strand = k - k % 3, first = strand == 0 ? contact.a0 : b_of(contact), node = first + k % 3;
    const int image = image_->image(node), of_edge = image_->image_of_edge(node);
    for (std::size_t l = 0; l < 6; ++l)
      for (int j = 0; j < D; ++j) {
        const Lanes& row = gathered_[at(6 * k) + l].column[j];
        const auto at_node = [&](int i) -> Lanes& { return to[at(strand + i - first)][l]->column[j]; };
        if (node < image_->half()) at_node(node) += row;
        if (image < image_->half()) at_node(image) += moves * (*image_ * row);
        if (D == 4 && k % 3 < 2 && of_edge < image_->half()) at_node(of_edge) -= kSpin * row;
      }
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
  double beta[6];
  std::copy_n(contact.beta, 6, beta);
  const bool mirrored = this->mirrored(contact);
  if (mirrored) {
    std::swap(c[3], c[5]);
    std::swap(beta[3], beta[5]);
  }
  const auto turned = [&](int k, const Lanes& v) { return mirrored && k >= 3 ? *image_ * v : v; };
  Lanes by_b[3] = {still[0], still[1], still[2]};
  if (mirrored)
    for (int j = 0; j < 3; ++j)
      by_b[j] = image_->turn(0, j) * still[0] + image_->turn(1, j) * still[1] + image_->turn(2, j) * still[2];
  Lanes pushed[6];  // beta_k g - c_k gamma
  Lanes du[6];      // du/dq_l
  const Lanes du_s = contact.inverse_g * to_lanes(contact.db), du_r = contact.inverse_g * to_lanes(contact.x);
  for (int k = 0; k < 6; ++k) {
    pushed[k] = turned(k, beta[k] * model.force - c[k] * model.slide);
    du[k] = turned(k, c[k] * du_s + beta[k] * du_r);
  }
  const Places to = places(contact, n);
  for (int k = 0; k < 6; ++k)
    for (int l = 0; l < 6; ++l) {
      const double both = c[k] * c[l];
      Block<D>& block = *to[at(k)][at(l)];
      for (int j = 0; j < 3; ++j)
        block.column[j] += both * turned(k, l < 3 ? still[j] : by_b[j]) + pushed[k] * du[l][j];
    }
  fold(contact, n);
}

template <int D>
void StepMatrix<D>::add(const ContactPoint& contact, const SurfacePoint& surface, const SurfaceModel& model,
                        const SectionTurns& turns, std::size_t n) {
  if constexpr (D == 4) {
    if (contact.on_roller()) return add_columns<false, false>(contact, surface, model, turns, n);
    if (mirrored(contact)) return add_columns<true, true>(contact, surface, model, turns, n);
    add_columns<true, false>(contact, surface, model, turns, n);
  }
}

template <int D>
void StepMatrix<D>::add_lengthening(const Places& to, int side, int first, const double* weights, double torque,
                                    const SectionTurns& turns) {
  for (int j = 0; j < 2; ++j) {
    const auto edge = at(first + j);
    const Lanes pull = (-torque * weights[j] / turns.length[edge]) * turns.tangent[edge];
    Block<D>&own = *to[at(side + j)][at(side + j)], &next = *to[at(side + j)][at(side + j + 1)];
    for (int i = 0; i < 3; ++i) {
      own.column[i][3] -= pull[i];
      next.column[i][3] += pull[i];
    }
  }
}

template <int D>
template <bool kStrands, bool kMirrored>
void StepMatrix<D>::add_columns(const ContactPoint& contact, const SurfacePoint& surface, const SurfaceModel& model,
                                const SectionTurns& turns, std::size_t n) {
  constexpr double kSecondDifference[3] = {1.0, -2.0, 1.0};
  const auto turned = [&](const Lanes& v) {
    if constexpr (kMirrored) return *image_ * v;
    return v;
  };
  const auto in_order = [](int k, int last) { return at(kMirrored ? last - k : k); };
  const double spins_a[3] = {surface.s_a[0], surface.s_a[1], 0.0};
  double spins_b[3] = {surface.s_b[in_order(0, 1)], surface.s_b[in_order(1, 1)], 0.0};
  double c[6], beta[3];
  std::copy_n(contact.c, 6, c);
  std::copy_n(contact.beta + 3, 3, beta);
  if constexpr (kMirrored) {
    std::swap(c[3], c[5]);
    std::swap(beta[0], beta[2]);
  }
  Lanes rows_a[3], rows_b[3];  // weights of on_a and on_b in a node's row
  Lanes slides_b[3];           // what the motion of the foot does to it
  for (int k = 0; k < 3; ++k) {
    const double d = surface.d_a[k], b = beta[k], bends = kSecondDifference[k];
    rows_a[k] = Lanes{d, d, d, spins_a[k]};
    rows_b[k] = Lanes{b, b, b, spins_b[k]};
    const double grows = k < 2 ? surface.s_slope_b[in_order(k, 1)] : 0.0;
    slides_b[k] = turned(b * model.force - Lanes{bends, bends, bends, grows} * model.on_b);
  }
  const Places to = places(contact, n);
  const auto add_node = [&](int l, const std::array<SurfaceColumn, 4>& columns) {
    std::array<SurfaceColumn, 4> on_image;
    const std::array<SurfaceColumn, 4>* of_b = &columns;
    if constexpr (kMirrored) {
      of_b = &on_image;
      for (std::size_t i = 0; i < 4; ++i) {
        on_image[i].force = turned(columns[i].force);
        on_image[i].on_b = turned(columns[i].on_b);
        on_image[i].foot = columns[i].foot;
      }
    }
    for (int k = 0; k < 3; ++k) {
      Block<D>& on_a = *to[at(k)][at(l)];
      for (int i = 0; i < 4; ++i) {
        const SurfaceColumn& column = columns[at(i)];
        on_a.column[i] += c[k] * column.force + rows_a[k] * column.on_a;
      }
      if constexpr (!kStrands) continue;
      Block<D>& on_b = *to[at(3 + k)][at(l)];
      for (int i = 0; i < 4; ++i) {
        const SurfaceColumn& column = (*of_b)[at(i)];
        on_b.column[i] += c[3 + k] * column.force + rows_b[k] * column.on_b + column.foot * slides_b[k];
      }
    }
  };
  add_lengthening(to, 0, contact.a0, surface.s_a, model.on_a[3], turns);
  if constexpr (kStrands) add_lengthening(to, 3, b_of(contact), spins_b, turned(model.on_b)[3], turns);
  const auto spin_a = spin_of_nodes(turns.pull, contact.a0, surface.s_a);
  for (int l = 0; l < 3; ++l)
    add_node(l, columns_of(model, SurfaceModel::kTurnA, SurfaceModel::kSpinA, c[l], surface.d_a[l], spin_a[at(l)],
                           spins_a[l]));
  if constexpr (kStrands) {
    const auto spin_b = spin_of_nodes(turns.pull, contact.b0, surface.s_b);
    for (int l = 0; l < 3; ++l) {
      const auto columns = columns_of(model, SurfaceModel::kTurnB, SurfaceModel::kSpinB, c[3 + l], beta[l],
                                      spin_b[in_order(l, 2)], spins_b[l]);
      if constexpr (kMirrored)
        add_node(3 + l, by_image(*image_, columns));
      else
        add_node(3 + l, columns);
    }
  }
  fold(contact, n);
}

template class StepMatrix<3>;
template class StepMatrix<4>;

}  // namespace knot_utm
