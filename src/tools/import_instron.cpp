// Raw data that a testing machine exported, as a bag with the topics of a simulated test.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "add_raw_options.hpp"
#include "knot_utm/raw/raw_zero.hpp"
#include "knot_utm/ros/curve_bag.hpp"
#include "knot_utm/run/curve_file.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "tool.hpp"

int main(int argc, char** argv) {
  constexpr const char* kTool = "import_instron";
  return knot_utm::run_tool(kTool, [&] {
    std::string raw_data, bag;
    knot_utm::RecordWords words;
    bool quiet = false, overwrite = false;
    CLI::App app("Writes the raw data of a testing machine into a bag, on the topics utm/crosshead and utm/load_cell.");
    app.add_option("RAW_DATA", raw_data, "the exported CSV")->required();
    app.add_option("BAG", bag, "the bag to be written")->required();
    knot_utm::add_raw_options(app, words, "which specimen of a file with several, from 1");
    app.add_flag("--overwrite", overwrite, "replace a bag that exists");
    app.add_flag("--quiet", quiet, "say only what went wrong");
    if (const auto code = knot_utm::parse(app, kTool, argc, argv)) return *code;
    knot_utm::require_new_file("BAG", bag, {raw_data}, overwrite, "#ROSBAG");
    std::vector<std::string> told;
    const std::vector<knot_utm::CurveRow> rows = knot_utm::read_curve_file(
        raw_data, knot_utm::raw_options(words), [&](const std::string& line) { told.push_back(line); });
    const std::string unused = knot_utm::without_effect(words, {}, false);
    if (!unused.empty() && knot_utm::has_its_zero(rows))
      told.push_back(raw_data + ": the curve is one of knot_utm, for which " + unused);
    knot_utm::write_curve_bag(bag, rows);
    if (quiet) return static_cast<int>(knot_utm::kDone);
    for (const std::string& line : told) std::printf("%s\n", line.c_str());
    std::printf("%zu %s over %g s %s written to %s\n", rows.size(), rows.size() == 1 ? "reading" : "readings",
                rows.back().time - rows.front().time, rows.size() == 1 ? "was" : "were", bag.c_str());
    return static_cast<int>(knot_utm::kDone);
  });
}
