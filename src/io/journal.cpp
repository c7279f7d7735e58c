#include "knot_utm/io/journal.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <limits>
#include <thread>
#include <utility>

#include "journal_codec.hpp"
#include "knot_utm/io/cannot_write.hpp"
#include "knot_utm/io/run_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "knot_utm journal\n";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kWord = sizeof(std::uint32_t);
constexpr std::size_t kFrameHead = 2 * kWord;
constexpr std::chrono::milliseconds kTryAgain(20);  // for a journal that another holds

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

/// Behind what `buffer` holds, a frame with the payload that `encode` appends.
template <class Encode>
void append_frame(std::string& buffer, Encode encode) {
  const std::size_t head = buffer.size();
  buffer.append(kFrameHead, '\0');
  journal::Encoder encoder(buffer);
  encode(encoder);
  const std::size_t length = buffer.size() - head - kFrameHead;
  if (length > std::numeric_limits<std::uint32_t>::max()) throw std::length_error("a record beyond 4 GiB");
  put_word(&buffer[head], static_cast<std::uint32_t>(length));
  put_word(&buffer[head + kWord], checksum(&buffer[head], std::string_view(buffer).substr(head + kFrameHead)));
}

std::string beginning(const JournalHeader& header) {
  std::string bytes(kMagic);
  bytes.append(kWord, '\0');
  put_word(&bytes[kMagic.size()], kVersion);
  append_frame(bytes, [&](journal::Encoder& encoder) {
    encoder(header.method);
    encoder(static_cast<std::uint64_t>(header.specimen));
    encoder(header.test);
  });
  return bytes;
}

/// Opens a file that this process alone holds then; -1 and errno where it cannot, EWOULDBLOCK: another holds it.
int open_alone(const std::string& file, int flags, double patience) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(patience);
  for (;;) {
    const int descriptor = open(file.c_str(), flags | O_RDWR | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor < 0) return -1;
    // A file system without locks keeps nobody out.
    const bool held_by_another = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    struct stat status {};
    // The one before may have removed it meanwhile.
    if (!held_by_another && fstat(descriptor, &status) == 0 && status.st_nlink > 0) return descriptor;
    close(descriptor);
    if (held_by_another && Clock::now() >= end) {
      errno = EWOULDBLOCK;
      return -1;
    }
    if (held_by_another) std::this_thread::sleep_for(kTryAgain);
  }
}

}  // namespace

JournalHeader journal_header(const Method& method, const std::string& test) {
  JournalHeader header;
  header.method = method_file_text(method);
  if (method.specimen.knot == KnotKind::kFile) {
    const std::string shape = read_whole(method.specimen.file);
    header.specimen =
        static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(shape.data()), shape.size()));
  }
  header.test = test;
  return header;
}

std::string journal_file(const std::string& folder) { return (fs::path(folder) / "journal").string(); }

JournalWriter::JournalWriter(std::string file, int descriptor, std::uint64_t bytes)
    : file_(std::move(file)), descriptor_(descriptor), bytes_(bytes) {}

JournalWriter::JournalWriter(const std::string& folder, const JournalHeader& header)
    : JournalWriter(journal_file(folder), -1, 0) {
  make_run_folder(folder);
  descriptor_ = open_alone(file_, O_CREAT, 0.0);
  if (descriptor_ < 0) {
    throw InvalidInput(
        "--out", folder,
        errno == EWOULDBLOCK ? "a folder that no other run is writing to" : "a folder that can be written to");
  }
  truncate_to(0);
  try {
    write(beginning(header));
  } catch (...) {
    remove();
    throw;
  }
}

JournalWriter JournalWriter::go_on(const std::string& folder, double patience) {
  const std::string file = journal_file(folder);
  const int descriptor = open_alone(file, 0, patience);
  if (descriptor < 0 && errno == EWOULDBLOCK) throw std::runtime_error(file + ": another run is writing it");
  if (descriptor < 0) throw cannot_write(file);
  struct stat status {};
  fstat(descriptor, &status);
  return JournalWriter(file, descriptor, static_cast<std::uint64_t>(status.st_size));
}

JournalWriter::~JournalWriter() {
  if (descriptor_ >= 0) close(descriptor_);
}

JournalWriter::JournalWriter(JournalWriter&& other) noexcept
    : file_(std::move(other.file_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      bytes_(other.bytes_),
      buffer_(std::move(other.buffer_)) {}

void JournalWriter::append(const Record& record) {
  struct stat status {};
  // What goes to a file without a name is lost with the process.
  if (fstat(descriptor_, &status) != 0 || status.st_nlink == 0) throw std::runtime_error(file_ + ": was removed");
  buffer_.clear();
  append_frame(buffer_, [&](journal::Encoder& encoder) { journal::fields(encoder, record); });
  write(buffer_);
}

void JournalWriter::write(const std::string& bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t more = ::write(descriptor_, bytes.data() + written, bytes.size() - written);
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) {
      const std::runtime_error why = cannot_write(file_);
      // Where even this fails a reader stops at the piece all the same.
      static_cast<void>(ftruncate(descriptor_, static_cast<off_t>(bytes_)) == 0);
      throw why;
    }
    written += static_cast<std::size_t>(more);
  }
  bytes_ += bytes.size();
}

void JournalWriter::truncate_to(std::uint64_t bytes) {
  if (ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0) throw cannot_write(file_);
  bytes_ = bytes;
}

void JournalWriter::remove() {
  std::error_code error;
  fs::remove(file_, error);
}

JournalReader::JournalReader(const std::string& folder) : file_(journal_file(folder)), in_(file_, std::ios::binary) {
  std::error_code error;
  bytes_ = fs::file_size(file_, error);
  if (!in_ || error) throw InvalidInput("file", file_, "a journal that can be read");
  std::array<char, kMagic.size() + kWord> begin{};
  in_.read(begin.data(), begin.size());
  if (!in_ || std::string_view(begin.data(), kMagic.size()) != kMagic) {
    throw InvalidInput("file", file_, "a journal of knot_utm");
  }
  const std::uint32_t version = word(begin.data() + kMagic.size());
  if (version != kVersion) {
    throw InvalidInput(file_, "version", std::to_string(version), std::to_string(kVersion));
  }
  good_bytes_ = begin.size();
  journal::Decoder decoder(read_frame() ? payload_ : std::string_view());
  std::uint64_t specimen = 0;
  decoder(header_.method);
  decoder(specimen);
  decoder(header_.test);
  header_.specimen = static_cast<std::uint32_t>(specimen);
  if (!decoder.good()) throw InvalidInput("file", file_, "a journal whose header is whole");
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

bool JournalReader::next(Record& record) {
  // Nothing behind a damaged frame is believed, though the stream stands behind it.
  if (!in_ || !read_frame()) {
    in_.setstate(std::ios::failbit);
    return false;
  }
  journal::Decoder decoder(payload_);
  journal::fields(decoder, record);
  if (!decoder.good()) {
    in_.setstate(std::ios::failbit);
    return false;
  }
  good_bytes_ += kFrameHead + payload_.size();
  ++records_;
  return true;
}

}  // namespace knot_utm
