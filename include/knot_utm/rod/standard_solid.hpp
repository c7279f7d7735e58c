#pragma once

namespace knot_utm {

/// A standard linear solid, also called a Zener solid: a spring beside a Maxwell element. Its stiffness k is what a
/// fast strain e meets. The share s of it relaxes with the time tau while the strain is held,
///
///     sigma = (1 - s) k e + s k xi,   xi = e - e_v,   de_v/dt = xi/tau,
///
/// e_v being the strain of the dashpot, which the rod's state remembers. A time step takes the dashpot by the implicit
/// Euler method, as it takes all else. With e_v of the last accepted step and r = dt/tau,
///
///     xi = (e - e_v)/(1 + r),   dsigma/de = k (1 - s + s/(1 + r))
///
///     stored  k/2 [(1 - s) e^2 + s xi^2],   dissipated in the step  s k r xi^2,
///
/// and W, the former and half of the latter, has sigma = dW/de. A stress that is held constant decays to (1 - s) of
/// itself as r -> infinity; steps far longer than tau are therefore those of the relaxed rod.
/// Source: Christensen 1982, chapter 1; Simo, Hughes 1998, chapter 10 (integration).
struct StandardSolid {
  double share = 0.0;  ///< s, 0 to less than 1 [-]
  double time = 1.0;   ///< tau, more than 0 [s]

  /// r
  double ratio(double dt) const { return dt / time; }
  /// dsigma/de over k
  double stiffness(double dt) const { return 1.0 - share + share / (1.0 + ratio(dt)); }
  /// xi
  template <typename Strain>
  Strain spring(const Strain& strain, const Strain& dashpot, double dt) const {
    return (1.0 / (1.0 + ratio(dt))) * (strain - dashpot);
  }
  /// sigma/k
  template <typename Strain>
  Strain stress(const Strain& strain, const Strain& spring) const {
    return (1.0 - share) * strain + share * spring;
  }
  /// What is stored and what is dissipated over k, from |e|^2 and |xi|^2.
  double stored(double strain2, double spring2) const { return 0.5 * ((1.0 - share) * strain2 + share * spring2); }
  double dissipated(double spring2, double dt) const { return share * ratio(dt) * spring2; }
};

}  // namespace knot_utm
