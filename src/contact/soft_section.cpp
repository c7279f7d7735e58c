#include "knot_utm/contact/soft_section.hpp"

namespace knot_utm {
namespace {

Vec3 over(const Vec3& along) {
  const double length2 = along.squaredNorm();
  return length2 > 0.0 ? Vec3(along / length2) : Vec3(Vec3::Zero());
}

}  // namespace

void add_thinning(const ContactLaws& laws, const std::vector<ContactPoint>& contacts,
                  std::vector<SurfacePoint>& surfaces, std::vector<SoftPoint>& soft) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactPoint& contact = contacts[i];
    if (!contact.touches()) continue;
    SoftPoint& of = soft[i];
    const double energy = laws[contact.pair].normal.energy(contact.overlap),
                 both = energy + 0.5 * contact.pressure * (of.sum - contact.overlap);
    of.thins_a = contact.weight / of.scale * (of.share_a * both - energy);
    of.thins_b = contact.weight / of.scale * of.share_b * both;
    SurfacePoint& surface = surfaces[i];
    surface.on_a += to_lanes(Vec3(of.thins_a * over(surface.along_a)));
    if (!contact.on_roller()) surface.on_b += to_lanes(Vec3(of.thins_b * over(contact.db)));
  }
}

double overlap_change(const ContactPoint& contact, const SurfacePoint& surface, const SoftPoint& soft,
                      const Vec3& shift, const Vec3& turn_a, const Vec3& turn_b) {
  double longer = soft.share_a * over(surface.along_a).dot(turn_a);
  if (!contact.on_roller()) {
    const double foot = contact.inverse_g * (contact.db.dot(shift) + contact.x.dot(turn_b));
    longer += soft.share_b * (over(contact.db).dot(turn_b + foot * surface.bend_b) - foot * soft.rest_growth);
  }
  return -soft.scale * contact.n.dot(shift) - 0.5 * (soft.sum - contact.overlap) * longer;
}

void add_thinning(const ContactPoint& contact, const SurfacePoint& surface, const SoftPoint& soft, double before,
                  ContactMotion& motion) {
  // Of what stands at the same foot now and then: lambda_now/lambda_before.
  const auto longer = [](const Vec3& now, const Vec3& turn) {
    const double then = (now - turn).norm();
    return then > 0.0 ? now.norm() / then : 1.0;
  };
  const double a = longer(surface.along_a, surface.turn_a),
               b = contact.on_roller() ? 1.0 : longer(contact.db, contact.turn);
  const double wider = soft.share_a * std::sqrt(a) + soft.share_b * std::sqrt(b);  // Z before, over Z now
  const double apart = soft.radii() - contact.overlap / soft.scale + before - contact.d;
  motion.overlap_before = soft.sum - apart * soft.scale / wider;
  motion.weight = contact.weight / soft.scale;
  motion.weight_before = motion.weight * wider * wider / a;
  motion.thinning = soft.thins_a * over(surface.along_a).dot(surface.turn_a);
  if (!contact.on_roller()) motion.thinning += soft.thins_b * over(contact.db).dot(contact.turn);
}

}  // namespace knot_utm
