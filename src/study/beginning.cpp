#include "knot_utm/study/beginning.hpp"

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/number.hpp"

namespace knot_utm {
namespace {

std::string bytes_of(Command command) {
  Archive archive("command");
  command.state(archive);
  return archive.bytes();
}

}  // namespace

std::string Beginning::follow(ProgramRunner& program) const {
  std::string why;
  each_([&](const Record& record) {
    if (!why.empty()) return;
    if (bytes_of(record.command) != bytes_of(program.last())) {
      why = "the programs differ from " + format_number(record.command.time) + " s on, before that run stopped";
      return;
    }
    program.next(record.answer);
    if (program.ended()) why = "this test ends before that run stopped";
  });
  return why;
}

double Beginning::replay(SamplesWriter& samples, const Visitor& also) const {
  double wall_time = 0.0;
  each_([&](const Record& record) {
    samples.append(record);
    also(record);
    wall_time = record.wall_time;
  });
  return wall_time;
}

}  // namespace knot_utm
