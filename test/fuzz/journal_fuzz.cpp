// The journal of a run: the input as the file itself and, as no random bytes have the right checksum, in frames: as the
// header's payload, and as those of records, one from each line "--record" to the next.
#include <zlib.h>

#include <cstdint>
#include <vector>

#include "fuzz/scratch_folder.hpp"
#include "fuzz/target.hpp"
#include "knot_utm/io/journal.hpp"
#include "knot_utm/io/run_folder.hpp"

namespace knot_utm {

namespace {

std::string little_endian(std::uint32_t value) {
  std::string out;
  for (int i = 0; i < 4; ++i) out += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  return out;
}

std::string frame(const std::string& payload) {
  const std::string length = little_endian(static_cast<std::uint32_t>(payload.size())), all = length + payload;
  const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(all.data()), all.size());
  return length + little_endian(static_cast<std::uint32_t>(sum)) + payload;
}

std::string frames(const std::string& text) {
  const std::string mark = "\n--record\n";
  std::string out;
  for (std::size_t from = 0; from != std::string::npos;) {
    const std::size_t to = text.find(mark, from);
    out += frame(text.substr(from, to - from));
    from = to == std::string::npos ? to : to + mark.size();
  }
  return out;
}

/// What a journal begins with.
std::string beginning(const std::string& folder, const JournalHeader& header) {
  { const JournalWriter writer(folder, header); }
  return read_whole(journal_file(folder));
}

void read(const std::string& folder, const std::string& file) {
  write_whole(journal_file(folder), file);
  JournalReader reader(folder);
  std::uint64_t before = reader.good_bytes();
  std::vector<Record> records(1);
  while (reader.next(records.back())) {
    promise(reader.good_bytes() > before, "reading goes on, so that it ends");
    before = reader.good_bytes();
    records.emplace_back();
  }
  promise(reader.records() + 1 == records.size(), "records are counted");
  promise(reader.good_bytes() == before && before <= file.size(), "what is good is in the file");
  promise(reader.bytes_left() == file.size() - before, "the rest is what is left");
  promise(!reader.next(records.back()), "nothing behind the end is believed");

  records.pop_back();
  {
    JournalWriter writer(folder, reader.header());
    for (const Record& record : records) writer.append(record);
  }
  promise(read_whole(journal_file(folder)) == file.substr(0, before), "what was read is written to the same bytes");
}

void fuzz_journal(const std::string& text) {
  static const ScratchFolder folder;
  static const std::string good = beginning(folder.name(), {"specimen: {knot: straight}\n", 7, "test"});
  static const std::size_t words = good.find('\n') + 1 + sizeof(std::uint32_t);
  understood([&] { read(folder.name(), text); });
  understood([&] { read(folder.name(), good.substr(0, words) + frame(text)); });
  promise(understood([&] { read(folder.name(), good + frames(text)); }), "a journal whose header is whole is read");
}
const FuzzTarget journal("journal", fuzz_journal);

}  // namespace

}  // namespace knot_utm
