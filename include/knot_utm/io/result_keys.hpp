#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/io/run_facts.hpp"
#include "knot_utm/io/verdict.hpp"

namespace knot_utm {

/// All that result.yaml is made from.
struct ResultSource {
  const Results& results;
  const RunFacts& facts;
  ReadingErrors errors;  ///< known_errors of the two
  Verdict verdict;       ///< on the specification
};

/// How a key is read. What the function gives is the kind of the key, and empty is null.
template <typename Value>
using ReadAs = Value (*)(const ResultSource&);
using ReadNumber = ReadAs<std::optional<double>>;
using ReadCount = ReadAs<std::optional<std::uint64_t>>;
using ReadFlag = ReadAs<std::optional<bool>>;
using ReadWord = ReadAs<const char*>;  ///< one of a few words, without quotes; never empty
using ReadText = ReadAs<std::string>;
using ReadNumbers = ReadAs<std::vector<double>>;  ///< one of each knot
using ReadList = ReadAs<std::vector<std::string>>;
using ReadResult = std::variant<ReadNumber, ReadCount, ReadFlag, ReadWord, ReadText, ReadNumbers, ReadList>;

/// Why a key is null, in a few words: always the same, or by what became of the test. Empty: that goes without saying.
class NullReason {
 public:
  using Find = std::string (*)(const ResultSource&);

  constexpr NullReason(const char* always = "") : always_(always) {}
  constexpr NullReason(Find find) : find_(find) {}

  std::string operator()(const ResultSource& source) const { return find_ ? find_(source) : always_; }

 private:
  const char* always_ = "";
  Find find_ = nullptr;
};

/// One key of result.yaml.
struct ResultKey {
  const char* name;
  const char* unit;     ///< "-": none
  const char* group;    ///< where the report shows it: the title of a table, or a place of its own (ResultPlace)
  const char* meaning;  ///< as the report calls it
  ReadResult read;
  NullReason why_null;

  const char* kind() const;  ///< "number", "count", "flag", "word", "text", "numbers" or "list"
  bool is_number() const;    ///< a number or a count: what a specification may name
};

/// Places of the report that are no table of results.
namespace result_place {
constexpr char kHead[] = "head";                ///< at the top of the page
constexpr char kBeside[] = "beside";            ///< in the row of the reading that its name begins or ends with
constexpr char kCertificate[] = "certificate";  ///< among the checks
}  // namespace result_place

/// Every key, in the order of the file. From these rows come result.yaml, the keys that a specification may name, and
/// report/result_keys.csv with the report's labels and units; tests compare doc/results.md with them. A new key is a
/// row of this table and one of doc/results.md.
const std::vector<ResultKey>& result_keys();

}  // namespace knot_utm
