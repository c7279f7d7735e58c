#include "knot_utm/run/checkpoint.hpp"

#include <zlib.h>

#include <filesystem>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/run/run_folder.hpp"

namespace knot_utm {

namespace {

namespace fs = std::filesystem;

constexpr const char* kKind = "checkpoint";

}  // namespace

Checkpoint::Checkpoint(const std::string& folder, const std::string& method)
    : file_((fs::path(folder) / "checkpoint").string()),
      method_(static_cast<std::int64_t>(crc32_z(0, reinterpret_cast<const Bytef*>(method.data()), method.size()))) {}

void Checkpoint::visit(Archive& archive, TestingMachine& bench, ProgramRunner& program) const {
  archive.same("checksum of method.yaml", method_);
  archive(program, bench);
}

void Checkpoint::write(TestingMachine& bench, ProgramRunner& program) const {
  Archive archive(kKind);
  visit(archive, bench, program);
  write_whole(file_, archive.bytes());
}

bool Checkpoint::is_there() const {
  std::error_code error;
  return fs::exists(file_, error);
}

void Checkpoint::load(TestingMachine& bench, ProgramRunner& program) const {
  Archive archive(kKind, read_whole(file_), file_);
  visit(archive, bench, program);
  archive.end();
  // A command is at most a longest step ahead; twice that leaves room for rounding.
  const double ahead = program.last().time - bench.time();
  archive.require(ahead >= 0.0 && ahead <= 2.0 * bench.longest_step(), "next command",
                  format_number(ahead) + " s ahead of the physics");
}

}  // namespace knot_utm
