#include "knot_utm/numeric/archive.hpp"

#include <zlib.h>

#include <cctype>

#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

constexpr std::size_t kLengthBytes = 8, kSumBytes = 4;

std::string mark() { return "knot_utm "; }
std::string heading(const std::string& kind) { return mark() + kind + ", version " KNOT_UTM_VERSION "\n"; }

std::string little_endian(std::uint64_t value, std::size_t bytes) {
  std::string out;
  for (std::size_t i = 0; i < bytes; ++i) out += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  return out;
}

std::uint64_t from_little_endian(const std::string& bytes, std::size_t begin, std::size_t count) {
  std::uint64_t out = 0;
  for (std::size_t i = count; i-- > 0;) out = out << 8 | static_cast<unsigned char>(bytes[begin + i]);
  return out;
}

std::string checksum(const std::string& bytes, std::size_t length) {
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());
  return little_endian(crc32_z(crc32_z(0, nullptr, 0), data, length), kSumBytes);
}

}  // namespace

Archive::Archive(const std::string& kind, std::string bytes, const std::string& file)
    : kind_(kind), file_(file), own_(std::move(bytes)) {
  const std::string expected = heading(kind);
  if (own_.compare(0, expected.size(), expected) != 0) {
    const std::string given = own_.substr(0, std::min(own_.find('\n'), 2 * expected.size()));
    const bool ours = given.compare(0, mark().size(), mark()) == 0 &&
                      std::all_of(given.begin(), given.end(), [](unsigned char c) { return std::isprint(c) != 0; });
    complain("first line", ours ? "\"" + given + "\"" : "that of a foreign file",
             "\"" + expected.substr(0, expected.size() - 1) + "\"");
  }
  const std::size_t begin = expected.size() + kLengthBytes;
  const std::size_t around = begin + kSumBytes;
  if (own_.size() < around) complain("length", std::to_string(own_.size()) + " bytes", "that of a whole file");
  const std::uint64_t length = from_little_endian(own_, expected.size(), kLengthBytes);
  if (length != own_.size() - around)
    complain("length", std::to_string(own_.size()) + " bytes", std::to_string(around + length) + " bytes, as it says");
  const std::size_t end = own_.size() - kSumBytes;
  if (own_.compare(end, kSumBytes, checksum(own_, end)) != 0)
    complain("checksum", "another one", "that of its bytes, so the file is damaged");
  from_ = std::string_view(own_).substr(begin, end - begin);
}

void Archive::section(const char* tag) {
  if (!loads()) {
    *to_ += tag;
    return;
  }
  const std::string_view given = from_.substr(next_, std::strlen(tag));
  if (given != tag) refuse("section", "not \"" + std::string(tag) + "\"");
  next_ += given.size();
}

bool Archive::optional_section(const char* tag, bool there) {
  if (loads()) there = from_.substr(next_, std::strlen(tag)) == tag;
  if (there) section(tag);
  return there;
}

void Archive::visit(int& value) {
  if (!loads()) return put(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
  const auto given = static_cast<std::int64_t>(take());
  value = static_cast<int>(given);
  if (value != given) refuse("whole number", std::to_string(given));
}

void Archive::visit(bool& value) {
  if (!loads()) return put(value ? 1 : 0);
  const std::uint64_t given = take();
  if (given > 1) refuse("0 or 1", std::to_string(given));
  value = given == 1;
}

void Archive::visit(std::string& value) {
  if (!loads()) {
    put(value.size());
    *to_ += value;
    return;
  }
  const std::uint64_t length = take();
  if (length > left()) refuse("length of a text", std::to_string(length));
  value.assign(take(static_cast<std::size_t>(length)), static_cast<std::size_t>(length));
}

void Archive::number(const char* what, int& value, int low, int high) {
  visit(value);
  if (loads() && (value < low || value > high)) refuse(what, std::to_string(value));
}

void Archive::same(const char* what, std::int64_t value) {
  if (!loads()) return put(static_cast<std::uint64_t>(value));
  const auto given = static_cast<std::int64_t>(take());
  if (given != value) complain(what, std::to_string(given), std::to_string(value));
}

void Archive::require(bool right, const char* what, const std::string& value) const {
  if (!right && loads()) refuse(what, value);
}

std::string Archive::bytes() const {
  std::string out = heading(kind_);
  out += little_endian(own_.size(), kLengthBytes);
  out += own_;
  out += checksum(out, out.size());
  return out;
}

void Archive::end() const {
  if (left() != 0) complain("length", std::to_string(from_.size()) + " bytes", std::to_string(next_) + " bytes");
}

void Archive::refuse(const char* what, const std::string& value) const {
  complain(what, value, "what belongs to this rod and this method");
}

void Archive::complain(const std::string& what, const std::string& value, const std::string& allowed) const {
  throw InvalidInput::sentence(
      what, "the " + kind_ + " cannot be loaded: " + what + ": found " + value + ", expected " + allowed)
      .in_file(file_);
}

}  // namespace knot_utm
