#include "knot_utm/run/report.hpp"

#include <array>
#include <filesystem>
#include <system_error>

#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

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
