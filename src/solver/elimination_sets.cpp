#include "knot_utm/solver/elimination_sets.hpp"

#include <algorithm>
#include <utility>

#include "knot_utm/numeric/index.hpp"

namespace knot_utm {

void EliminationSets::build(const Neighbours& neighbours) {
  find_pieces(neighbours);
  join_pieces(neighbours);
  list_nodes(find_sets());
}

void EliminationSets::find_pieces(const Neighbours& neighbours) {
  const int nodes = neighbours.nodes();
  const std::vector<int>&begin = neighbours.begin, &list = neighbours.list;
  const auto free = [&](int i) {
    const int first = begin[at(i)], last = begin[at(i) + 1] - 1;
    return last < first || (list[at(first)] >= i - 2 && list[at(last)] <= i + 2);
  };
  pieces_.clear();
  piece_of_.clear();
  for (int i = 0; i < nodes; ++i) {
    // One free node alone parts nothing: its neighbours are coupled across it.
    const bool straight = free(i) && ((i > 0 && free(i - 1)) || (i + 1 < nodes && free(i + 1)));
    if (pieces_.empty() || pieces_.back().straight != straight) pieces_.push_back({i, straight});
    piece_of_.push_back(static_cast<int>(pieces_.size()) - 1);
  }
}

void EliminationSets::join_pieces(const Neighbours& neighbours) {
  joined_.clear();
  for (int piece = 0; piece < static_cast<int>(pieces_.size()); ++piece) joined_.push_back(piece);
  for (int i = 0; i < neighbours.nodes(); ++i) {
    const int own = piece_of_[at(i)];
    if (pieces_[at(own)].straight) continue;
    for (int a = neighbours.begin[at(i)]; a < neighbours.begin[at(i) + 1]; ++a) {
      const int other = piece_of_[at(neighbours.list[at(a)])];
      if (other == own || pieces_[at(other)].straight) continue;
      const int one = knot_of(own), two = knot_of(other);
      joined_[at(std::max(one, two))] = std::min(one, two);
    }
  }
}

int EliminationSets::knot_of(int piece) {
  while (joined_[at(piece)] != piece) piece = joined_[at(piece)] = joined_[at(joined_[at(piece)])];
  return piece;
}

int EliminationSets::find_sets() {
  const int pieces = static_cast<int>(pieces_.size());
  knots_.assign(at(pieces), Knot{0, 0, -1});
  for (int piece = 1; piece + 1 < pieces; ++piece) {
    const int before = knot_of(piece - 1), after = knot_of(piece + 1);
    if (!pieces_[at(piece)].straight || before == after) continue;
    for (const auto& [knot, other] : {std::make_pair(before, after), std::make_pair(after, before)}) {
      ++knots_[at(knot)].straights;
      knots_[at(knot)].others ^= other;
    }
  }
  int sets = 0;
  for (int piece = 0; piece < pieces; ++piece) {
    for (int knot = piece; knots_[at(knot)].straights == 1;) {
      const int next = knots_[at(knot)].others;
      knots_[at(knot)] = {0, 0, sets++};
      --knots_[at(next)].straights;
      knots_[at(next)].others ^= knot;
      knot = next;
    }
  }
  for (Knot& knot : knots_)
    if (knot.set < 0) knot.set = sets;
  return sets + 1;
}

int EliminationSets::set_of_piece(int piece) {
  if (!pieces_[at(piece)].straight) return knots_[at(knot_of(piece))].set;
  const int last = static_cast<int>(pieces_.size()) - 1;
  if (last == 0) return knots_[0].set;
  // With the later one of the knots that it joins.
  return std::max(piece > 0 ? set_of_piece(piece - 1) : 0, piece < last ? set_of_piece(piece + 1) : 0);
}

void EliminationSets::list_nodes(int sets) {
  begin_.assign(at(sets) + 1, 0);
  set_.clear();
  for (const int piece : piece_of_) {
    set_.push_back(set_of_piece(piece));
    ++begin_[at(set_.back()) + 1];
  }
  for (int set = 0; set < sets; ++set) begin_[at(set) + 1] += begin_[at(set)];
  filled_.assign(begin_.begin(), begin_.end() - 1);
  nodes_.resize(set_.size());
  for (int i = 0; i < static_cast<int>(set_.size()); ++i) nodes_[at(filled_[at(set_[at(i)])]++)] = i;
}

}  // namespace knot_utm
