#pragma once

#include <endian.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "knot_utm/io/record.hpp"

/// Records as bytes and back. Each list of fields stands once, for both ways.
namespace knot_utm::journal {

/// Appends to a text of bytes; numbers take eight each, little-endian.
class Encoder {
 public:
  explicit Encoder(std::string& bytes) : bytes_(bytes) {}

  void operator()(std::uint64_t value) {
    value = htole64(value);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void operator()(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    (*this)(bits);
  }
  void operator()(int value) { (*this)(static_cast<std::uint64_t>(static_cast<std::int64_t>(value))); }
  void operator()(bool value) { (*this)(static_cast<std::uint64_t>(value)); }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  template <class Enum>
  void choice(Enum value, Enum /*last*/) {
    (*this)(static_cast<std::uint64_t>(value));
  }
  /// How many entries follow.
  template <class Count>
  Count count(Count entries, std::size_t /*bytes_each*/) {
    (*this)(static_cast<std::uint64_t>(entries));
    return entries;
  }

 private:
  std::string& bytes_;
};

/// Reads what an Encoder wrote. What does not fit reads as zero, and the whole is not good.
class Decoder {
 public:
  explicit Decoder(std::string_view bytes) : bytes_(bytes) {}

  /// Everything was read, and nothing was beyond its end or out of range.
  bool good() const { return good_ && bytes_.empty(); }

  void operator()(std::uint64_t& value) {
    value = 0;
    if (!has(sizeof value)) return;
    std::memcpy(&value, bytes_.data(), sizeof value);
    value = le64toh(value);
    bytes_.remove_prefix(sizeof value);
  }
  void operator()(double& value) {
    std::uint64_t bits = 0;
    (*this)(bits);
    std::memcpy(&value, &bits, sizeof value);
  }
  void operator()(int& value) {
    std::uint64_t bits = 0;
    (*this)(bits);
    value = static_cast<int>(static_cast<std::int64_t>(bits));
  }
  void operator()(bool& value) { value = limited(1) != 0; }
  void operator()(std::string& text) {
    std::uint64_t size = 0;
    (*this)(size);
    if (!has(size)) return;
    text.assign(bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  template <class Enum>
  void choice(Enum& value, Enum last) {
    value = static_cast<Enum>(limited(static_cast<std::uint64_t>(last)));
  }
  /// How many entries follow, which take at least so many bytes each.
  template <class Count>
  Count count(Count /*entries*/, std::size_t bytes_each) {
    std::uint64_t entries = 0;
    (*this)(entries);
    if (entries <= bytes_.size() / bytes_each) return static_cast<Count>(entries);
    good_ = false;
    return 0;
  }

 private:
  bool has(std::uint64_t size) {
    good_ = good_ && size <= bytes_.size();
    return good_;
  }
  std::uint64_t limited(std::uint64_t last) {
    std::uint64_t value = 0;
    (*this)(value);
    if (value <= last) return value;
    good_ = false;
    return 0;
  }

  std::string_view bytes_;
  bool good_ = true;
};

template <class Codec, class T>
using Of = std::conditional_t<std::is_same_v<Codec, Encoder>, const T, T>;

template <class Codec>
void fields(Codec& codec, Of<Codec, Command>& c) {
  codec(c.sequence);
  codec(c.time);
  codec(c.displacement);
  codec(c.velocity);
  codec(c.step);
  codec.choice(c.phase, Phase::kDone);
  codec(c.speed);
  codec(c.duration);
  codec(c.balance);
  codec(c.read_cell);
}

template <class Codec>
void fields(Codec& codec, Of<Codec, Sample>& s) {
  codec(s.sequence);
  codec(s.time);
  codec.choice(s.phase, Phase::kDone);
  codec(s.displacement);
  codec(s.extension);
  codec(s.end_to_end);
  codec(s.knot_distance);
  codec(s.load);
  codec(s.balance_offset);
  codec(s.force_upper);
  codec(s.force_lower);
  for (auto& force : s.tail_force) codec(force);
  for (auto& length : s.excess_length) codec(length);
  codec(s.max_penetration);
  codec(s.normal_force);
  codec(s.contacts);
  codec(s.fastest_node);
  codec(s.stretching_energy);
  codec(s.bending_energy);
  codec(s.twisting_energy);
  codec(s.contact_energy);
  codec(s.kinetic_energy);
  codec(s.grip_work);
  codec(s.dissipation);
  codec(s.friction_loss);
  codec(s.numerical_dissipation);
  codec(s.reweighting_loss);
  codec(s.moment_imbalance);
  codec(s.steps);
  codec(s.rejected_steps);
  codec(s.newton_iterations);
  codec.choice(s.knot_type, KnotType::kCrossed);
  codec.choice(s.status, BenchStatus::kFailed);
  codec(s.message);
}

template <class Codec>
void fields(Codec& codec, Of<Codec, Record>& r) {
  codec(r.wall_time);
  fields<Codec>(codec, r.command);
  fields<Codec>(codec, r.answer);
  const auto steps = codec.count(r.steps.size(), sizeof(std::uint64_t));
  if constexpr (std::is_same_v<Codec, Decoder>) r.steps.resize(steps);
  for (auto& step : r.steps) fields<Codec>(codec, step);
  const auto nodes = codec.count(r.shape.cols(), 3 * sizeof(double));
  if constexpr (std::is_same_v<Codec, Decoder>) r.shape.resize(3, nodes);
  for (Eigen::Index i = 0; i < r.shape.size(); ++i) codec(*(r.shape.data() + i));
  const auto edges = codec.count(r.tension.size(), sizeof(double));
  if constexpr (std::is_same_v<Codec, Decoder>) r.tension.resize(edges);
  for (Eigen::Index i = 0; i < r.tension.size(); ++i) codec(*(r.tension.data() + i));
}

}  // namespace knot_utm::journal
