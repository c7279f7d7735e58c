#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace knot_utm {

/// The state of a run as bytes. One visitor a class both saves and loads, so that the two cannot disagree:
///
///     void Pendulum::state(Archive& archive) {
///       archive.section("PEND");
///       archive(angle_, rate_);
///     }
///
/// A visitor names what the future depends on and what cannot be worked out anew, to the last bit. It is loaded into an
/// object made as the saved one was made: what has a size has the same one there, but for lists.
///
/// As a file: one line of text with the kind of state and the version of this package, the length of what follows [8
/// bytes], the state, and a CRC-32 of all of it [4 bytes]. Numbers are binary and little-endian.
///
/// Loading throws InvalidInput, one line, where the file is damaged, of another kind or version, or the state of
/// another object; what was loaded into is of no use then.
class Archive {
 public:
  /// Saves; `kind` is a word or two.
  explicit Archive(const std::string& kind) : kind_(kind) {}
  /// Loads what an archive of the same kind has saved. `file`: its name, for complaints.
  Archive(const std::string& kind, const std::string& bytes, const std::string& file);

  bool loads() const { return loads_; }

  /// A mark of four letters: what was saved must be loaded in the same order.
  void section(const char* tag);

  template <typename... Values>
  void operator()(Values&... values) {
    (visit(values), ...);
  }

  /// A list may be of any length.
  template <typename T>
  void list(std::vector<T>& values) {
    std::uint64_t length = values.size();
    visit(length);
    if (loads_) {
      // An entry takes a byte at least.
      require(length <= body_.size() - next_, "length of a list", std::to_string(length));
      values.resize(static_cast<std::size_t>(length));
    }
    for (T& value : values) visit(value);
  }

  /// So may a matrix have any number of columns, or a vector of rows.
  template <int Rows, int Columns>
  void list(Eigen::Matrix<double, Rows, Columns>& matrix) {
    std::uint64_t length = static_cast<std::uint64_t>(matrix.size());
    visit(length);
    constexpr std::uint64_t kRows = Columns == Eigen::Dynamic ? static_cast<std::uint64_t>(Rows) : 1;
    if (loads_) {
      require(length <= (body_.size() - next_) / sizeof(double) && length % kRows == 0, "length of a list",
              std::to_string(length));
      matrix.resize(Columns == Eigen::Dynamic ? Rows : static_cast<Eigen::Index>(length),
                    Columns == Eigen::Dynamic ? static_cast<Eigen::Index>(length / kRows) : Columns);
    }
    for (Eigen::Index i = 0; i < matrix.size(); ++i) visit(matrix.data()[i]);
  }

  /// A number within bounds, such as that of a node.
  void number(const char* what, int& value, int low, int high);

  /// One of an enumeration, whose last value is `last`.
  template <typename Choice>
  void choice(const char* what, Choice& value, Choice last) {
    int index = static_cast<int>(value);
    number(what, index, 0, static_cast<int>(last));
    value = static_cast<Choice>(index);
  }

  /// What must be the same in both objects.
  void same(const char* what, std::int64_t value);

  /// Complains of what was loaded unless `right`.
  void require(bool right, const char* what, const std::string& value) const;

  /// The file, once all is saved.
  std::string bytes() const;
  /// Once all is loaded: complains where there is more.
  void end() const;

 private:
  void visit(std::uint64_t& value);
  void visit(double& value);
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
    if (loads_) value = there ? std::optional<T>(T{}) : std::nullopt;
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
    for (Eigen::Index i = 0; i < matrix.size(); ++i) visit(matrix.data()[i]);
  }
  template <typename T>
  auto visit(T& object) -> decltype(object.state(*this)) {
    object.state(*this);
  }

  [[noreturn]] void complain(const std::string& what, const std::string& value, const std::string& allowed) const;

  std::string kind_, file_;
  bool loads_ = false;
  std::string body_;
  std::size_t next_ = 0;  // of the body, to be loaded
};

}  // namespace knot_utm
