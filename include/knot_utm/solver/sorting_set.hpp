#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace knot_utm {

/// A set of numbers that are inserted in any order, also repeatedly, and taken out in ascending order. Each number is
/// one bit, because the rows of a sparse matrix are short and are merged from overlapping lists.
class SortingSet {
 public:
  /// It may hold 0 to numbers - 1.
  void reset(int numbers) {
    words_.assign(static_cast<std::size_t>(place_of(numbers) + 1), 0);
    forget_range();
  }

  /// Inserts number(each) for each entry from `begin` up to `end`.
  template <typename Number>
  void insert(const int* begin, const int* end, Number number) {
    int lowest = lowest_, highest = highest_;
    for (const int* each = begin; each != end; ++each) {
      const int n = number(*each);
      word(place_of(n)) |= bit(n);
      lowest = std::min(lowest, n);
      highest = std::max(highest, n);
    }
    lowest_ = lowest;
    highest_ = highest;
  }
  /// Inserts `first` to `last`, both included.
  void insert_run(int first, int last) {
    for (int place = place_of(first); place <= place_of(last); ++place) {
      const int from = std::max(first - kBits * place, 0), to = std::min(last - kBits * place, kBits - 1);
      word(place) |= (~std::uint64_t{0} << from) & (~std::uint64_t{0} >> (kBits - 1 - to));
    }
    lowest_ = std::min(lowest_, first);
    highest_ = std::max(highest_, last);
  }
  void erase(int number) { word(place_of(number)) &= ~bit(number); }

  /// Appends the numbers to `list` in ascending order and empties the set.
  void take(std::vector<int>& list) {
    const int first = place_of(lowest_), last = highest_ < 0 ? -1 : place_of(highest_);
    int count = 0;
    for (int place = first; place <= last; ++place) count += __builtin_popcountll(word(place));
    list.resize(list.size() + static_cast<std::size_t>(count));
    int* next = list.data() + list.size() - count;
    for (int place = first; place <= last; ++place)
      for (std::uint64_t bits = std::exchange(word(place), 0); bits != 0; bits &= bits - 1)
        *next++ = kBits * place + __builtin_ctzll(bits);
    forget_range();
  }

 private:
  static constexpr int kBits = 64;

  /// Unsigned, because their division is a shift; numbers are never negative.
  static int place_of(int number) { return static_cast<int>(static_cast<unsigned>(number) / kBits); }
  static std::uint64_t bit(int number) { return std::uint64_t{1} << (static_cast<unsigned>(number) % kBits); }
  std::uint64_t& word(int place) { return words_[static_cast<std::size_t>(place)]; }
  void forget_range() {
    lowest_ = kBits * static_cast<int>(words_.size());
    highest_ = -1;
  }

  std::vector<std::uint64_t> words_;
  int lowest_ = 0, highest_ = -1;  // bounds of what it holds
};

}  // namespace knot_utm
