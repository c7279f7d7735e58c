// Any bytes for each parser, and what comes out against what the parser promises: its InvalidInput may leave it, and
// nothing else. The build and scripts/fuzz take the names of the parsers from kTargets; the seeds, and inputs that once
// failed, are in the folders of these names in inputs.tar.xz. libFuzzer calls the two functions below, or main does for
// files that are kept, with any compiler.
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <sstream>
#include <utility>
#include <vector>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/program/program.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/csv.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/polyline.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

/// A promise of the parser. Broken, it ends the process, which libFuzzer takes for a crash and ctest for a failure.
void promise(bool kept, const char* what) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

/// Whether a parser understands what it is given; if not, that it says so as it should.
template <typename Parse>
bool understood(Parse parse) {
  try {
    parse();
    return true;
  } catch (const InvalidInput& refused) {
    const std::string line = refused.what();
    promise(line.find('\n') == std::string::npos, "a refusal is one line");
    promise(line.size() < 4096, "a refusal can be read");
    promise(!refused.key.empty(), "a refusal says where");
    return false;
  }
}

/// A file that is never on a disk, for a parser that is given a file's name.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& text) : descriptor_(memfd_create("fuzz", MFD_CLOEXEC)) {
    promise(descriptor_ >= 0, "memory for a file");
    promise(write(descriptor_, text.data(), text.size()) == static_cast<ssize_t>(text.size()), "it is written");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string name() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

/// A method's text, and the --set of a command line: whatever follows a line "--set" is one override a line.
void fuzz_method(const std::string& text) {
  const std::string mark = "\n--set\n";
  const std::size_t end = text.find(mark);
  std::vector<std::string> overrides;
  for (std::size_t from = end; from != std::string::npos && overrides.size() < 16;) {
    from += from == end ? mark.size() : 1;
    const std::size_t to = text.find('\n', from);
    overrides.push_back(text.substr(from, to == std::string::npos ? to : to - from));
    from = to;
  }
  const Method method = parse_method(text.substr(0, end), "fuzz.yaml", overrides);
  check_method(method);

  // What was understood can be written, and means the same when read again.
  const std::string written = method_yaml(method);
  try {
    promise(method_yaml(parse_method(written, "fuzz.yaml")) == written, "a resolved method reads back to the same");
  } catch (const InvalidInput& refused) {
    std::fprintf(stderr, "%s\n%s", refused.what(), written.c_str());
    promise(false, "a resolved method is one that can be read");
  }
}

void fuzz_material(const std::string& text) {
  const MemoryFile file(text);
  const Material material =
      parse_method("{material: " + file.name() + ", program: [{hold: {duration: 1}}]}", "fuzz.yaml").material;
  promise(material.radius >= 1e-5 && material.radius <= 0.05, "a radius in its range");
  promise(material.bending_stiffness > 0.0 && material.stretching_stiffness > 0.0, "stiffnesses above zero");
  promise(!material.name.empty(), "a material has a name");
}

void fuzz_load_cell(const std::string& text) {
  const MemoryFile file(text);
  const Method tested = parse_method(
      "{material: nylon, machine: {load_cell: " + file.name() + "}, program: [{hold: {duration: 1}}]}", "fuzz.yaml");
  const LoadCellOptions& cell = tested.machine.load_cell;
  promise(cell.capacity > 0.0 && cell.resolution < cell.capacity, "a resolution below the capacity");
  promise(cell.sampling_rate >= 1e-2 && cell.sampling_rate <= 1e4, "a sampling rate in its range");
  promise(!cell.name.empty(), "a load cell has a name");
}

/// The points of a specimen (specimen.file), and the rod that is made of them.
void fuzz_centreline(const std::string& text) {
  std::istringstream in(text);
  const Points points = read_centreline(in, "fuzz.csv");
  promise(points.cols() >= 4 && points.allFinite(), "four finite points or more");

  constexpr double kRadius = 0.1, kEdge = 0.15;
  // Each edge is held against each other one: what is long, but not too long, would take seconds here.
  const double length = arclengths(points).back();
  if (length > 500.0 * kEdge && length < 1e5 * kEdge) return;
  const Centreline rod = from_points(points, kRadius, kEdge);
  promise(rod.points.allFinite(), "a rod of finite nodes");
  promise(rod.points.leftCols(1) == points.leftCols(1) && rod.points.rightCols(1) == points.rightCols(1),
          "a rod that ends where its points do");
  const Eigen::Index edges = rod.points.cols() - 1;
  const double longest = (rod.points.rightCols(edges) - rod.points.leftCols(edges)).colwise().norm().maxCoeff();
  promise(longest < 2.0 * kEdge, "edges about as long as was asked for");
}

/// curve.csv, as `compare` and others read it.
void fuzz_curve(const std::string& text) {
  std::istringstream in(text);
  for (const CurveRow& row : read_curve(in, "curve.csv"))
    promise(phase_named(phase_name(row.phase)) == row.phase, "a phase that has a name");
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// A number, and the name of a phase.
void fuzz_word(const std::string& text) {
  if (const std::optional<double> value = parse_number(text)) {
    promise(same(parse_number(format_number(*value)).value(), *value), "a number reads back to the same");
    promise(same(parse_number(format_yaml_number(*value)).value(), *value), "and so it does as YAML");
    const std::string sign = text.substr(0, 1) == "+" || text.substr(0, 1) == "-" ? text.substr(1) : text;
    promise(sign.find_first_of("+-") != 0, "a number has one sign");
  }
  if (const std::optional<Phase> phase = phase_named(text)) promise(phase_name(*phase) == text, "a phase has one name");
}

constexpr const char* kKind = "bench";
std::string little_endian(std::uint64_t value, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  return out;
}

constexpr std::size_t kLengthBytes = 8, kSumBytes = 4;

std::string file_of(const std::string& state) {
  const std::string empty = Archive(kKind).bytes();
  const std::string all =
      empty.substr(0, empty.size() - kLengthBytes - kSumBytes) + little_endian(state.size(), kLengthBytes) + state;
  return all + little_endian(crc32_z(0, reinterpret_cast<const Bytef*>(all.data()), all.size()), kSumBytes);
}

std::string state_of(const std::string& file) {
  return file.substr(Archive(kKind).bytes().size() - kSumBytes, file.size() - Archive(kKind).bytes().size());
}

Material thread() {
  Material out;
  out.name = "thread";
  out.radius = 1e-3;
  out.density = 1000.0;
  out.stretching_stiffness = 1e4;
  out.bending_stiffness = 1e-3;
  out.twisting_stiffness = 1e-3;
  out.friction_coefficient = 0.2;
  return out;
}

std::string with_random_numbers(std::string state) {
  static const std::string mark = "<random>", numbers = [] {
    std::ostringstream out;
    out << std::mt19937_64();
    return little_endian(out.str().size(), kLengthBytes) + out.str();
  }();
  const std::size_t place = state.find(mark);
  return place == std::string::npos ? state : state.replace(place, mark.size(), numbers);
}

TestingMachine make_bench() {
  SpecimenOptions specimen;
  specimen.knot = knot_named("straight");
  specimen.length = 0.008;
  specimen.edge_length = 0.002;
  MachineOptions machine;
  machine.grips = GripKind::kClamps;
  PhysicsOptions physics;
  physics.accuracy = Accuracy::kDraft;
  return TestingMachine(specimen, thread(), machine, physics);
}

ProgramRunner program_of(const TestingMachine& bench) {
  PullStep pull;
  pull.until.extension = 0.001;
  return {{pull}, 10.0, bench.longest_step(), {}};
}

std::string saved(TestingMachine& bench) {
  Archive archive(kKind);
  archive(bench);
  return archive.bytes();
}

TestingMachine loaded(const std::string& file) {
  TestingMachine bench = make_bench();
  Archive archive(kKind, file, kKind);
  archive(bench);
  archive.end();
  return bench;
}

/// In the middle of its pull, and the command that comes next.
std::pair<std::string, Command> good_bench() {
  TestingMachine bench = make_bench();
  ProgramRunner program = program_of(bench);
  for (int i = 0; i < 3; ++i) program.next(bench.respond(program.last()));
  return {saved(bench), program.last()};
}

std::string written_again(const std::string& file) {
  TestingMachine bench = loaded(file);
  return saved(bench);
}

/// Whatever the state: a command that comes soon is answered.
void go_on(const std::string& file, const Command& next) {
  TestingMachine bench = loaded(file);
  const double ahead = next.time - bench.time();
  if (ahead >= 0.0 && ahead <= 2.0 * bench.longest_step()) bench.respond(next);
}

/// A tied specimen: the state of a bench in the middle of its pull. The input as the file itself and, as no random
/// bytes have the right checksum, as the state that a whole file holds; and as bytes that stand in a good state, from
/// the place that its first two bytes tell.
void fuzz_archive(const std::string& text) {
  static const std::pair<std::string, Command> good = good_bench();
  static const bool loads = written_again(good.first) == good.first;
  promise(loads, "what is good is loaded");
  std::string changed = state_of(good.first);
  if (text.size() >= 2) {
    const auto byte = [&](int i) { return static_cast<std::size_t>(static_cast<unsigned char>(text[i])); };
    changed.replace((byte(0) | byte(1) << 8) % changed.size(), text.size() - 2, text.substr(2));
  }
  for (const std::string& file : {text, file_of(with_random_numbers(text)), file_of(changed)}) {
    std::string once;
    if (!understood([&] { once = written_again(file); })) continue;
    // What is loaded may be written in another form, as numbers in a text are, but then it stays.
    promise(understood([&] { promise(written_again(once) == once, "what was written is written again"); }),
            "what was written can be loaded");
    go_on(once, good.second);
  }
}

const std::map<std::string, void (*)(const std::string&)> kTargets = {
    {"method", fuzz_method},         {"material", fuzz_material}, {"load_cell", fuzz_load_cell},
    {"centreline", fuzz_centreline}, {"curve", fuzz_curve},       {"word", fuzz_word},
    {"archive", fuzz_archive}};
void (*chosen)(const std::string&) = nullptr;

}  // namespace
}  // namespace knot_utm

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::string option = "--target=";
  for (int i = 1; i < *argc; ++i) {
    const std::string word = (*argv)[i];
    if (word.compare(0, option.size(), option) == 0)
      knot_utm::chosen = knot_utm::kTargets.at(word.substr(option.size()));
  }
  knot_utm::promise(knot_utm::chosen != nullptr, "--target=NAME names a target");
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  knot_utm::understood([&] { knot_utm::chosen(std::string(data, data + size)); });
  return 0;
}

#ifndef KNOT_UTM_FUZZ
int main(int argc, char** argv) {
  LLVMFuzzerInitialize(&argc, &argv);
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(argv[argc - 1])) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    std::fprintf(stderr, "%s\n", entry.path().c_str());  // the last one named is the one that fails
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    ++files;
  }
  return files == 0 ? 1 : 0;
}
#endif
