#include "knot_utm/run/shape_series.hpp"

#include <array>
#include <charconv>
#include <utility>

#include "knot_utm/numeric/pieces.hpp"

namespace knot_utm {
namespace {

constexpr int kDigits = 7;  // a tenth of a micrometre of a place less than a metre away
constexpr const char* kNames = "time,node,x,y,z,tension,twist,contact_force";
constexpr const char* kUnits = "s,-,m,m,m,N,rad/m,N/m";

/// A number behind a comma.
void put(std::string& text, double value) {
  std::array<char, 32> cell{','};
  // Adding zero turns -0 into 0.
  const auto end =
      std::to_chars(cell.data() + 1, cell.data() + cell.size(), value + 0.0, std::chars_format::general, kDigits);
  text.append(cell.data(), end.ptr);
}

/// NaN where there are too few.
double at(const Eigen::VectorXd& values, Eigen::Index i) {
  return i >= 0 && i < values.size() ? values[i] : Sample::kNone;
}

}  // namespace

void ShapeSeries::add(const Record& record) {
  const bool whole = record.answer.status != BenchStatus::kBroken;
  if (!whole || !record.readings || record.shape.cols() == 0) return;
  if (records_ % stride_ == 0 && kept_.size() == kMost) {
    for (std::size_t i = 1; 2 * i < kMost; ++i) kept_[i] = std::move(kept_[2 * i]);
    kept_.resize((kMost + 1) / 2);
    stride_ *= 2;
  }
  Shape shape{record.answer.time, record.shape, record.tension, *record.readings};
  at_the_end_.clear();
  (records_ % stride_ == 0 ? kept_ : at_the_end_).push_back(std::move(shape));
  ++records_;
}

void ShapeSeries::add_parted(double time, const Points& shape) { at_the_end_.push_back({time, shape, {}, {}}); }

std::string ShapeSeries::csv() const {
  const bool several = !cuts_.empty();
  std::string text = kNames + std::string(several ? ",rope\n" : "\n") + kUnits + (several ? ",-\n" : "\n");
  for (const std::vector<Shape>* shapes : {&kept_, &at_the_end_})
    for (const Shape& shape : *shapes) write(shape, text);
  return text;
}

void ShapeSeries::write(const Shape& shape, std::string& text) const {
  std::string time;
  put(time, shape.time);
  int rope = 0;
  for (const Piece& piece : pieces_between(shape.points.cols(), cuts_)) {
    const std::string end = cuts_.empty() ? "\n" : ',' + std::to_string(++rope) + '\n';
    for (Eigen::Index i = piece.begin; i < piece.end; ++i) {
      const bool first = i == piece.begin, last = i + 1 == piece.end;
      text.append(time, 1);
      text += ',' + std::to_string(i);
      for (Eigen::Index k = 0; k < 3; ++k) put(text, shape.points(k, i));
      put(text, last ? Sample::kNone : at(shape.tension, i));
      put(text, first || last ? Sample::kNone : at(shape.readings.twist_rate, i - 1));
      put(text, at(shape.readings.contact_load, i));
      text += end;
    }
  }
}

}  // namespace knot_utm
