#include "knot_utm/io/report.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "knot_utm/io/run_facts.hpp"
#include "knot_utm/io/run_folder.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/number.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPython = "/usr/bin/python3";  // Debian's, which has Debian's packages

/// An installed executable looks beside itself first, as it does for materials.
fs::path script() {
  const fs::path name = fs::path("report") / "make_report.py";
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = executable.parent_path() / ".." / ".." / "share" / "knot_utm" / name;
  if (!error && fs::is_regular_file(installed, error)) return installed.lexically_normal();
  return fs::path(KNOT_UTM_REPORT_DIR) / "make_report.py";
}

std::runtime_error cannot_run(int error) {
  return std::runtime_error(std::string("the report cannot be written: cannot run ") + kPython + ": " +
                            reason_of(error));
}

/// One end is ours, one the program's.
class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) throw cannot_run(errno);
  }
  ~Pipe() {
    close(ends_[0]);
    close_entrance();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int entrance() const { return ends_[1]; }
  void close_entrance() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

  /// Until nobody can write any more.
  std::string read_all() const {
    std::string all;
    std::array<char, 4096> part{};
    for (;;) {
      const ssize_t size = ::read(ends_[0], part.data(), part.size());
      if (size < 0 && errno == EINTR) continue;
      if (size <= 0) return all;
      all.append(part.data(), static_cast<std::size_t>(size));
    }
  }

 private:
  std::array<int, 2> ends_{};
};

/// What a program said, on whichever stream, and how it ended.
struct Ended {
  std::string said;
  int status = 0;  ///< as waitpid gives it
};

/// Runs a program to its end, without a shell.
Ended run(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

  Pipe pipe;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe.entrance(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipe.entrance(), STDERR_FILENO);
  pid_t child = 0;
  const int error = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw cannot_run(error);

  pipe.close_entrance();
  Ended ended;
  ended.said = pipe.read_all();
  while (waitpid(child, &ended.status, 0) < 0 && errno == EINTR) continue;
  return ended;
}

/// What went wrong stands in the last line, as of every Python that fails.
std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \n");
  if (end == std::string::npos) return {};
  const std::size_t before = text.rfind('\n', end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return text.substr(begin, end + 1 - begin);
}

constexpr std::array<const char*, 5> kOfComparison{"comparison.yaml", "a.csv", "b.csv", "report.html", "report.pdf"};

/// Whether something stands in the folder that a comparison would write over, but for the very same comparison, or a
/// run, whose page it would take.
bool holds_another(const fs::path& folder, const std::string& yaml) {
  std::error_code error;
  const fs::path before = folder / kOfComparison.front();
  if (fs::is_regular_file(before, error)) return read_whole(before.string()) != yaml;
  for (const char* name :
       {"a.csv", "b.csv", "report.html", "report.pdf", "result.yaml", "statistics.yaml", "samples.csv"})
    if (fs::is_regular_file(folder / name, error)) return true;
  return false;
}

void require_room_for_comparison(const std::string& folder, const std::string& file_a, const std::string& file_b) {
  const fs::path where(folder);
  std::error_code error;
  if (fs::exists(where / "result.yaml", error))
    throw InvalidInput::sentence(
        "--report", folder,
        "the folder " + shown(folder) + " holds a run: choose another folder for the report of the comparison");
  for (const char* name : kOfComparison) {
    for (const std::string& compared : {file_a, file_b}) {
      if (fs::equivalent(where / name, compared, error))
        throw InvalidInput::sentence("--report", folder,
                                     "the report would write over " + shown((where / name).string()) +
                                         ", which is compared: choose another folder");
    }
  }
}

std::string pull_csv(const Pull& pull) {
  std::string text = "extension,load\nm,N\n";
  for (const PullPoint& point : pull) text += format_number(point.extension) + "," + format_number(point.force) + "\n";
  return text;
}

}  // namespace

void write_report(const std::string& folder, const std::string& command) {
  // -E, -s: what the user's own Python is made to find is not what Debian's packages were made for; -B: nothing is
  // written beside the script. Where it succeeds what it says are warnings of libraries.
  const Ended ended =
      run({kPython, "-EsB", script().string(), "--command", command, "--version", version(), "--", folder});
  if (WIFEXITED(ended.status) && WEXITSTATUS(ended.status) == 0) return;
  const std::string line = last_line(ended.said);
  throw std::runtime_error(
      line.empty() ? "the report was not written: " + std::string(kPython) + " failed without a message" : line);
}

std::string write_comparison(const std::string& asked, const std::string& yaml, const Pull& a, const Pull& b,
                             const std::string& file_a, const std::string& file_b, bool overwrite) {
  require_room_for_comparison(asked, file_a, file_b);
  std::string folder = asked;
  for (int number = 2; !overwrite && holds_another(folder, yaml); ++number) folder = numbered_folder(asked, number);
  require_room_for_comparison(folder, file_a, file_b);
  const fs::path where(folder);
  make_folder(folder, "--report");
  const std::array<std::string, 3> texts{yaml, pull_csv(a), pull_csv(b)};
  for (std::size_t i = 0; i < texts.size(); ++i) write_whole((where / kOfComparison[i]).string(), texts[i]);
  return folder;
}

}  // namespace knot_utm
