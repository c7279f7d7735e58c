#pragma once

#include <optional>
#include <string>

#include "knot_utm/analysis/plateau_watch.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/run/record.hpp"

namespace knot_utm {

/// Which readings a test is made for.
enum class Readings {
  kAll,     ///< those of the whole program
  kPlateau  ///< the sliding force alone: the test ends once its plateau is settled (PlateauWatch)
};

/// The option and its value as the command line has them, "--readings plateau"; empty for kAll.
std::string words_of(Readings readings);
/// The readings of a word, which is "plateau". Throws InvalidInput (key "--readings").
Readings readings_named(const std::string& word);

/// Throws InvalidInput (key "--readings") where a test can have no such readings: a plateau takes a loop that is tied,
/// held by rollers, and pulled.
void require_readings(const Method& method, Readings readings);

/// Ends a test whose readings are complete before its program ends.
class EarlyEnd {
 public:
  EarlyEnd(const Method& method, Readings readings);

  /// Takes every record of the test in order, also of a part that an earlier run has made.
  void add(const Record& record);
  /// Ends the program where the readings are complete.
  void end(ProgramRunner& program) const;

 private:
  std::optional<PlateauWatch> watch_;  ///< empty: the program ends by itself
  std::string reason_;                 ///< empty: the test goes on
};

}  // namespace knot_utm
