#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Four contacts that are evaluated at the same time, one in each lane.
template <typename Contact>
class Four {
 public:
  explicit Four(const std::array<Contact*, 4>& contacts) : contacts_(contacts) {}

  Lanes operator()(double ContactPoint::*number) const {
    return Lanes{contacts_[0]->*number, contacts_[1]->*number, contacts_[2]->*number, contacts_[3]->*number};
  }
  FourVectors operator()(Vec3 ContactPoint::*vector) const {
    return FourVectors::of(to_lanes(contacts_[0]->*vector), to_lanes(contacts_[1]->*vector),
                           to_lanes(contacts_[2]->*vector), to_lanes(contacts_[3]->*vector));
  }

 private:
  std::array<Contact*, 4> contacts_;
};

/// The reverse of FourVectors: separates four vectors, and a number of each, into one Lanes per contact, with the
/// number in the last lane.
class Parted {
 public:
  explicit Parted(const FourVectors& v, const Lanes& numbers = Lanes{}) : vectors_{v.x, v.y, v.z, numbers} {
    transpose(vectors_[0], vectors_[1], vectors_[2], vectors_[3]);
  }
  const Lanes& operator[](std::size_t i) const { return vectors_[i]; }

 private:
  Lanes vectors_[4];
};

/// The elastic slip xi of four contacts.
template <typename Contact>
FourVectors remembered_by(const std::array<Contact*, 4>& contacts) {
  return FourVectors::of(to_lanes(contacts[0]->memory.slip), to_lanes(contacts[1]->memory.slip),
                         to_lanes(contacts[2]->memory.slip), to_lanes(contacts[3]->memory.slip));
}

/// The input of the friction law for four contacts. `slip`: the part of the slip in the tangent plane.
template <typename Contact>
FrictionInput<FourVectors> friction_input(const std::array<Contact*, 4>& contacts, const Lanes& pressure,
                                          const FourVectors& slip, double dt) {
  return {pressure,
          slip,
          remembered_by(contacts),
          Four<Contact>(contacts)(&ContactPoint::db),
          Lanes{contacts[0]->memory.own, contacts[1]->memory.own, contacts[2]->memory.own, contacts[3]->memory.own},
          dt};
}

/// The linearised pressure law of four contacts (ContactModel).
struct FourPressures {
  Lanes slope;     // p'(D^) [N/m^2]
  Lanes pressure;  // of the tangent at the present overlap [N/m]
  Lanes turning;   // pressure in the terms in which n and z turn [N/m]
  Lanes at;        // D^ [m]

  FourPressures() = default;
  template <typename Pressure>
  FourPressures(const Pressure& normal, const ContactLinearisation& how, const Four<const ContactPoint>& four) {
    const Lanes overlap = four(&ContactPoint::overlap), prediction = four(&ContactPoint::prediction);
    // For a new contact with a large overlap, the depth where the rod stiffens gives a better tangent than the steep
    // slope at the overlap itself.
    const double stiffens = normal.stiffens_at();
    const Lanes without = select(overlap < stiffens, overlap, constant<Lanes>(stiffens));
    at = select(prediction > 0.0, normal.overlap_at(prediction), without);
    slope = normal.slope(at);
    pressure = normal.pressure(at) + slope * (overlap - at);
    turning = how.predicts ? predicted_pressure(prediction, pressure) : pressure;
  }
};

/// Calls visit(four, first) for groups of four active contacts of one pair of materials, in order. `first` is the
/// number of the first one among the active contacts. An incomplete group is filled up with its last contact.
template <typename Contacts, typename Visit>
void visit_active(Contacts& contacts, Visit visit) {
  std::array<decltype(contacts.data()), 4> four;
  std::size_t first = 0, count = 0;
  const auto end_group = [&] {
    if (count == 0) return;
    std::fill(four.begin() + static_cast<std::ptrdiff_t>(count), four.end(), four[count - 1]);
    visit(four, first);
    first += count;
    count = 0;
  };
  for (auto& contact : contacts) {
    if (!contact.active()) continue;
    if (count == 4 || (count > 0 && contact.pair != four[0]->pair)) end_group();
    four[count++] = &contact;
  }
  end_group();
}

}  // namespace knot_utm
