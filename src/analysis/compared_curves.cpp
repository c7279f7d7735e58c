#include <algorithm>
#include <cmath>
#include <utility>

#include "knot_utm/analysis/comparison.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

/// A curve without any times is one, too.
void require_finite(const CurveOfFile& curve) {
  const bool timed = has_its_zero(curve.rows) || (!curve.rows.empty() && std::isfinite(curve.rows.front().time));
  for (std::size_t i = 0; i < curve.rows.size(); ++i) {
    const CurveRow& row = curve.rows[i];
    if (pulls(row.phase) &&
        !((std::isfinite(row.time) || !timed) && std::isfinite(row.extension) && std::isfinite(row.load)))
      throw InvalidInput::sentence("reading", std::to_string(i + 1),
                                   "reading " + std::to_string(i + 1) + " has no time, no extension or no load")
          .in_file(curve.file);
  }
}

/// One of the two curves.
class Side {
 public:
  Side(CurveOfFile curve, const Tell& tell) : curve_(std::move(curve)), tell_(tell), has_zero_(has_its_zero(rows())) {
    require_finite(curve_);
    require_readings();
    if (!has_zero_) note_left_out();
  }

  bool has_zero() const { return has_zero_; }
  const std::vector<CurveRow>& rows() const { return curve_.rows; }
  const std::optional<RawZero>& given() const { return given_; }

  void keep_zero() const { note("the curve is one of knot_utm and keeps its own zero"); }

  void balance_at_rest(const Pull& other) {
    given_ = zero_at_rest(rows(), other);
    note(zero_words(*given_) +
         (given_->readings > 1 ? "" : "; if the record was cut, say with --begins-at where it begins"));
    curve_.rows = balanced(rows(), *given_);
    require_readings();
  }

  void balance_cut(double begins_at, const Pull& other) {
    given_ = zero_of_cut(rows(), begins_at, other);
    if (!given_)
      throw InvalidInput::sentence("--begins-at", format_number(begins_at),
                                   "the other curve has no load at an extension of " + format_number(begins_at) + " m");
    note("the first reading, " + format_number(given_->load) + " N at " + format_number(given_->extension + begins_at) +
         " m, is taken to lie at an extension of " + format_number(begins_at) +
         " m, where its load is set to that of the other curve, " + format_number(given_->load_there) + " N");
    curve_.rows = balanced(rows(), *given_);
  }

 private:
  void require_readings() const {
    const std::size_t readings = pull_of(rows()).size();
    if (readings < 2 && !rows().empty() && falls(rows(), &CurveRow::extension))
      throw InvalidInput::sentence("extension", "falls",
                                   "the extension falls from its first reading on, so that nothing is pulled: --invert "
                                   "turns its sign")
          .in_file(curve_.file);
    if (readings < 2)
      throw InvalidInput::sentence("pull", std::to_string(readings),
                                   rows().size() == 1
                                       ? "there is one reading, but must be at least two"
                                       : "nothing is pulled: no reading has a larger extension than the first one")
          .in_file(curve_.file);
  }
  /// A pull has only readings beyond all extensions before.
  void note_left_out() const {
    constexpr double kBehind = 0.01;  // of the way
    const Pull pull = pull_of(rows());
    const double behind = kBehind * (pull.back().extension - pull.front().extension);
    std::size_t left_out = 0;
    double farthest = pull.front().extension, most = 0.0;
    for (const CurveRow& row : rows()) {
      if (!pulls(row.phase)) continue;
      farthest = std::max(farthest, row.extension);
      if (farthest - row.extension <= behind) continue;
      ++left_out;
      most = std::max(most, farthest - row.extension);
    }
    if (left_out > 0)
      note(std::to_string(left_out) + " of " + std::to_string(rows().size()) +
           " readings are not compared, since they lie up to " + short_number(1e3 * most) +
           " mm behind an extension that was reached before");
  }

  void note(const std::string& words) const { tell_(curve_.file + ": " + words); }

  CurveOfFile curve_;
  const Tell& tell_;
  bool has_zero_;  // of its own
  std::optional<RawZero> given_;
};

/// Raw data alone: a curve of ours has its zero.
void balance(const ZeroWanted& wanted, Side& a, Side& b, const Tell& tell) {
  if (wanted.balance && a.has_zero() && b.has_zero())
    tell("--balance changes nothing, since both curves are of knot_utm and have their zero");
  Side& raw = a.has_zero() ? b : a;
  const Side& other = a.has_zero() ? a : b;
  const Pull beside = other.has_zero() ? pull_of(other.rows(), ExtensionOf::kMachine) : Pull();
  if (other.has_zero() && !raw.has_zero()) other.keep_zero();
  if (wanted.begins_at) {
    if (a.has_zero() == b.has_zero())
      throw InvalidInput::sentence("--begins-at", format_number(*wanted.begins_at),
                                   "one of the curves must be raw data, and the other one a curve of knot_utm");
    return raw.balance_cut(*wanted.begins_at, beside);
  }
  for (Side* side : {&a, &b})
    if (!side->has_zero()) side->balance_at_rest(beside);
}

}  // namespace

ComparedCurves compare_curves(CurveOfFile a, CurveOfFile b, const ZeroWanted& zero, const Tell& tell) {
  Side side_a(std::move(a), tell), side_b(std::move(b), tell);
  const bool balances = zero.balance.value_or(zero.begins_at || !side_a.has_zero() || !side_b.has_zero());
  if (balances) balance(zero, side_a, side_b, tell);
  const bool both = side_a.has_zero() && side_b.has_zero();
  const ExtensionOf extension = both ? ExtensionOf::kSpecimen : ExtensionOf::kMachine;
  ComparedCurves out{pull_of(side_a.rows(), extension), pull_of(side_b.rows(), extension), {}};
  out.comparison = compare(out.a, out.b);
  if (balances) out.comparison.zeros = GivenZeros{side_a.given(), side_b.given()};
  if (!out.comparison.difference)
    throw InvalidInput::sentence("extensions", "none that both have",
                                 "the curves have no extension in common, so they cannot be compared");
  return out;
}

}  // namespace knot_utm
