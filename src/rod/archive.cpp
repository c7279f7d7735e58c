#include "knot_utm/rod/archive.hpp"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "knot_utm/rod/invalid_input.hpp"

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

Archive::Archive(const std::string& kind, const std::string& bytes, const std::string& file)
    : kind_(kind), file_(file), loads_(true) {
  const std::string expected = heading(kind);
  if (bytes.compare(0, expected.size(), expected) != 0) {
    const std::string given = bytes.substr(0, std::min(bytes.find('\n'), 2 * expected.size()));
    const bool ours = given.compare(0, mark().size(), mark()) == 0 &&
                      std::all_of(given.begin(), given.end(), [](unsigned char c) { return std::isprint(c) != 0; });
    complain("first line", ours ? "\"" + given + "\"" : "that of a foreign file",
             "\"" + expected.substr(0, expected.size() - 1) + "\"");
  }
  const std::size_t begin = expected.size() + kLengthBytes;
  const std::size_t around = begin + kSumBytes;
  if (bytes.size() < around) complain("length", std::to_string(bytes.size()) + " bytes", "that of a whole file");
  const std::uint64_t length = from_little_endian(bytes, expected.size(), kLengthBytes);
  if (length != bytes.size() - around)
    complain("length", std::to_string(bytes.size()) + " bytes", std::to_string(around + length) + " bytes, as it says");
  const std::size_t end = bytes.size() - kSumBytes;
  if (bytes.compare(end, kSumBytes, checksum(bytes, end)) != 0)
    complain("checksum", "that of a damaged file", "that of its bytes");
  body_ = bytes.substr(begin, end - begin);
}

void Archive::section(const char* tag) {
  if (!loads_) {
    body_ += tag;
    return;
  }
  const std::string given = body_.substr(std::min(next_, body_.size()), std::strlen(tag));
  require(given == tag, "section", "not \"" + std::string(tag) + "\"");
  next_ += given.size();
}

void Archive::visit(std::uint64_t& value) {
  constexpr std::size_t kBytes = 8;
  if (!loads_) {
    body_ += little_endian(value, kBytes);
    return;
  }
  require(body_.size() - next_ >= kBytes, "length", std::to_string(body_.size()) + " bytes");
  value = from_little_endian(body_, next_, kBytes);
  next_ += kBytes;
}

void Archive::visit(double& value) {
  static_assert(sizeof(double) == sizeof(std::uint64_t));
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  visit(bits);
  std::memcpy(&value, &bits, sizeof bits);
}

void Archive::visit(int& value) {
  auto bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
  visit(bits);
  value = static_cast<int>(static_cast<std::int64_t>(bits));
}

void Archive::visit(bool& value) {
  std::uint64_t bit = value ? 1 : 0;
  visit(bit);
  value = bit != 0;
}

void Archive::visit(std::string& value) {
  std::uint64_t length = value.size();
  visit(length);
  if (!loads_) {
    body_ += value;
    return;
  }
  require(length <= body_.size() - next_, "length of a text", std::to_string(length));
  value = body_.substr(next_, static_cast<std::size_t>(length));
  next_ += value.size();
}

void Archive::number(const char* what, int& value, int low, int high) {
  visit(value);
  require(value >= low && value <= high, what, std::to_string(value));
}

void Archive::same(const char* what, std::int64_t value) {
  auto bits = static_cast<std::uint64_t>(value);
  visit(bits);
  const auto given = static_cast<std::int64_t>(bits);
  if (given != value) complain(what, std::to_string(given), std::to_string(value) + ", as here");
}

void Archive::require(bool right, const char* what, const std::string& value) const {
  if (!right && loads_) complain(what, value, "the " + kind_ + " of what it is loaded into");
}

std::string Archive::bytes() const {
  std::string out = heading(kind_);
  out += little_endian(body_.size(), kLengthBytes);
  out += body_;
  out += checksum(out, out.size());
  return out;
}

void Archive::end() const {
  if (next_ != body_.size())
    complain("length", std::to_string(body_.size()) + " bytes", std::to_string(next_) + " bytes");
}

void Archive::complain(const std::string& what, const std::string& value, const std::string& allowed) const {
  throw InvalidInput(file_, what, value, allowed);
}

}  // namespace knot_utm
