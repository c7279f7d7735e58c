#pragma once

#include <algorithm>
#include <vector>

#include "increment.hpp"
#include "knot_utm/rod/half_turn.hpp"

namespace knot_utm {

/// The first half of a rod which, with its load, is its own image under a half-turn. The unknowns are those of the half
/// and of two nodes behind it, on which its bending depends; these move as the images that they are. Points of contact
/// on the half are evaluated against the whole rod. By symmetry, what they exert on the other half is exerted on the
/// half, turned, by the images of these points:
///
///   f = f_a + S f_b,   K = K_aa + K_ab S + S K_ba + S K_bb S,   S (v, s) = (R v, -s)
///
/// a the half, b the images of its nodes and spins. The half-turn moves on with the middle between the grips. Inertia
/// and drag are therefore those relative to it, which is what a machine with two grips that move apart would see.
template <int D>
class HalfRod {
 public:
  HalfRod(const HalfTurn& image, const RodProperties& whole, const RodState& state, const StepSettings& settings)
      : image_(image),
        rod_(part_of(whole)),
        equation_(rod_, whole, &image_, state, settings),
        shift_before_(image.shift) {}

  Equation<D>& equation() { return equation_; }

  void take_lengths(const RodProperties& whole) {
    rod_ = part_of(whole);
    equation_.for_each_term([](auto& term) { term.take_lengths(); });
  }

  /// Begins a step on what the last one left in the whole rod's equation, and sets the motion of the middle in `start`.
  /// Returns the start of the half.
  StepStart begin(StepStart& start, const Equation<D>& whole) {
    boundary_ = start.boundary;
    leave_images(boundary_.fixed_nodes, &FixedNode::node);
    leave_images(boundary_.fixed_twists, &FixedTwist::edge);
    leave_images(boundary_.forces, &NodeForce::node);
    leave_images(boundary_.grips, &SlippingGrip::node);
    leave_images(boundary_.holds, &SpringHold::node);
    image_.shift = shift(start);
    start.middle_moves = 0.5 * (image_.shift - shift_before_);
    start.middle_velocity = middle_velocity_;
    equation_.strands.contacts().halve(whole.strands.contacts());
    equation_.rollers.contacts().halve(whole.rollers.contacts(), static_cast<int>(rod_.nodes()));
    return {start.state, boundary_, start.dt, start.middle_moves, start.middle_velocity};
  }

  /// Places the solved half and its image as the trial of the whole rod's equation, which has begun the same step.
  void place(Equation<D>& whole) const {
    whole.x = equation_.x;
    whole.strands.contacts().mirror(equation_.strands.contacts(), image_);
    if constexpr (D == 4) whole.frames.mirror(equation_.frames, image_);
  }

  void commit(const StepStart& step) {
    equation_.matrix.commit();
    shift_before_ = image_.shift;
    middle_velocity_ = step.middle_moves / step.dt;
  }

  void state(Archive& archive) { archive(equation_.matrix, shift_before_, middle_velocity_); }

 private:
  RodProperties part_of(const RodProperties& whole) const {
    constexpr int kBehind = 2;
    RodProperties out = whole;
    out.rest_length.conservativeResize(image_.half() + kBehind - 1);
    out.voronoi_length.conservativeResize(image_.half() + kBehind);
    out.mass.conservativeResize(image_.half() + kBehind);
    return out;
  }

  template <typename Item>
  void leave_images(std::vector<Item>& list, int Item::*place) const {
    const auto is_image = [&](const Item& item) { return item.*place >= image_.half(); };
    list.erase(std::remove_if(list.begin(), list.end(), is_image), list.end());
  }

  /// t at the end of a step: what holds the rod maps onto itself, too. Where nothing does, the rod's ends tell.
  Vec3 shift(const StepStart& start) const {
    const Boundary& all = start.boundary;
    if (all.rollers.size() == 2) return all.rollers[1].centre - image_.turn * all.rollers[0].centre;
    for (const FixedNode& a : all.fixed_nodes)
      for (const FixedNode& b : all.fixed_nodes)
        if (b.node == image_.image(a.node)) return b.position - image_.turn * a.position;
    const Points& x = start.state.position;
    return x.rightCols<1>() - image_.turn * x.leftCols<1>();
  }

  HalfTurn image_;
  RodProperties rod_;
  Equation<D> equation_;
  Boundary boundary_;                                   // of the half, in this step
  Vec3 shift_before_, middle_velocity_ = Vec3::Zero();  // t after the last step [m]; in that step [m/s]
};

}  // namespace knot_utm
