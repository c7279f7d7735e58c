#include <stdexcept>
#include <string>
#include <type_traits>

#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample_fields.hpp"

namespace knot_utm {
namespace {

template <typename Value>
constexpr const char* message_type() {
  if constexpr (std::is_same_v<Value, Phase> || std::is_same_v<Value, std::string>) return "string";
  if constexpr (std::is_enum_v<Value>) return "uint8";
  if constexpr (std::is_same_v<Value, std::uint64_t>) return "uint64";
  if constexpr (std::is_same_v<Value, int>) return "int32";
  return std::is_same_v<Value, PerKnot> ? "float64[]" : "float64";
}

}  // namespace

PerKnot::PerKnot(std::initializer_list<double> values) : PerKnot(of(values)) {}

PerKnot PerKnot::unknown(std::size_t knots) {
  if (knots > kMost)
    throw std::length_error(std::to_string(knots) + " knots in a specimen, but it may have " + std::to_string(kMost));
  PerKnot out;
  out.size_ = knots;
  return out;
}

void PerKnot::state(Archive& archive) {
  int knots = static_cast<int>(size_);
  archive.number("knots", knots, 0, static_cast<int>(kMost));
  if (archive.loads()) *this = unknown(static_cast<std::size_t>(knots));
  for (std::size_t k = 0; k < size_; ++k) archive(values_[k]);
}

// In the order of a saved state: another one is another version of it.
void Command::state(Archive& archive) {
  archive(sequence, time, displacement, velocity, turn, step);
  archive.choice("phase", phase, last_of(phase));
  archive(speed, duration, stop_load, balance, read_cell);
}

void Sample::state(Archive& archive) {
  visit_sample_fields([&](const auto& field) {
    auto& value = field.of(*this);
    if constexpr (std::is_enum_v<std::remove_reference_t<decltype(value)>>) {
      archive.choice(field.name, value, last_of(value));
    } else {
      archive(value);
    }
  });
}

std::string sample_fields_csv() {
  std::string all = "field,type,unit,meaning\n";
  visit_sample_fields([&](const auto& field) {
    const char* const type = message_type<ValueOf<std::decay_t<decltype(field)>>>();
    all += std::string(field.name) + ',' + type + ',' + field.unit + ",\"" + field.meaning + "\"\n";
  });
  return all;
}

}  // namespace knot_utm
