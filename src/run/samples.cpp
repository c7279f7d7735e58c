#include "knot_utm/run/samples.hpp"

#include <endian.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample_fields.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

enum class RowKind { kStep, kAnswer, kAnsweredStep, kEnd };

/// All that a row can have.
struct Row {
  RowKind kind = RowKind::kStep;
  double wall_time = 0.0;
  Command command;
  Sample sample;
  TestEnd end;
};

constexpr RowKind last_of(RowKind) { return RowKind::kEnd; }
constexpr EndedBy last_of(EndedBy) { return EndedBy::kPlateau; }

const char* name_of(RowKind kind) {
  return std::array{"step", "answer", "answered step", "end"}[static_cast<std::size_t>(kind)];
}
const char* name_of(EndedBy end) { return ended_by_name(end); }
const char* name_of(Phase phase) { return phase_name(phase); }
const char* name_of(BreakPlace place) { return break_place_name(place); }
const char* name_of(KnotType type) { return std::array{"kept", "changed", "crossed"}[static_cast<std::size_t>(type)]; }
const char* name_of(BenchStatus status) {
  return std::array{"running", "phase done", "not equilibrated", "broken", "failed"}[static_cast<std::size_t>(status)];
}

/// Calls `visit(name, unit, value)` for every cell of a row. `visit.fill` says before whether the row has the cells
/// that follow.
template <class Visitor>
void visit_row(Row& row, Visitor& visit) {
  visit("row", "-", row.kind);
  visit.fill(row.kind == RowKind::kAnswer || row.kind == RowKind::kAnsweredStep);
  Command& command = row.command;
  visit("wall_time", "s", row.wall_time);
  visit("command_sequence", "-", command.sequence);
  visit("command_time", "s", command.time);
  visit("command_displacement", "m", command.displacement);
  visit("command_velocity", "m/s", command.velocity);
  visit("command_turn", "rad", command.turn);
  visit("command_step", "-", command.step);
  visit("command_phase", "-", command.phase);
  visit("command_speed", "m/s", command.speed);
  visit("command_duration", "s", command.duration);
  visit("command_stop_load", "N", command.stop_load);
  visit("command_balance", "-", command.balance);
  visit("command_read_cell", "-", command.read_cell);
  visit.fill(true);
  visit_sample_fields([&](const auto& field) { visit(field.name, field.unit, field.of(row.sample)); });
  visit.fill(row.kind == RowKind::kEnd);
  visit("ended_by", "-", row.end.ended_by);
  visit("reason", "-", row.end.reason);
}

/// The names and units of all columns. A number for each knot is that many columns.
struct HeadWriter {
  std::string names, units;

  void fill(bool) {}
  template <class Value>
  void operator()(const std::string& name, const std::string& unit, const Value&) {
    names += (names.empty() ? "" : ",") + name;
    units += (units.empty() ? "" : ",") + unit;
  }
  void operator()(const std::string& name, const std::string& unit, const PerKnot&) {
    for (std::size_t k = 1; k <= PerKnot::kMost; ++k) (*this)(name + '_' + std::to_string(k), unit, k);
  }
};

std::string head() {
  HeadWriter head;
  Row row;
  visit_row(row, head);
  return head.names + '\n' + head.units + '\n';
}

/// Appends a row.
struct RowWriter {
  std::string& out;
  bool filled = true, first = true;

  void fill(bool fills) { filled = fills; }
  template <class Value>
  void operator()(const char*, const char*, const Value& value) {
    if (!std::exchange(first, false)) out += ',';
    if (filled) put(value);
  }
  void operator()(const char*, const char*, const PerKnot& values) {
    for (std::size_t k = 0; k < PerKnot::kMost; ++k) {
      out += ',';
      if (k < values.size()) put(values[k]);
    }
  }
  template <class Value>
  void put(const Value& value) {
    if constexpr (std::is_same_v<Value, bool>) {
      out += value ? '1' : '0';
    } else if constexpr (std::is_enum_v<Value>) {
      out += name_of(value);
    } else {
      std::array<char, 32> text{};
      out.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
    }
  }
  void put(const std::string& text) {
    if (text.empty()) return;
    out += '"';
    for (const char c : text) {
      if (c == '"') out += '"';
      out += c == '\n' || c == '\r' ? ' ' : c;
    }
    out += '"';
  }
};

void append_row(Row row, std::string& out) {
  RowWriter writer{out};
  visit_row(row, writer);
  out += '\n';
}

/// Reads the cells of one row.
class RowReader {
 public:
  RowReader(const std::string& file, std::uint64_t number, std::string_view line)
      : file_(file), number_(number), rest_(line) {}

  void fill(bool fills) { filled_ = fills; }
  template <class Value>
  void operator()(const char* name, const char*, Value& value) {
    const std::string_view text = cell(name);
    if (!filled_ && text.empty()) return;
    if (!filled_ || !read(text, value)) refuse(name, text, filled_ ? "a value as tensile_test writes it" : "nothing");
  }
  void operator()(const char* name, const char*, PerKnot& values) {
    std::array<double, PerKnot::kMost> found{};
    std::size_t size = 0;
    for (std::size_t k = 0; k < PerKnot::kMost; ++k) {
      const std::string_view text = cell(name);
      if (text.empty()) continue;
      if (size != k || !read(text, found[size++])) refuse(name, text, "a number for each knot");
    }
    values = PerKnot::unknown(size);
    for (std::size_t k = 0; k < size; ++k) values[k] = found[k];
  }
  void end() {
    if (!at_end_) refuse("columns", "more", "as many as row 1 has");
  }

 private:
  /// The next cell, without its quotes.
  std::string_view cell(const char* name) {
    if (at_end_) refuse(name, "", "as many columns as row 1 has");
    unquoted_.clear();
    std::size_t at = 0;
    const bool quoted = rest_.substr(0, 1) == "\"";
    if (quoted) {
      for (at = 1; at < rest_.size(); ++at) {
        if (rest_[at] == '"' && rest_.substr(++at, 1) != "\"") break;
        unquoted_ += rest_[at];
      }
    }
    const std::size_t comma = rest_.find(',', at);
    const std::string_view text = quoted ? std::string_view(unquoted_) : rest_.substr(0, comma);
    at_end_ = comma == std::string_view::npos;
    rest_.remove_prefix(at_end_ ? rest_.size() : comma + 1);
    return text;
  }
  static bool read(std::string_view text, std::string& value) {
    value = text;
    return true;
  }
  static bool read(std::string_view text, bool& value) {
    value = text == "1";
    return value || text == "0";
  }
  static bool read(std::string_view text, double& value) {
    const std::optional<double> number = parse_number(text);
    value = number.value_or(0.0);
    return number.has_value();
  }
  template <class Value>
  static bool read(std::string_view text, Value& value) {
    if constexpr (std::is_enum_v<Value>) {
      for (int i = 0; i <= static_cast<int>(last_of(Value())); ++i) {
        value = static_cast<Value>(i);
        if (text == name_of(value)) return true;
      }
      return false;
    } else {
      const std::from_chars_result end = std::from_chars(text.data(), text.data() + text.size(), value);
      return end.ec == std::errc() && end.ptr == text.data() + text.size();
    }
  }
  [[noreturn]] void refuse(const char* name, std::string_view text, const char* allowed) const {
    throw InvalidInput(file_, "row " + std::to_string(number_) + ": " + name, '"' + std::string(text) + '"', allowed);
  }

  const std::string& file_;
  std::uint64_t number_;
  std::string_view rest_;
  std::string unquoted_;
  bool filled_ = true, at_end_ = false;
};

}  // namespace

void RodReadings::state(Archive& archive) {
  archive.list(twist_rate);
  archive.list(contact_load);
}

void Record::state(Archive& archive) {
  archive(command, answer);
  archive.list(steps);
  archive.list(shape);
  archive.list(tension);
  archive(readings, wall_time);
}

const Sample* cell_reading(const Record& record) {
  const auto parted = [](const Sample& sample) { return sample.status == BenchStatus::kBroken; };
  const auto step = std::find_if(record.steps.begin(), record.steps.end(), parted);
  if (step != record.steps.end()) return &*step;
  if (parted(record.answer)) return &record.answer;
  const bool read = record.command.read_cell || record.command.balance;
  return read && record.answer.status != BenchStatus::kFailed ? &record.answer : nullptr;
}

void CellReadings::add(const Record& record, const Take& take) {
  if (record.command.step != step_) end(take);
  unread_.reset();
  step_ = record.command.step;
  if (const Sample* reading = cell_reading(record)) return take(*reading);
  if (pulls(record.command.phase) && record.answer.status != BenchStatus::kFailed) unread_ = record.answer;
}

void CellReadings::end(const Take& take) {
  if (unread_) take(*unread_);
  unread_.reset();
}

std::string samples_file(const std::string& folder) { return (fs::path(folder) / "samples.csv").string(); }
std::string shapes_file(const std::string& folder) { return (fs::path(folder) / "shapes.bin").string(); }

void SamplesReader::Shape::state(Archive& archive) {
  archive(sequence);
  archive.list(points);
  archive.list(tension);
  archive(readings);
}

SamplesReader::SamplesReader(const std::string& folder)
    : file_(samples_file(folder)),
      shapes_file_(shapes_file(folder)),
      in_(file_, std::ios::binary),
      shapes_in_(shapes_file_, std::ios::binary) {
  std::error_code error;
  bytes_ = fs::file_size(file_, error);
  if (!in_ || error) throw InvalidInput::cannot_read(file_);
  const std::string head = knot_utm::head();
  std::string begin(head.size(), '\0');
  in_.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (!in_ || begin != head)
    throw InvalidInput::sentence("row 1", "the columns are not those that this version writes").in_file(file_);
  whole_bytes_ = begin.size();
}

bool SamplesReader::take_shape(std::uint64_t sequence) {
  if (shape_bytes_ == 0) {
    std::uint64_t length = 0;
    std::error_code error;
    if (!shapes_in_.read(reinterpret_cast<char*>(&length), sizeof(length))) return false;
    length = le64toh(length);
    if (length > fs::file_size(shapes_file_, error) - shapes_whole_bytes_ || error) return false;  // torn
    std::string bytes(length, '\0');
    if (!shapes_in_.read(bytes.data(), static_cast<std::streamsize>(length))) return false;
    Archive archive = Archive::from(bytes, "shape", shapes_file_);
    archive(shape_);
    archive.end();
    shape_bytes_ = sizeof(length) + length;
  }
  if (shape_.sequence != sequence) return false;
  shapes_whole_bytes_ += std::exchange(shape_bytes_, 0);
  return true;
}

bool SamplesReader::next(Record& record) {
  record.steps.clear();
  std::uint64_t length = 0;
  while (std::getline(in_, line_) && !in_.eof()) {
    ++row_;
    length += line_.size() + 1;
    Row row;
    RowReader reader(file_, row_, line_);
    visit_row(row, reader);
    reader.end();
    if (row.kind == RowKind::kStep) {
      record.steps.push_back(std::move(row.sample));
      continue;
    }
    whole_bytes_ += std::exchange(length, 0);
    if (row.kind == RowKind::kEnd) {
      end_ = row.end;
      if (take_shape(kFinal)) final_shape_ = shape_.points;
      continue;
    }
    record.wall_time = row.wall_time;
    record.command = row.command;
    if (row.kind == RowKind::kAnsweredStep) record.steps.push_back(row.sample);
    record.answer = std::move(row.sample);
    const bool shape = take_shape(record.command.sequence);
    record.shape = shape ? shape_.points : Points();
    record.tension = shape ? shape_.tension : Eigen::VectorXd();
    record.readings = shape ? shape_.readings : std::nullopt;
    if (shape) final_shape_ = shape_.points;
    ++records_;
    return true;
  }
  return false;
}

SamplesWriter::File::File(std::string path_, const char* mode)
    : path(std::move(path_)), file(std::fopen(path.c_str(), mode), &std::fclose) {
  if (!file) throw CannotWrite(path);
  std::setvbuf(file.get(), nullptr, _IONBF, 0);
}

void SamplesWriter::File::append(const std::string& bytes) {
  struct stat status {};
  // What goes to a file without a name is lost with the process.
  if (fstat(fileno(file.get()), &status) != 0 || status.st_nlink == 0)
    throw std::runtime_error("the file " + path + " was removed while the test was running");
  if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) {
    const CannotWrite why(path);
    cut(size);
    throw why;
  }
  size += bytes.size();
}

void SamplesWriter::File::cut(std::uint64_t bytes) {
  // Where this fails a reader drops the torn end all the same.
  static_cast<void>(ftruncate(fileno(file.get()), static_cast<off_t>(bytes)) == 0);
  size = bytes;
}

SamplesWriter::SamplesWriter(const std::string& folder, bool shapes) : rows_(samples_file(folder), "abxe") {
  if (shapes) shapes_.emplace(shapes_file(folder), "abxe");
  rows_.append(head());
}

void SamplesWriter::append(const SamplesReader::Shape& shape) {
  if (!shapes_ || shape.points.cols() == 0) return;
  buffer_.assign(sizeof(std::uint64_t), '\0');
  Archive::to(buffer_).save(shape);
  const std::uint64_t length = htole64(buffer_.size() - sizeof(length));
  std::memcpy(buffer_.data(), &length, sizeof(length));
  shapes_->append(buffer_);
}

void SamplesWriter::append(const Record& record) {
  // Before its row: a row that is there has its shape.
  append({record.command.sequence, record.shape, record.tension, record.readings});
  buffer_.clear();
  std::size_t last = 0;  // where the last step begins
  for (const Sample& step : record.steps) {
    last = buffer_.size();
    append_row({RowKind::kStep, 0.0, {}, step, {}}, buffer_);
  }
  std::string answer;
  append_row({RowKind::kStep, 0.0, {}, record.answer, {}}, answer);
  const bool again = buffer_.compare(last, std::string::npos, answer) == 0;
  if (again) buffer_.resize(last);
  const RowKind kind = again ? RowKind::kAnsweredStep : RowKind::kAnswer;
  append_row({kind, record.wall_time, record.command, record.answer, {}}, buffer_);
  rows_.append(buffer_);
  last_ = record.answer;
}

void SamplesWriter::end(const TestEnd& end, const Points& final_shape) {
  append({SamplesReader::kFinal, final_shape, {}, {}});
  buffer_.clear();
  append_row({RowKind::kEnd, 0.0, {}, last_, end}, buffer_);
  rows_.append(buffer_);
}

}  // namespace knot_utm
