#include "knot_utm/contact/candidates.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "knot_utm/numeric/index.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {
namespace {

constexpr std::size_t kLanes = 4;

// More than what rounding does to a ball around others [fraction of its radius].
constexpr double kRounding = 1e-12;

const Vec3 kNowhere = Vec3::Constant(std::numeric_limits<double>::infinity());

/// Puts numbers together to runs. They come four by four, ascending, and which of four are meant is hard to foretell:
/// they are bits of a word, in which only the ends of runs are looked for.
class RunCollector {
 public:
  explicit RunCollector(std::vector<Candidates::Run>& runs) : runs_(runs), before_(runs.size()) {}

  /// Takes those of the numbers 4 four to 4 four + 3 that are meant.
  template <typename Mask>
  void take(int four, const Mask& meant) {
    if (four / kFours != word_) {
      write();
      word_ = four / kFours;
    }
    const auto bits = meant & Mask{1, 2, 4, 8};
    taken_ |= static_cast<std::uint64_t>(bits[0] | bits[1] | bits[2] | bits[3]) << 4 * (four % kFours);
  }

  /// Writes what was taken since; to be called at the end.
  void write() {
    const int begin = 4 * kFours * word_, end = begin + 4 * kFours;
    bool runs_on = runs_.size() > before_ && runs_.back().last + 1 == begin;
    // A number is taken and the one before is not, or the other way round.
    std::uint64_t turns = taken_ ^ (taken_ << 1 | std::uint64_t{runs_on});
    for (; turns != 0; turns &= turns - 1) {
      const int number = begin + __builtin_ctzll(turns);
      if (runs_on)
        runs_.back().last = number - 1;
      else
        runs_.push_back({number, number});
      runs_on = !runs_on;
    }
    if (runs_on) runs_.back().last = end - 1;
    taken_ = 0;
  }

 private:
  static constexpr int kFours = 16;  // of numbers in a word

  std::vector<Candidates::Run>& runs_;
  const std::size_t before_;  // runs that are others'
  int word_ = 0;
  std::uint64_t taken_ = 0;
};

std::size_t fours(std::size_t number) { return (number + kLanes - 1) / kLanes; }

}  // namespace

Candidates::Candidates(const RodProperties& rod, double reach, double margin, double exclusion)
    : reach_(reach),
      margin_(margin),
      exclusion_(exclusion),
      other_exclusion_(rod.other_material ? exclusion * (rod.other_material->radius / rod.material.radius) : exclusion),
      first_of_other_(static_cast<int>(rod.first_of_other())),
      arclength_(rod.arclength()),
      size_(Eigen::VectorXd::Zero(rod.nodes())),
      touches_(static_cast<std::size_t>(rod.nodes()), 1) {
  const auto nodes = static_cast<std::size_t>(rod.nodes());
  touches_.front() = touches_.back() = 0;
  levels_.emplace_back(fours(nodes));
  do {
    levels_.emplace_back(fours(levels_.back().size()));
  } while (levels_.back().size() > 1);
  four_arclengths_.resize(fours(nodes));
  for (std::size_t i = 0; i < nodes; ++i)
    four_arclengths_[i / kLanes][i % kLanes] = arclength_[static_cast<Eigen::Index>(i)];
  // None of these can hold more: a build takes no memory for them.
  around_.reserve(fours(nodes));
  larger_around_.reserve(fours(nodes));
  segments_.reserve(nodes);
}

bool Candidates::refresh(const Points& position) {
  if (built_at_.cols() == position.cols()) {
    const double moved = (position - built_at_).colwise().squaredNorm().maxCoeff();
    if (moved < 0.25 * margin_ * margin_) return false;
  }
  build(position);
  return true;
}

void Candidates::part(int edge) {
  whole_ = false;
  touches_[at(edge)] = touches_[at(edge + 1)] = 0;
  built_at_.resize(3, 0);
}

void Candidates::measure(const Points& position) {
  double before = (position.col(1) - position.col(0)).norm();
  for (Eigen::Index i = 1; i + 1 < position.cols(); ++i) {
    const double after = (position.col(i + 1) - position.col(i)).norm();
    size_[i] = touches_[static_cast<std::size_t>(i)] == 0 ? 0.0 : 0.5 * std::max(before, after);
    before = after;
  }
}

bool Candidates::is_taut(const Points& position) const {
  // Two places lie no nearer to each other than the rod between them is long, less all of its slack: what its length
  // exceeds the distance of its ends by.
  double length = 0.0, least_stretch = 1.0;
  for (Eigen::Index i = 0; i + 1 < position.cols(); ++i) {
    const double edge = (position.col(i + 1) - position.col(i)).norm();
    length += edge;
    least_stretch = std::min(least_stretch, edge / (arclength_[i + 1] - arclength_[i]));
  }
  const double slack = length - (position.rightCols(1) - position.leftCols(1)).norm();
  return least_stretch * exclusion_ - slack >= reach_ + margin_ + 2.0 * size_.maxCoeff();
}

void Candidates::state(Archive& archive) {
  bool built = built_at_.cols() > 0;
  archive(built);
  if (archive.loads()) built_at_.resize(3, built ? arclength_.size() : 0);
  archive(built_at_);
  archive.require(are_places(built_at_), "places of the nodes", "that of no rod");
  if (archive.loads() && built) build(built_at_);
}

void Candidates::Balls::set(std::size_t lane, const Ball& ball) {
  for (int i = 0; i < 3; ++i) centre[i][lane] = ball.centre[i];
  radius[lane] = ball.radius;
}

Candidates::Ball Candidates::Balls::get(std::size_t lane) const {
  return {{centre[0][lane], centre[1][lane], centre[2][lane]}, radius[lane]};
}

Candidates::Ball Candidates::Balls::around() const {
  Vec3 low = kNowhere, high = -kNowhere;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Ball ball = get(k);
    if (ball.centre == kNowhere) continue;
    low = low.cwiseMin(ball.centre);
    high = high.cwiseMax(ball.centre);
  }
  if (low == kNowhere) return {kNowhere, 0.0};
  Ball out{0.5 * (low + high), 0.0};
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Ball ball = get(k);
    if (ball.centre != kNowhere) out.radius = std::max(out.radius, (ball.centre - out.centre).norm() + ball.radius);
  }
  out.radius *= 1.0 + kRounding;
  return out;
}

void Candidates::set_balls(const Points& position) {
  const Ball nothing{kNowhere, 0.0};
  for (std::size_t k = 0; k < kLanes * levels_[0].size(); ++k) {
    const bool touches = k < touches_.size() && touches_[k] != 0;
    const auto i = static_cast<Eigen::Index>(k);
    levels_[0][k / kLanes].set(k % kLanes, touches ? Ball{position.col(i), size_[i]} : nothing);
  }
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    const std::vector<Balls>& small = levels_[level - 1];
    std::vector<Balls>& large = levels_[level];
    for (std::size_t k = 0; k < kLanes * large.size(); ++k)
      large[k / kLanes].set(k % kLanes, k < small.size() ? small[k].around() : nothing);
  }
}

void Candidates::find_around(int four) {
  const Ball own = levels_[1][at(four) / kLanes].get(at(four) % kLanes);
  around_.assign(1, {0, 0});
  for (std::size_t level = levels_.size() - 1; level > 0; --level) {
    larger_around_.swap(around_);
    around_.clear();
    RunCollector collector(around_);
    for (const Run& run : larger_around_)
      for (int k = run.first; k <= run.last; ++k)
        collector.take(k, levels_[level][at(k)].within(reach_ + margin_ + own.radius, own.centre));
    collector.write();
  }
}

void Candidates::build(const Points& position) {
  built_at_ = position;
  segments_.clear();
  runs_.clear();
  begin_.assign(static_cast<std::size_t>(position.cols()) + 1, 0);
  measure(position);
  if (whole_ && is_taut(position)) return;
  set_balls(position);

  const int nodes = static_cast<int>(position.cols());
  int around = -1;
  for (int i = 1; i + 1 < nodes; ++i) {
    begin_[at(i)] = runs_.size();
    if (touches_[at(i)] == 0) continue;
    // Four segments in a row look for theirs among the same.
    if (const int own = i / static_cast<int>(kLanes); own != around) find_around(around = own);
    const double limit = reach_ + margin_ + size_[i];
    const Vec3 place = position.col(i);
    const double along_least = exclusion(i);
    RunCollector collector(runs_);
    for (const Run& run : around_)
      for (int k = run.first; k <= run.last; ++k) {
        const Lanes along = four_arclengths_[at(k)] - arclength_[i];
        collector.take(k, levels_[0][at(k)].within(limit, place) & ((along >= along_least) | (along <= -along_least)));
      }
    collector.write();
    if (runs_.size() > begin_[at(i)]) segments_.push_back(i);
  }
  for (int i = std::max(nodes - 1, 0); i <= nodes; ++i) begin_[at(i)] = runs_.size();
}

}  // namespace knot_utm
