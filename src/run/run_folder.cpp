#include "knot_utm/run/run_folder.hpp"

#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/run/samples.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

namespace {

namespace fs = std::filesystem;

const std::string kResolved = "# Everything resolved: runs again to the same curve.\n";
const std::string kOptions = "# It was run with: ";  // below that
constexpr const char* kSpecimen = "specimen_";       // and a number, the folder of one

/// Files that a run overwrites when it begins, or leaves alone because another program owns them.
constexpr std::array<const char*, 4> kWritten{"method.yaml", "specimen.csv", "knot.yaml", "comparison.yaml"};
/// Files of an earlier run that it removes when it begins.
constexpr std::array<const char*, 13> kOld{
    "samples.csv", "shapes.bin", "curve.csv",   "curve_full.csv", "result.yaml",     "final_shape.csv", "shapes.csv",
    "test.bag",    "saved.bag",  "report.html", "report.pdf",     "statistics.yaml", "specimens.csv"};

/// What `compare --report` left; curves a.csv and b.csv without its comparison.yaml are somebody else's.
void remove_comparison(const fs::path& folder) {
  std::error_code error;
  if (!fs::remove(folder / "comparison.yaml", error)) return;
  for (const char* curve : {"a.csv", "b.csv"}) fs::remove(folder / curve, error);
}

void put_copy(const fs::path& file, const fs::path& copy) {
  std::error_code error;
  // A run repeated from its own folder reads this very file.
  if (fs::equivalent(file, copy, error)) return;
  fs::copy_file(file, copy, fs::copy_options::overwrite_existing, error);
  if (error) throw CannotWrite(copy.string(), error.value());
}

/// Of a user's file. Knots that come with the package go by their names.
bool is_own_knot(const Method& method) {
  return method.specimen.drawing && fs::path(method.specimen.drawing->name).is_absolute();
}

std::string for_shell(const std::string& word) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

}  // namespace

std::optional<std::string> result_of(const std::string& folder, const std::string& key) {
  std::ifstream result(fs::path(folder) / "result.yaml");
  const std::string begin = key + ": ";
  for (std::string line; std::getline(result, line);) {
    if (line.rfind(begin, 0) == 0) return line.substr(begin.size());
  }
  return std::nullopt;
}

void make_folder(const std::string& folder, const char* argument) {
  std::error_code error, other;
  fs::create_directories(folder, error);
  if (fs::is_directory(folder, other)) return;
  throw InvalidInput::sentence(argument,
                               "cannot make the folder \"" + shown(folder) + "\": " + reason_of(error.value()));
}

void require_new_file(const char* argument, const std::string& file, const std::vector<std::string>& inputs,
                      bool overwrite, const std::string& begins) {
  std::error_code error;
  const auto refuse = [&](const std::string& why) {
    throw InvalidInput::sentence(argument, std::string(argument) + ": " + shown(file) + why);
  };
  for (const std::string& input : inputs)
    if (fs::equivalent(file, input, error)) refuse(" is an input, and would be written over: give another name");
  if (!fs::exists(fs::symlink_status(file, error))) return;
  if (!overwrite) refuse(" exists already: give another name, or --overwrite");
  if (begins.empty() || !fs::is_regular_file(file, error)) return;
  std::ifstream in(file, std::ios::binary);
  std::string head(begins.size(), '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head != begins) refuse(" is a file of another kind, which --overwrite does not replace: give another name");
}

std::string method_file_text(const Method& method) {
  Method own = method;
  if (knot_of(own.specimen).has("file")) own.specimen.file = "specimen.csv";
  if (is_own_knot(own)) {
    auto beside = std::make_shared<KnotDrawing>(*own.specimen.drawing);
    beside->name = "knot.yaml";
    own.specimen.drawing = beside;
  }
  return kResolved + method_yaml(own);
}

void require_no_record_in(const std::string& folder, const Method& method) {
  std::error_code error;
  for (const ProgramStep& step : method.program)
    if (const FollowStep* follow = step.as<FollowStep>();
        follow && fs::equivalent(fs::path(follow->record).parent_path(), folder, error))
      throw InvalidInput::sentence("--out", "the method follows " + shown(follow->record) +
                                                ", which stands in the folder " + shown(folder) +
                                                " itself: choose another folder to write to");
}

void require_no_method_in(const std::string& folder, const std::string& method_file) {
  std::error_code error;
  const fs::path written = fs::path(folder) / "method.yaml";
  if (!fs::equivalent(written, method_file, error) || read_whole(method_file).rfind(kResolved, 0) == 0) return;
  throw InvalidInput::sentence("--out", "the run would write over its own method, " + shown(written.string()) +
                                            ": choose another folder to write to");
}

void begin_run_folder(const std::string& folder, const Method& method, const std::string& options) {
  std::error_code error;
  require_no_record_in(folder, method);
  if (knot_of(method.specimen).has("file")) put_copy(method.specimen.file, fs::path(folder) / "specimen.csv");
  if (is_own_knot(method)) put_copy(method.specimen.drawing->name, fs::path(folder) / "knot.yaml");
  // Not before the specimen has been read: it may be the shape that the last run left here.
  for (const char* old : kOld) fs::remove(fs::path(folder) / old, error);
  remove_comparison(folder);
  std::string text = method_file_text(method);
  if (!options.empty()) text.insert(kResolved.size(), kOptions + options + "\n");
  try {
    write_whole((fs::path(folder) / "method.yaml").string(), text);
  } catch (const CannotWrite& why) {
    if (why.out_of_room()) throw;
    throw InvalidInput::cannot_write("--out", folder, why.error);
  }
}

std::string options_of_run(const std::string& folder) {
  std::ifstream method(fs::path(folder) / "method.yaml");
  std::string line;
  for (int row = 0; row < 2; ++row) std::getline(method, line);
  return line.rfind(kOptions, 0) == 0 ? line.substr(kOptions.size()) : "";
}

std::string specimen_folder(const std::string& folder, int number) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%s%03d", kSpecimen, number);
  return (fs::path(folder) / name.data()).string();
}

bool holds_run(const std::string& folder) {
  std::error_code error;
  const auto stands = [&](const char* name) { return fs::is_regular_file(fs::path(folder) / name, error); };
  return std::any_of(kWritten.begin(), kWritten.end(), stands) || std::any_of(kOld.begin(), kOld.end(), stands) ||
         !specimen_folders(folder).empty();
}

std::vector<std::string> specimen_folders(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool numbered = name.rfind(kSpecimen, 0) == 0 && name.size() >= std::strlen(kSpecimen) + 3 &&
                          name.find_first_not_of("0123456789", std::strlen(kSpecimen)) == std::string::npos;
    if (numbered && entry.is_directory(error)) found.push_back(entry.path().string());
  }
  return found;
}

std::string numbered_folder(const std::string& folder, int number) {
  if (number == 1) return folder;
  fs::path path = fs::path(folder).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  std::error_code error;
  if (path == "." || path.filename() == "..") path = fs::weakly_canonical(path, error);
  return path.string() + "-" + std::to_string(number);
}

bool has_complete_result(const std::string& folder) {
  const std::optional<std::string> ended_by = result_of(folder, "ended_by"), reason = result_of(folder, "reason");
  const bool interrupted = reason && *reason == '"' + std::string(kInterrupted) + '"';
  return ended_by && *ended_by != ended_by_name(EndedBy::kNotYet) && !interrupted;
}

std::string what_stands(const std::string& folder) {
  std::error_code error;
  if (!fs::exists(samples_file(folder), error)) return "";
  return "; what was measured until then stands in " + samples_file(folder) +
         ", make the results of it by: " + command_line({program_beside("tensile_test"), "--from-samples", folder});
}

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

std::string read_input(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream all;
  if (in.peek() != std::ifstream::traits_type::eof()) all << in.rdbuf();
  if (!in) throw InvalidInput::cannot_read(file);
  return all.str();
}

std::string read_whole(const std::string& file) {
  try {
    return read_input(file);
  } catch (const InvalidInput& invalid) {
    throw std::runtime_error(invalid.what());
  }
}

ClaimedFolder::ClaimedFolder(const std::string& folder) : ClaimedFolder() {
  if (!claim(folder)) throw InvalidInput::sentence("--out", "another run is writing to the folder " + shown(folder));
}

ClaimedFolder ClaimedFolder::first_free(const std::string& folder) {
  for (int number = 1;; ++number) {
    const std::string candidate = numbered_folder(folder, number);
    ClaimedFolder claimed;
    // Another run may have written its results between the look and the claim.
    if (!holds_run(candidate) && claimed.claim(candidate) && !holds_run(candidate)) return claimed;
  }
}

bool ClaimedFolder::claim(const std::string& folder) {
  make_folder(folder, "--out");
  path_ = folder;
  folder_.reset(opendir(folder.c_str()));
  if (!folder_) throw InvalidInput::cannot_write("--out", folder, errno);
  // A file system without locks leaves it to samples.csv, which nobody begins twice.
  return flock(dirfd(folder_.get()), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

std::string free_folder(const std::string& folder) {
  int number = 1;
  while (holds_run(numbered_folder(folder, number))) ++number;
  return numbered_folder(folder, number);
}

std::string moved_notice(const std::string& asked, const std::string& used) {
  return asked + " holds a run already, which stays as it is; this one is written to " + used;
}

std::string point_latest_to(const std::string& folder) {
  std::error_code error;
  fs::path run = fs::absolute(folder, error).lexically_normal();
  if (!run.has_filename()) run = run.parent_path();
  if (fs::is_symlink(run, error)) run = run.parent_path() / fs::read_symlink(run, error);
  if (error || run.parent_path().filename() != "out") return {};
  const fs::path link = run.parent_path() / "latest";
  const fs::file_status there = fs::symlink_status(link, error);
  if (fs::exists(there) && !fs::is_symlink(there)) return {};
  // Another run may end at the same time: the link is replaced at once, and is never missing.
  const fs::path part = run.parent_path() / (".latest-" + std::to_string(getpid()));
  fs::remove(part, error);
  fs::create_directory_symlink(run.filename(), part, error);
  if (error) return {};
  fs::rename(part, link, error);
  if (error) {
    std::error_code ignored;
    fs::remove(part, ignored);
    return {};
  }
  return fs::path(folder).is_absolute() ? link.string() : link.lexically_proximate(fs::current_path(error)).string();
}

std::string command_line(int argc, const char* const* argv) { return command_line({argv, argv + argc}); }

std::string command_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + for_shell(word);
  return line;
}

std::string program_beside(const std::string& name) {
  std::error_code error;
  const fs::path running = fs::read_symlink("/proc/self/exe", error);
  if (error) return name;
  const fs::path file = running.parent_path() / name, near = file.lexically_proximate(fs::current_path(error));
  return error || near.empty() || *near.begin() == ".." ? file.string() : near.string();
}

}  // namespace knot_utm
