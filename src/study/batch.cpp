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

#include "knot_utm/io/claimed_folder.hpp"
#include "knot_utm/io/foreseen.hpp"
#include "knot_utm/io/run_folder.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/known_names.hpp"
#include "knot_utm/study/specimens.hpp"

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
    if (!options_.notice) return;
    for (const std::string& warning : warnings) {
      options_.notice(warning);
      told_.insert(without_numbers(warning));
    }
  }
  /// What the tests said, each once with the specimens that it is about: "specimens 1, 2 and 5: ...". Lines that differ
  /// by their numbers alone are one.
  void tell() const {
    if (!options_.notice) return;
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
      options_.notice((who.size() > 1 ? "specimens " : "specimen ") + listed(who, " and ") + of_first + ": " + line);
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
    out.resume = holds_unfinished_run(out.folder);
    out.overwrite = !out.resume;  // what stands there is an earlier batch's, which the whole one writes over
    out.shapes = options_.shapes;
    out.checkpoint_period = options_.checkpoint_period;
    out.interrupted = [this] { return stops(); };
    const int number = specimen.number;
    out.notice = [this, number](const std::string& line) {
      const std::lock_guard<std::mutex> lock(telling_);
      said_[without_numbers(line)].emplace(number, line);
    };
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

/// The journal of the batch's folder has no records: it holds the folder, and stands there until the batch has ended.
ClaimedFolder folder_of_batch(const Method& method, const BatchOptions& options) {
  const std::string& asked = options.folder;
  if (options.resume) return {asked, JournalWriter::go_on(asked, 0.0)};
  if (options.overwrite) return {asked, JournalWriter(asked, journal_header(method))};
  ClaimedFolder claimed = claim_folder(asked, journal_header(method));
  if (claimed.folder != asked && options.notice) options.notice(moved_notice(asked, claimed.folder));
  return claimed;
}

/// Of an earlier batch that is written over.
void remove_specimens(const std::string& folder) {
  std::error_code error;
  for (const std::string& specimen : specimen_folders(folder)) fs::remove_all(specimen, error);
}

}  // namespace

BatchOutcome run_batch(const Method& method, const BatchOptions& options) {
  if (options.resume && fs::exists(statistics_file(options.folder)) && !holds_unfinished_run(options.folder))
    throw InvalidInput::sentence("--resume", options.folder,
                                 "cannot resume " + shown(options.folder) + ": all of its specimens have been tested");
  const std::vector<DrawnSpecimen> specimens = draw_specimens(method);
  require_no_record_in(options.folder, method);
  ClaimedFolder claimed = folder_of_batch(method, options);
  if (options.overwrite && !options.resume) remove_specimens(claimed.folder);
  if (!options.resume) begin_run_folder(claimed.folder, method);
  SideBySide tests(claimed.folder, specimens, options);
  tests.tell_of_all(foreseen_warnings(method));
  tests.run();
  tests.tell();
  BatchOutcome out;
  out.folder = claimed.folder;
  out.specimens = static_cast<int>(specimens.size());
  out.interrupted = tests.interrupted();
  if (!tests.fault().empty()) throw std::runtime_error(tests.fault());
  if (out.interrupted) return out;
  BatchTable table(claimed.folder);
  for (const DrawnSpecimen& specimen : specimens) table.add(specimen);
  table.write();
  out.rejected = table.rejected();
  claimed.journal.remove();
  return out;
}

}  // namespace knot_utm
