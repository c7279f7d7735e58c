#include "knot_utm/study/batch.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <map>
#include <mutex>
#include <regex>
#include <set>
#include <stdexcept>
#include <thread>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/known_names.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/study/specimens.hpp"
#include "knot_utm/verdict/foreseen.hpp"

namespace knot_utm {

namespace {

namespace fs = std::filesystem;

std::string without_numbers(const std::string& line) {
  static const std::regex number("[-+]?[0-9][0-9.]*(e[-+]?[0-9]+)?");
  return std::regex_replace(line, number, "#");
}

/// Tests the specimens, each by the next thread that is free.
class SideBySide {
 public:
  SideBySide(const std::string& folder, const std::vector<DrawnSpecimen>& specimens, const BatchOptions& options)
      : folder_(folder), specimens_(specimens), options_(options) {}

  void run() {
    std::vector<std::thread> threads;
    const std::size_t jobs = std::clamp<std::size_t>(static_cast<std::size_t>(options_.jobs), 1, specimens_.size());
    for (std::size_t i = 1; i < jobs; ++i) threads.emplace_back([this] { work(); });
    work();
    for (std::thread& thread : threads) thread.join();
  }

  bool interrupted() const { return interrupted_; }
  /// What is known of the method before any test. `auto` is no word of what was drawn from it.
  void tell_of_all(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) {
      options_.tell(warning);
      told_.insert(without_numbers(warning));
    }
  }
  /// What the tests said, each once with the specimens that it is about: "specimens 1, 2 and 5: ...". Lines that differ
  /// by their numbers alone are one.
  void tell() const {
    for (const auto& [words, lines] : said_) {
      if (told_.count(words) > 0) continue;
      std::vector<std::string> who;
      bool same = true;
      const auto& [first, line] = *lines.begin();
      for (const auto& [number, its_own] : lines) {
        who.push_back(std::to_string(number));
        same &= its_own == line;
      }
      const std::string of_first = same ? "" : ", with the numbers of specimen " + std::to_string(first);
      options_.tell((who.size() > 1 ? "specimens " : "specimen ") + listed(who, " and ") + of_first + ": " + line);
    }
  }
  /// What kept a test from being run, such as a full disk; empty: nothing did.
  const std::string& fault() const { return fault_; }

 private:
  bool stops() const { return stops_ || options_.interrupted(); }

  void work() {
    for (std::size_t i = next_++; i < specimens_.size() && !stops(); i = next_++) test(specimens_[i]);
    if (stops()) interrupted_ = true;
  }

  void test(const DrawnSpecimen& specimen) {
    try {
      if (!has_complete_result(specimen_folder(folder_, specimen.number))) {
        const HeadlessOutcome outcome = run_headless(specimen.method, options_of(specimen));
        if (!outcome.ended) interrupted_ = true;
      }
    } catch (const std::exception& error) {
      const std::lock_guard<std::mutex> lock(telling_);
      if (fault_.empty()) fault_ = "specimen " + std::to_string(specimen.number) + ": " + error.what();
      stops_ = true;
      return;
    }
    const std::lock_guard<std::mutex> lock(telling_);
    ++ended_;
    if (options_.progress) options_.progress(ended_, static_cast<int>(specimens_.size()));
  }

  HeadlessOptions options_of(const DrawnSpecimen& specimen) {
    HeadlessOptions out;
    out.folder = specimen_folder(folder_, specimen.number);
    out.overwrite = true;  // what stands there was cut off, or is an earlier batch's, which the whole one writes over
    out.shapes = options_.shapes;
    out.cache = options_.cache;
    out.readings = options_.readings;
    out.interrupted = [this] { return stops(); };
    const int number = specimen.number;
    out.notice = [this, number](const std::string& line) {
      const std::lock_guard<std::mutex> lock(telling_);
      said_[without_numbers(line)].emplace(number, line);
    };
    if (options_.remark) out.remark = out.notice;
    return out;
  }

  const std::string& folder_;
  const std::vector<DrawnSpecimen>& specimens_;
  const BatchOptions& options_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> interrupted_{false};
  std::mutex telling_;
  std::map<std::string, std::map<int, std::string>> said_;  // by its words, what each specimen said
  std::set<std::string> told_;                              // words that all have heard
  int ended_ = 0;
  std::atomic<bool> stops_{false};  // a test could not be run
  std::string fault_;
};

/// Removes the specimens of an earlier batch that is written over.
void remove_specimens(const std::string& folder) {
  std::error_code error;
  for (const std::string& specimen : specimen_folders(folder)) fs::remove_all(specimen, error);
}

}  // namespace

bool is_complete_batch(const std::string& folder) {
  const fs::path method = fs::path(folder) / "method.yaml";
  std::error_code error;
  if (!fs::exists(method, error) || !fs::exists(statistics_file(folder), error)) return false;
  for (int number = load_method(method.string()).specimens.count; number > 0; --number)
    if (!has_complete_result(specimen_folder(folder, number))) return false;
  return true;
}

BatchOutcome run_batch(const Method& method, const BatchOptions& options) {
  if (options.resume && is_complete_batch(options.folder))
    throw InvalidInput::sentence("--resume", options.folder,
                                 "cannot resume " + shown(options.folder) + ": all of its specimens have been tested");
  const std::vector<DrawnSpecimen> specimens = draw_specimens(method);
  require_readings(method, options.readings);
  require_no_record_in(options.folder, method);
  const ClaimedFolder claimed = options.resume ? ClaimedFolder(options.folder) : options.claim();
  if (options.overwrite && !options.resume) remove_specimens(claimed.path());
  if (!options.resume) begin_run_folder(claimed.path(), method, words_of(options.readings));
  SideBySide tests(claimed.path(), specimens, options);
  tests.tell_of_all(foreseen_warnings(method));
  tests.run();
  tests.tell();
  BatchOutcome out;
  out.folder = claimed.path();
  out.specimens = static_cast<int>(specimens.size());
  out.interrupted = tests.interrupted();
  if (!tests.fault().empty()) throw std::runtime_error(tests.fault());
  if (out.interrupted) return out;
  BatchTable table(claimed.path());
  for (const DrawnSpecimen& specimen : specimens) table.add(specimen);
  table.write();
  out.rejected = table.rejected();
  return out;
}

}  // namespace knot_utm
