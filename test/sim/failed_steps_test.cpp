// Time steps that some run once could not make (test/failed_steps, as failed_step.bin has them) and now are made.

#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/sim/saved_step.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> failed_steps() {
  std::vector<fs::path> out;
  for (const fs::directory_entry& entry : fs::directory_iterator(KNOT_UTM_SOURCE_DIR "/test/failed_steps"))
    out.push_back(entry.path());
  return out;
}

std::string first_line(const std::string& bytes) { return bytes.substr(0, bytes.find('\n') + 1); }

/// A file of an earlier version whose format is still the present one, as if it were of this version.
std::string of_this_version(const std::string& bytes) {
  constexpr std::size_t kSum = 4;
  const std::string heading = first_line(Archive("time step").bytes());
  std::string out = heading + bytes.substr(first_line(bytes).size());
  out.resize(out.size() - kSum);
  const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(out.data()), out.size());
  for (std::size_t i = 0; i < kSum; ++i) out += static_cast<char>(sum >> (8 * i) & 0xff);
  return out;
}

class OnceFailedStep : public testing::TestWithParam<fs::path> {};

TEST_P(OnceFailedStep, IsMade) {
  std::ifstream in(GetParam(), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  SavedStep step = load_step(of_this_version(bytes), GetParam().string());
  const StepSummary summary = step.try_again();
  EXPECT_TRUE(summary.accepted()) << summary.reason << "; " << summary.diagnosis.text();
}

INSTANTIATE_TEST_SUITE_P(Every, OnceFailedStep, testing::ValuesIn(failed_steps()),
                         [](const auto& file) { return file.param.stem().string(); });

}  // namespace
}  // namespace knot_utm
