#pragma once

#include <endian.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace knot_utm {

/// The state of a run as bytes. One visitor of a class both saves and loads it, so that the two cannot disagree:
///
///     void Pendulum::state(Archive& archive) {
///       archive.section("PEND");
///       archive(angle_, rate_);
///     }
///
/// A visitor names everything that the future of the run depends on and that cannot be computed again to the last bit.
/// It loads into an object that was constructed like the saved one. Vectors and matrices must therefore have the saved
/// sizes already; only a `list` may have another length.
///
/// A file is one line of text with the kind of state and the version of this package, the length of what follows [8
/// bytes], the state, and a CRC-32 of all of it [4 bytes]. Numbers are binary and little-endian. A bare archive is the
/// state alone, for files that have a format of their own, as that of the shapes has (run/samples.hpp).
///
/// Loading throws InvalidInput where the file is damaged, of another kind or version, or the state of another object.
/// The object that it was loaded into is then unusable. Loading takes no more memory than a small multiple of the
/// file's size, whatever lengths the file claims. Every value has one form only, so a state that was accepted is saved
/// to the same bytes again.
class Archive {
 public:
  /// Saves; `kind` is a word or two.
  explicit Archive(const std::string& kind) : kind_(kind), to_(&own_) {}
  /// Loads what an archive of the same kind has saved. `file`: its name, for messages.
  Archive(const std::string& kind, std::string bytes, const std::string& file);

  /// Saves bare, appended to `bytes`.
  static Archive to(std::string& bytes) { return Archive(&bytes); }
  /// Loads what was saved bare. The bytes must stay where they are.
  static Archive from(std::string_view bytes, const std::string& kind, const std::string& file) {
    return {Bare(), bytes, kind, file};
  }

  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  bool loads() const { return to_ == nullptr; }

  /// A mark of four letters, by which loading notices an order that differs from that of saving.
  void section(const char* tag);

  /// The same of a part that a state may lack. Returns whether it is there, which loading tells by the mark: what else
  /// may follow must not begin with it.
  bool optional_section(const char* tag, bool there);

  template <typename... Values>
  void operator()(Values&... values) {
    (visit(values), ...);
  }

  /// Saves a constant object. The cast is safe, because saving only reads.
  template <typename T>
  void save(const T& value) {
    visit(const_cast<T&>(value));
  }

  /// A list may be of any length.
  template <typename T>
  void list(std::vector<T>& values) {
    // An entry takes at least one byte.
    const auto length = static_cast<std::size_t>(length_of_list(values.size(), 1));
    // A damaged file may claim any length: entries beyond what its bytes can fill are made one by one, as they are
    // read.
    if (loads()) values.resize(std::min(length, left() / sizeof(T)));
    for (std::size_t i = 0; i < length; ++i) {
      if (i == values.size()) values.emplace_back();
      visit(values[i]);
    }
  }

  /// A matrix may likewise have any number of columns, and a vector any number of rows.
  template <int Rows, int Columns>
  void list(Eigen::Matrix<double, Rows, Columns>& matrix) {
    constexpr bool kOfColumns = Columns == Eigen::Dynamic;
    constexpr std::size_t kEntryBytes = sizeof(double) * (kOfColumns ? Rows : 1);
    const Eigen::Index now = kOfColumns ? matrix.cols() : matrix.rows();
    const auto length = static_cast<Eigen::Index>(length_of_list(static_cast<std::uint64_t>(now), kEntryBytes));
    if (loads()) matrix.resize(kOfColumns ? Rows : length, kOfColumns ? length : Columns);
    numbers(matrix.data(), static_cast<std::size_t>(matrix.size()));
  }

  /// An integer from low to high, such as the number of a node.
  void number(const char* what, int& value, int low, int high);

  /// One of an enumeration, whose last value is `last`.
  template <typename Choice>
  void choice(const char* what, Choice& value, Choice last) {
    int index = static_cast<int>(value);
    number(what, index, 0, static_cast<int>(last));
    if (loads()) value = static_cast<Choice>(index);
  }

  /// A number that must be the same in the saved object and in the one that is loaded into.
  void same(const char* what, std::int64_t value);

  /// Throws InvalidInput about what was loaded unless `right`.
  void require(bool right, const char* what, const std::string& value) const;

  /// The whole file, once everything is saved.
  std::string bytes() const;
  /// To be called once everything is loaded; throws InvalidInput where bytes are left.
  void end() const;

 private:
  static constexpr std::size_t kWord = sizeof(std::uint64_t);

  explicit Archive(std::string* bytes) : to_(bytes) {}
  struct Bare {};
  Archive(Bare, std::string_view bytes, const std::string& kind, const std::string& file)
      : kind_(kind), file_(file), from_(bytes) {}

  // Visitors of numbers are inline, because shapes are written and read at each reading of the load cell.
  void visit(std::uint64_t& value) {
    if (loads())
      value = take();
    else
      put(value);
  }
  void visit(double& value) { numbers(&value, 1); }
  void visit(int& value);
  void visit(bool& value);
  void visit(std::string& value);
  template <typename A, typename B>
  void visit(std::pair<A, B>& value) {
    visit(value.first);
    visit(value.second);
  }
  template <typename T>
  void visit(std::optional<T>& value) {
    bool there = value.has_value();
    visit(there);
    if (loads()) value = there ? std::optional<T>(T{}) : std::nullopt;
    if (there) visit(*value);
  }
  template <typename T, std::size_t N>
  void visit(T (&values)[N]) {
    for (T& value : values) visit(value);
  }
  template <typename T>
  void visit(std::vector<T>& values) {
    same("length", static_cast<std::int64_t>(values.size()));
    for (T& value : values) visit(value);
  }
  template <int Rows, int Columns>
  void visit(Eigen::Matrix<double, Rows, Columns>& matrix) {
    if (Rows == Eigen::Dynamic) same("rows", matrix.rows());
    if (Columns == Eigen::Dynamic) same("columns", matrix.cols());
    numbers(matrix.data(), static_cast<std::size_t>(matrix.size()));
  }
  template <typename T>
  auto visit(T& object) -> decltype(object.state(*this)) {
    object.state(*this);
  }

  void put(std::uint64_t value) {
    value = htole64(value);
    to_->append(reinterpret_cast<const char*>(&value), kWord);
  }
  std::uint64_t take() {
    std::uint64_t value = 0;
    std::memcpy(&value, take(kWord), kWord);
    return le64toh(value);
  }
  /// The next `bytes` bytes to be loaded.
  const char* take(std::size_t bytes) {
    if (bytes > left()) refuse("length", std::to_string(from_.size()) + " bytes");
    next_ += bytes;
    return from_.data() + next_ - bytes;
  }
  std::size_t left() const { return from_.size() - next_; }

  void numbers(double* values, std::size_t count) {
    static_assert(sizeof(double) == kWord);
    if (loads()) {
      const char* bytes = take(count * kWord);
      for (std::size_t i = 0; i < count; ++i) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, bytes + i * kWord, kWord);
        bits = le64toh(bits);
        std::memcpy(values + i, &bits, kWord);
      }
    } else {
      for (std::size_t i = 0; i < count; ++i) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, values + i, kWord);
        put(bits);
      }
    }
  }

  /// Saves or loads the length of a list. A loaded length is refused where the bytes that are left cannot hold so many
  /// entries of at least `entry_bytes` each.
  std::uint64_t length_of_list(std::uint64_t length, std::size_t entry_bytes) {
    visit(length);
    if (loads() && length > left() / entry_bytes) refuse("length of a list", std::to_string(length));
    return length;
  }

  [[noreturn]] void refuse(const char* what, const std::string& value) const;
  [[noreturn]] void complain(const std::string& what, const std::string& value, const std::string& allowed) const;

  std::string kind_, file_;
  std::string own_;            // what is saved, or the file
  std::string* to_ = nullptr;  // receives what is saved; null while loading
  std::string_view from_;      // all that is to be loaded
  std::size_t next_ = 0;       // first byte of it that is not loaded yet
};

}  // namespace knot_utm
