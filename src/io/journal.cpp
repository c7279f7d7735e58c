#include "knot_utm/io/journal.hpp"

#include <endian.h>
#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "knot_utm/io/cannot_write.hpp"
#include "knot_utm/io/run_folder.hpp"
#include "knot_utm/specimen/knot.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "knot_utm journal\n";
constexpr std::uint32_t kVersion = 6;
constexpr std::size_t kWord = sizeof(std::uint32_t);
constexpr std::size_t kFrameHead = 2 * kWord;

void put_word(char* place, std::uint32_t value) {
  value = htole32(value);
  std::memcpy(place, &value, kWord);
}

std::uint32_t word(const char* place) {
  std::uint32_t value = 0;
  std::memcpy(&value, place, kWord);
  return le32toh(value);
}

std::uint32_t checksum(const char* length, std::string_view payload) {
  const auto bytes = [](const char* text) { return reinterpret_cast<const Bytef*>(text); };
  const uLong begin = crc32_z(0, bytes(length), kWord);
  return static_cast<std::uint32_t>(crc32_z(begin, bytes(payload.data()), payload.size()));
}

/// Behind what `buffer` holds, a frame of what is kept.
template <class T>
void append_frame(std::string& buffer, const T& kept) {
  const std::size_t head = buffer.size();
  buffer.append(kFrameHead, '\0');
  Archive::to(buffer).save(kept);
  const std::size_t length = buffer.size() - head - kFrameHead;
  if (length > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("a record of the test is larger than 4 GiB");
  put_word(&buffer[head], static_cast<std::uint32_t>(length));
  put_word(&buffer[head + kWord], checksum(&buffer[head], std::string_view(buffer).substr(head + kFrameHead)));
}

std::string beginning(const JournalHeader& header) {
  std::string bytes(kMagic);
  bytes.append(kWord, '\0');
  put_word(&bytes[kMagic.size()], kVersion);
  append_frame(bytes, header);
  return bytes;
}

}  // namespace

void JournalHeader::state(Archive& archive) {
  std::uint64_t sum = specimen;
  archive(method, sum, test);
  archive.require(sum <= std::numeric_limits<std::uint32_t>::max(), "checksum of the specimen", std::to_string(sum));
  if (archive.loads()) specimen = static_cast<std::uint32_t>(sum);
}

JournalHeader journal_header(const Method& method, const std::string& test) {
  JournalHeader header;
  header.method = method_file_text(method);
  if (knot_of(method.specimen).has("file")) {
    const std::string shape = read_whole(method.specimen.file);
    header.specimen =
        static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(shape.data()), shape.size()));
  }
  header.test = test;
  return header;
}

std::string journal_file(const std::string& folder) { return (fs::path(folder) / "journal").string(); }

JournalWriter::JournalWriter(const std::string& folder, int flags, double patience)
    : path_(journal_file(folder)), file_(path_, flags | O_RDWR | O_APPEND, patience) {}

JournalWriter::JournalWriter(const std::string& folder, const JournalHeader& header)
    : JournalWriter((make_run_folder(folder), folder), O_CREAT, 0.0) {
  require_open(folder);
  begin(header);
}

std::optional<JournalWriter> JournalWriter::begin_first(const std::string& folder, const JournalHeader& header) {
  make_run_folder(folder);
  JournalWriter writer(folder, O_CREAT, 0.0);
  if (!writer.file_.is_open() && errno == EWOULDBLOCK) return std::nullopt;
  writer.require_open(folder);
  if (fs::file_size(writer.path_) > 0) return std::nullopt;
  writer.begin(header);
  return writer;
}

void JournalWriter::require_open(const std::string& folder) const {
  if (file_.is_open()) return;
  const CannotWrite why(path_);
  if (why.out_of_room()) throw why;
  if (why.error != EWOULDBLOCK) throw InvalidInput::cannot_write("--out", folder, why.error);
  throw InvalidInput::sentence("--out", folder,
                               "another run is writing to the folder " + shown(folder) + ": choose another folder");
}

void JournalWriter::begin(const JournalHeader& header) {
  truncate_to(0);
  try {
    write(beginning(header));
  } catch (...) {
    remove();
    throw;
  }
}

JournalWriter JournalWriter::go_on(const std::string& folder, double patience) {
  JournalWriter writer(folder, 0, patience);
  if (!writer.file_.is_open()) {
    if (errno == EWOULDBLOCK) throw std::runtime_error("another run is writing " + writer.path_);
    throw CannotWrite(writer.path_);
  }
  writer.bytes_ = fs::file_size(writer.path_);
  return writer;
}

void JournalWriter::append(const Record& record) {
  // What goes to a file without a name is lost with the process.
  if (!file_.has_name()) throw std::runtime_error("the journal " + path_ + " was removed while the test was running");
  buffer_.clear();
  append_frame(buffer_, record);
  write(buffer_);
}

void JournalWriter::write(const std::string& bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t more = ::write(file_.descriptor(), bytes.data() + written, bytes.size() - written);
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) {
      const CannotWrite why(path_);
      // Where even this fails a reader stops at the piece all the same.
      static_cast<void>(ftruncate(file_.descriptor(), static_cast<off_t>(bytes_)) == 0);
      throw why;
    }
    written += static_cast<std::size_t>(more);
  }
  bytes_ += bytes.size();
}

void JournalWriter::truncate_to(std::uint64_t bytes) {
  if (ftruncate(file_.descriptor(), static_cast<off_t>(bytes)) != 0) throw CannotWrite(path_);
  bytes_ = bytes;
}

void JournalWriter::remove() {
  std::error_code error;
  fs::remove(path_, error);
}

JournalReader::JournalReader(const std::string& folder) : file_(journal_file(folder)), in_(file_, std::ios::binary) {
  std::error_code error;
  bytes_ = fs::file_size(file_, error);
  if (!in_ || error) throw InvalidInput::cannot_read(file_);
  std::array<char, kMagic.size() + kWord> begin{};
  in_.read(begin.data(), begin.size());
  if (!in_ || std::string_view(begin.data(), kMagic.size()) != kMagic) {
    throw InvalidInput::sentence("file", file_, "the file is no journal of knot_utm").in_file(file_);
  }
  const std::uint32_t version = word(begin.data() + kMagic.size());
  if (version != kVersion) {
    throw InvalidInput(file_, "the journal's version", std::to_string(version),
                       std::to_string(kVersion) + ", that of this program");
  }
  good_bytes_ = begin.size();
  if (!read_frame() || !load(header_))
    throw InvalidInput::sentence("file", file_, "the beginning of the journal is damaged").in_file(file_);
  good_bytes_ += kFrameHead + payload_.size();
}

bool JournalReader::read_frame() {
  std::array<char, kFrameHead> head{};
  if (bytes_ - good_bytes_ < head.size() || !in_.read(head.data(), head.size())) return false;
  const std::uint32_t length = word(head.data());
  if (length > bytes_ - good_bytes_ - head.size()) return false;
  payload_.resize(length);
  if (!in_.read(payload_.data(), length)) return false;
  return checksum(head.data(), payload_) == word(head.data() + kWord);
}

template <class T>
bool JournalReader::load(T& kept) const {
  try {
    Archive archive = Archive::from(payload_, "journal", file_);
    archive(kept);
    archive.end();
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

bool JournalReader::next(Record& record) {
  // Nothing behind a damaged frame is believed, though the stream stands behind it.
  if (!in_ || !read_frame() || !load(record)) {
    in_.setstate(std::ios::failbit);
    return false;
  }
  good_bytes_ += kFrameHead + payload_.size();
  ++records_;
  return true;
}

}  // namespace knot_utm
