#include "knot_utm/specimen/knot_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "knot_utm/numeric/pieces.hpp"
#include "knot_utm/specimen/knot_facts.hpp"

namespace knot_utm {

namespace {

// All lengths of a picture are in units of which ten are the radius of the rod.
constexpr double kUnits = 10.0;
constexpr double kRopeWidth = 18.0, kCasingWidth = 25.0;  // 2 h is 20: strands that touch stay apart
constexpr Eigen::Index kTogether = 2;                     // edges that are drawn at once
constexpr double kLetters = 24.0, kWidthOfLetter = 0.55 * kLetters;
constexpr double kAwayFromEnd = 22.0;  // of its name
constexpr double kMarginOfView = 30.0;
constexpr double kPostsEnd = 40.0;  // of a post beyond the knot
constexpr double kEndOn = 0.3;      // sine of the angle below which a post is a circle
constexpr int kPiecesOfRing = 48;
constexpr std::array kRopeColours{"#1f5fa8", "#d9622b", "#2f8f4e", "#8a4fa3", "#a98600"};
constexpr const char* kPostColour = "#b9bcc2";

using Place = Eigen::Vector2d;

double width_of(const std::string& words) { return kWidthOfLetter * static_cast<double>(words.size()); }

std::string escaped(const std::string& words) {
  std::string out;
  for (const char c : words) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else
      out += c;
  }
  return out;
}

/// One thing to draw, and how near to the eye it is [m].
struct Drawn {
  double near;
  std::string element;
};

/// What one view shows, in its own frame: to the right, and down.
class SeenKnot {
 public:
  SeenKnot(const PicturedKnot& knot, const PictureView& view) : knot_(knot), view_(view) {
    for (Eigen::Index i = 0; i < knot.centreline.points.cols(); ++i) take_in(place(knot.centreline.points.col(i)));
    for (const Roller& post : knot.posts) post.ring > 0.0 ? add_ring(post) : add_post(post);
    const std::vector<Piece> ropes = pieces_between(knot.centreline.points.cols(), knot.centreline.cuts);
    for (std::size_t k = 0; k < ropes.size(); ++k) add_rope(ropes[k], k);
    std::stable_sort(drawn_.begin(), drawn_.end(), [](const Drawn& a, const Drawn& b) { return a.near < b.near; });
  }

  double width() const { return std::max(high_.x() - low_.x(), width_of(view_.caption)) + 2.0 * kMarginOfView; }
  double height() const { return high_.y() - low_.y() + 2.0 * kMarginOfView; }

  /// With its upper left corner at a place, and its caption below.
  std::string at(double x, double y, double caption) const {
    std::ostringstream out;
    const Place shift = Place(x, y) + Place::Constant(kMarginOfView) - low_;
    out << "<g transform=\"translate(" << std::lround(shift.x()) << ' ' << std::lround(shift.y()) << ")\">\n";
    for (const Drawn& one : drawn_) out << one.element;
    for (const std::string& name : names_) out << name;
    out << "</g>\n<text x=\"" << std::lround(x + kMarginOfView) << "\" y=\"" << std::lround(caption)
        << "\" fill=\"#666\">" << view_.caption << "</text>\n";
    return out.str();
  }

 private:
  Place place(const Vec3& point) const {
    return kUnits / knot_.radius * Place(point.dot(view_.right), -point.dot(PictureView::up()));
  }
  void take_in(const Place& place) {
    low_ = low_.cwiseMin(place);
    high_ = high_.cwiseMax(place);
  }

  /// The nodes from `begin` to before `end`.
  std::string line(Eigen::Index begin, Eigen::Index end, double width, const char* colour) const {
    std::ostringstream out;
    out.setf(std::ios::fixed);
    out.precision(1);
    out << "<polyline stroke=\"" << colour << "\" stroke-width=\"" << width << "\" points=\"";
    for (Eigen::Index i = begin; i < end; ++i) {
      const Place at = place(knot_.centreline.points.col(i));
      out << (i > begin ? " " : "") << at.x() << ',' << at.y();
    }
    out << "\"/>\n";
    return out.str();
  }

  /// Piece by piece: each lies on a wider white line, which leaves a gap in what is behind it. Both reach over the
  /// piece's neighbours, the rope further than the white, so that no seams are seen.
  void add_rope(const Piece& rope, std::size_t number) {
    const char* colour = kRopeColours[number % kRopeColours.size()];
    for (Eigen::Index i = rope.begin; i + 1 < rope.end; i += kTogether) {
      const Eigen::Index end = std::min(i + kTogether + 1, rope.end);
      const auto beyond = [&](Eigen::Index nodes, double width, const char* of_colour) {
        return line(std::max(i - nodes, rope.begin), std::min(end + nodes, rope.end), width, of_colour);
      };
      const double near = view_.near.dot(knot_.centreline.points.middleCols(i, end - i).rowwise().mean());
      drawn_.push_back({near, beyond(1, kCasingWidth, "white") + beyond(2, kRopeWidth, colour)});
    }
    add_name(rope.begin, rope.begin + 1, knot_.ends[number][0], colour);
    add_name(rope.end - 1, rope.end - 2, knot_.ends[number][1], colour);
  }

  /// Beyond the end, and further up or down where another name stands there.
  void add_name(Eigen::Index end, Eigen::Index next, const std::string& name, const char* colour) {
    const Place at = place(knot_.centreline.points.col(end));
    Place away = at - place(knot_.centreline.points.col(next));
    away = away.norm() > 1e-3 ? Place(away.normalized()) : Place(1.0, 0.0);
    const Place middle = at + kAwayFromEnd * away + Place(0.0, 0.35 * kLetters);
    const double width = width_of(name);
    const double left = middle.x() - (away.x() > 0.3 ? 0.0 : away.x() < -0.3 ? width : 0.5 * width);
    Eigen::AlignedBox2d box(Place(left, middle.y() - kLetters), Place(left + width, middle.y()));
    const auto is_taken = [&] {
      return std::any_of(taken_.begin(), taken_.end(), [&](const auto& other) { return box.intersects(other); });
    };
    while (is_taken()) box.translate(Place(0.0, away.y() < 0.0 ? -kLetters : kLetters));
    taken_.push_back(box);
    take_in(box.min());
    take_in(box.max());
    std::ostringstream out;
    out << "<text x=\"" << std::lround(left) << "\" y=\"" << std::lround(box.max().y()) << "\" fill=\"" << colour
        << "\" stroke=\"white\" stroke-width=\"5\" paint-order=\"stroke\">" << escaped(name) << "</text>\n";
    names_.push_back(out.str());
  }

  /// Piece by piece, since parts of it lie before the ropes and others behind them.
  void add_ring(const Roller& ring) {
    const double thickness = kUnits * ring.radius / knot_.radius;
    const Vec3 side = ring.axis.unitOrthogonal(), other = ring.axis.cross(side);
    const auto at = [&](double part) -> Vec3 {
      const double angle = 2.0 * M_PI * part / kPiecesOfRing;
      return ring.centre + ring.ring * (std::cos(angle) * side + std::sin(angle) * other);
    };
    for (int i = 0; i < kPiecesOfRing; ++i) {
      const Place from = place(at(i)), to = place(at(i + 1));
      drawn_.push_back({at(i + 0.5).dot(view_.near), post_line(from, to, thickness, "round")});
      take_in(from - Place::Constant(thickness));
      take_in(from + Place::Constant(thickness));
    }
  }

  static std::string post_line(const Place& from, const Place& to, double thickness, const char* ends) {
    std::ostringstream out;
    out << "<line x1=\"" << from.x() << "\" y1=\"" << from.y() << "\" x2=\"" << to.x() << "\" y2=\"" << to.y()
        << "\" stroke=\"" << kPostColour << "\" stroke-width=\"" << 2.0 * thickness << "\" stroke-linecap=\"" << ends
        << "\"/>\n";
    return out.str();
  }

  void add_post(const Roller& post) {
    const double across = std::sqrt(std::max(0.0, 1.0 - std::pow(post.axis.dot(view_.near), 2)));
    const double thickness = kUnits * post.radius / knot_.radius;
    const Place centre = place(post.centre);
    std::ostringstream out;
    if (across < kEndOn) {
      out << "<circle cx=\"" << centre.x() << "\" cy=\"" << centre.y() << "\" r=\"" << thickness << "\" fill=\""
          << kPostColour << "\" stroke=\"none\"/>\n";
      take_in(centre - Place::Constant(thickness));
      take_in(centre + Place::Constant(thickness));
    } else {
      const Eigen::RowVectorXd along = post.axis.transpose() * (knot_.centreline.points.colwise() - post.centre);
      const double beyond = kPostsEnd * knot_.radius / kUnits;
      const Place from = place(post.centre + (along.minCoeff() - beyond) * post.axis),
                  to = place(post.centre + (along.maxCoeff() + beyond) * post.axis);
      out << post_line(from, to, thickness, "butt");
      for (const Place& end : {from, to}) {
        take_in(end - Place::Constant(thickness));
        take_in(end + Place::Constant(thickness));
      }
    }
    drawn_.push_back({post.centre.dot(view_.near), out.str()});
  }

  const PicturedKnot& knot_;
  PictureView view_;
  Place low_ = Place::Constant(1e9), high_ = Place::Constant(-1e9);
  std::vector<Drawn> drawn_;
  std::vector<std::string> names_;
  std::vector<Eigen::AlignedBox2d> taken_;  // by names
};

}  // namespace

std::string knot_svg(const PicturedKnot& knot) {
  const SeenKnot front(knot, front_view()), side(knot, side_view());
  const double top = 2.5 * kLetters;
  const double width = std::max(front.width() + side.width(), width_of(knot.title) + 2.0 * kMarginOfView);
  const double height = top + std::max(front.height(), side.height()) + 2.0 * kLetters;
  std::ostringstream out;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << std::lround(width) << ' ' << std::lround(height)
      << "\" width=\"" << std::lround(width) << "\" height=\"" << std::lround(height)
      << "\" fill=\"none\" stroke-linejoin=\"round\" font-family=\"sans-serif\" font-size=\"" << kLetters << "\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<text x=\"" << kMarginOfView << "\" y=\""
      << 1.5 * kLetters << "\" fill=\"#222\" font-weight=\"bold\">" << escaped(knot.title) << "</text>\n"
      << front.at(0.0, top, height - kLetters) << side.at(front.width(), top, height - kLetters) << "</svg>\n";
  return out.str();
}

}  // namespace knot_utm
