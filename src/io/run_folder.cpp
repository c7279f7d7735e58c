#include "knot_utm/io/run_folder.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "knot_utm/io/cannot_write.hpp"
#include "knot_utm/rod/invalid_input.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFailedStep = "failed_step.bin";

/// What `compare --report` left; curves a.csv and b.csv without its comparison.yaml are somebody else's.
void remove_comparison(const fs::path& folder) {
  std::error_code error;
  if (!fs::remove(folder / "comparison.yaml", error)) return;
  for (const char* curve : {"a.csv", "b.csv"}) fs::remove(folder / curve, error);
}

}  // namespace

void make_folder(const std::string& folder, const char* argument) {
  std::error_code error, other;
  fs::create_directories(folder, error);
  if (fs::is_directory(folder, other)) return;
  throw InvalidInput::sentence(argument, folder,
                               "cannot make the folder \"" + shown(folder) + "\": " + reason_of(error.value()));
}

void make_run_folder(const std::string& folder) { make_folder(folder, "--out"); }

std::string method_file_text(const Method& method) {
  Method own = method;
  if (own.specimen.knot == KnotKind::kFile) own.specimen.file = "specimen.csv";
  return "# Everything resolved: runs again to the same curve.\n" + method_yaml(own);
}

void require_no_record_in(const std::string& folder, const Method& method) {
  std::error_code error;
  for (const ProgramStep& step : method.program)
    if (step.phase == Phase::kFollow && fs::equivalent(fs::path(step.record).parent_path(), folder, error))
      throw InvalidInput::sentence("--out", folder,
                                   "the method follows " + shown(step.record) + ", which stands in the folder " +
                                       shown(folder) + " itself: choose another folder to write to");
}

void begin_run_folder(const std::string& folder, const Method& method) {
  std::error_code error;
  require_no_record_in(folder, method);
  if (method.specimen.knot == KnotKind::kFile) {
    const fs::path copy = fs::path(folder) / "specimen.csv";
    // A run repeated from its own folder reads this very file.
    if (!fs::equivalent(method.specimen.file, copy, error)) {
      fs::copy_file(method.specimen.file, copy, fs::copy_options::overwrite_existing, error);
      if (error) throw CannotWrite(copy.string(), error.value());
    }
  }
  // Not before the specimen has been read: it may be the shape that the last run left here.
  for (const char* old :
       {"result.yaml", "final_shape.csv", "test.bag", "saved.bag", "report.html", "report.pdf", kFailedStep})
    fs::remove(fs::path(folder) / old, error);
  remove_comparison(folder);
  try {
    write_whole((fs::path(folder) / "method.yaml").string(), method_file_text(method));
  } catch (const CannotWrite& why) {
    if (why.out_of_room()) throw;
    throw InvalidInput::cannot_write("--out", folder, why.error);
  }
}

bool has_complete_result(const std::string& folder) {
  std::ifstream result(fs::path(folder) / "result.yaml");
  const std::string key = "ended_by: ";
  for (std::string line; std::getline(result, line);) {
    if (line.rfind(key, 0) == 0) return line.substr(key.size()) != ended_by_name(EndedBy::kNotYet);
  }
  return false;
}

std::string failed_step_file(const std::string& folder) { return (fs::path(folder) / kFailedStep).string(); }

void write_whole(const std::string& file, const std::string& text) {
  const std::string part = file + ".part";
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  std::error_code error;
  if (!out) {
    const CannotWrite why(file);
    fs::remove(part, error);
    throw why;
  }
  fs::rename(part, file, error);
  if (error) throw CannotWrite(file, error.value());
}

std::string read_whole(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream all;
  if (in.peek() != std::ifstream::traits_type::eof()) all << in.rdbuf();
  if (!in) throw std::runtime_error(InvalidInput::cannot_read(file).what());
  return all.str();
}

std::string read_input(const std::string& file) {
  try {
    return read_whole(file);
  } catch (const std::runtime_error&) {
    throw InvalidInput::cannot_read(file);
  }
}

}  // namespace knot_utm
