#include "knot_utm/study/beginning.hpp"

#include "knot_utm/numeric/archive.hpp"

namespace knot_utm {
namespace {

std::string bytes_of(Command command) {
  Archive archive("command");
  command.state(archive);
  return archive.bytes();
}

}  // namespace

bool Beginning::follow(ProgramRunner& program) const {
  bool asks = true;
  each_([&](const Record& record) {
    asks = asks && bytes_of(record.command) == bytes_of(program.last());
    if (!asks) return;
    program.next(record.answer);
    asks = !program.ended();
  });
  return asks;
}

double Beginning::replay(const Visitor& visit) const {
  double wall_time = 0.0;
  each_([&](const Record& record) {
    visit(record);
    wall_time = record.wall_time;
  });
  return wall_time;
}

}  // namespace knot_utm
