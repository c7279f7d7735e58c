#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/verdict/known_errors.hpp"
#include "knot_utm/verdict/run_facts.hpp"
#include "knot_utm/words/yaml_lines.hpp"

namespace knot_utm {

/// Whether a test meets its specification. A number that it does not have meets no requirement.
struct Verdict {
  std::optional<bool> passed;       ///< empty: there are no requirements
  std::vector<std::string> failed;  ///< one line for each requirement that was not met, with the reason
};

/// Throws InvalidInput where a key of a specification is no number of result.yaml.
void check_specification(const Specification& specification);
Verdict verdict(const Specification& specification, const YamlLines& results);

/// Everything from which result.yaml is made.
struct ResultSource {
  const Results& results;
  const RunFacts& facts;
  ReadingErrors errors;  ///< known_errors of these two
  Verdict verdict;       ///< the verdict on the specification
};

/// Functions that read the value of a key, whose type is its kind. An empty value is written as null.
template <typename Value>
using ReadAs = Value (*)(const ResultSource&);
using ReadNumber = ReadAs<std::optional<double>>;
using ReadCount = ReadAs<std::optional<std::uint64_t>>;
using ReadFlag = ReadAs<std::optional<bool>>;
using ReadWord = ReadAs<const char*>;  ///< one of a fixed set of words, written without quotes; never empty
using ReadText = ReadAs<std::string>;
using ReadNumbers = ReadAs<std::vector<double>>;  ///< one number for each knot
using ReadList = ReadAs<std::vector<std::string>>;
using ReadResult = std::variant<ReadNumber, ReadCount, ReadFlag, ReadWord, ReadText, ReadNumbers, ReadList>;

/// The reason why a key is null, in a few words. Empty: no reason is needed.
class NullReason {
 public:
  using Find = std::string (*)(const ResultSource&);

  constexpr NullReason(const char* always = "") : always_(always) {}
  constexpr NullReason(Find find) : find_(find) {}  ///< one that depends on the test
  /// Of a reading of every pull: "nothing was pulled", else `otherwise`.
  static constexpr NullReason of_a_pull(const char* otherwise) {
    NullReason out(otherwise);
    out.of_a_pull_ = true;
    return out;
  }

  std::string operator()(const ResultSource& source) const;

 private:
  const char* always_ = "";
  Find find_ = nullptr;
  bool of_a_pull_ = false;
};

/// One key of result.yaml.
struct ResultKey {
  const char* name;
  const char* unit;     ///< "-": dimensionless
  const char* group;    ///< where the report shows it: the title of a table, or one of result_place
  const char* meaning;  ///< label in the report
  ReadResult read;
  NullReason why_null;

  const char* kind() const;  ///< "number", "count", "flag", "word", "text", "numbers" or "list"
  int table() const;         ///< number of the report's table in which it stands, from 1; 0: another place
  bool is_number() const;    ///< whether it is a number or a count; only these may have requirements
};

/// Places of the report other than its tables of results.
namespace result_place {
constexpr char kHead[] = "head";      ///< at the top of the page
constexpr char kBeside[] = "beside";  ///< in the row of the reading whose name is the beginning or the end of its own
constexpr char kCertificate[] = "certificate";  ///< among the checks of the certificate
}  // namespace result_place

/// All keys of result.yaml, in its order. From this table are made the file, the keys that a specification may name,
/// labels and units of the report (`tensile_test --list-results`), and by `scripts/tables` the list in doc/results.md.
const std::vector<ResultKey>& result_keys();
const ResultKey* result_key(const std::string& name);  ///< null: no key has this name

/// The table of the keys as CSV with the columns key, unit, kind, group, table and meaning.
std::string result_keys_csv();

/// The text of result.yaml. Among the warnings, those that follow from the results come first.
std::string result_yaml(const Results& results, const RunFacts& facts);

}  // namespace knot_utm
