#pragma once

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/energy.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/stretching.hpp"
#include "rod/isotropic_bending_local.hpp"

namespace knot_utm {

/// A rod at rest under dead loads, for closed forms: Newton's method on the elastic energy less the loads' work.
/// Dimensionless: bending stiffness and length are about one.
///
/// Unknowns are numbered x_0, theta_0, x_1, theta_1, ..., x_{N-1}; each is free, held, or tied to another one.
class StaticRod {
 public:
  enum class Path {
    kTwistFree,       ///< isotropic bending on the centreline alone
    kFull,            ///< material curvatures and twist
    kIsotropicTwist,  ///< isotropic bending on the centreline, and twist
  };

  StaticRod(const RodProperties& rod, const Points& position, Path path)
      : rod_(rod), path_(path), load_(Eigen::VectorXd::Zero(4 * rod.nodes() - 1)) {
    state_.position = position;
    initialise_frames(&state_);
    leader_.resize(static_cast<std::size_t>(load_.size()));
    for (std::size_t k = 0; k < leader_.size(); ++k) leader_[k] = static_cast<Eigen::Index>(k);
    if (path_ == Path::kTwistFree) {
      for (Eigen::Index j = 0; j < rod_.edges(); ++j) hold(theta(j));
    }
  }

  static Eigen::Index x(Eigen::Index node, Eigen::Index axis = 0) { return 4 * node + axis; }
  static Eigen::Index theta(Eigen::Index edge) { return 4 * edge + 3; }

  void hold(Eigen::Index unknown) { leader_[static_cast<std::size_t>(unknown)] = kHeld; }
  void hold_node(Eigen::Index node) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) hold(x(node, axis));
  }
  /// From now on `unknown` moves exactly as `leader`, an unknown of lower number.
  void tie(Eigen::Index unknown, Eigen::Index leader) {
    leader_[static_cast<std::size_t>(unknown)] = leader_[static_cast<std::size_t>(leader)];
  }

  RodState& state() { return state_; }
  const Points& position() const { return state_.position; }
  Eigen::VectorXd& load() { return load_; }

  double energy() const {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < rod_.edges(); ++j) {
      sum += local_stretching(j).energy;
    }
    for (Eigen::Index i = 1; i + 1 < rod_.nodes(); ++i) {
      const InnerNode node = inner_node(rod_, state_, i);
      sum += path_ == Path::kFull
                 ? bending_energy(node.bending, node.e, node.f, node.on_e, node.on_f)
                 : isotropic_bending_gradient(node.bending.k_b, node.bending.voronoi_length, node.e, node.f).energy;
      if (path_ != Path::kTwistFree) sum += twisting_energy(node.twisting, node.twist);
    }
    return sum;
  }

  /// dE/d(unknown) over all 4N-1 unknowns.
  Eigen::VectorXd gradient() const {
    Eigen::VectorXd g = Eigen::VectorXd::Zero(load_.size());
    assemble(&g, nullptr);
    return g;
  }

  /// Residual gradient - load, in the free unknowns.
  Eigen::VectorXd residual() const { return reduce(gradient() - load_); }

  /// Hessian in the free unknowns.
  Eigen::SparseMatrix<double> hessian() const {
    Eigen::VectorXd g = Eigen::VectorXd::Zero(load_.size());
    std::vector<Eigen::Triplet<double>> full;
    assemble(&g, &full);
    const std::vector<Eigen::Index> number = numbering();
    std::vector<Eigen::Triplet<double>> free;
    for (const auto& entry : full) {
      const Eigen::Index row = number[static_cast<std::size_t>(entry.row())];
      const Eigen::Index column = number[static_cast<std::size_t>(entry.col())];
      if (row != kHeld && column != kHeld) {
        free.emplace_back(static_cast<int>(row), static_cast<int>(column), entry.value());
      }
    }
    Eigen::SparseMatrix<double> h(free_unknowns(), free_unknowns());
    h.setFromTriplets(free.begin(), free.end());
    return h;
  }

  Eigen::Index free_unknowns() const {
    Eigen::Index count = 0;
    for (std::size_t k = 0; k < leader_.size(); ++k) count += leader_[k] == static_cast<Eigen::Index>(k) ? 1 : 0;
    return count;
  }

  /// A gradient over all unknowns, gathered on the free ones.
  Eigen::VectorXd reduce(const Eigen::VectorXd& full) const {
    const std::vector<Eigen::Index> number = numbering();
    Eigen::VectorXd reduced = Eigen::VectorXd::Zero(free_unknowns());
    for (Eigen::Index k = 0; k < full.size(); ++k) {
      const Eigen::Index n = number[static_cast<std::size_t>(k)];
      if (n != kHeld) reduced[n] += full[k];
    }
    return reduced;
  }

  /// Moves the free unknowns by `step` and carries the frames along.
  void move(const Eigen::VectorXd& step) {
    const std::vector<Eigen::Index> number = numbering();
    const Points before = state_.position;
    for (Eigen::Index k = 0; k < load_.size(); ++k) {
      const Eigen::Index n = number[static_cast<std::size_t>(k)];
      if (n == kHeld) continue;
      (k % 4 == 3 ? state_.twist[k / 4] : state_.position(k % 4, k / 4)) += step[n];
    }
    transport_frames(before, &state_);
  }

  /// What rounding of the positions leaves in the residual: stretching stiffness times the strain it makes.
  double rounding() const {
    return 20.0 * std::numeric_limits<double>::epsilon() * rod_.material.stretching_stiffness * rod_.length() /
           rod_.rest_length.minCoeff();
  }

  /// True where the residual came down to rounding.
  bool solve(int iterations = 400) {
    const double tolerance = rounding();
    for (int iteration = 0; iteration < iterations; ++iteration) {
      const Eigen::VectorXd r = residual();
      if (r.cwiseAbs().maxCoeff() < tolerance) return true;
      const Eigen::VectorXd step = descent(r);
      const RodState start = state_;
      const double start_energy = potential();
      double fraction = std::min(1.0, kLongestStep / step.cwiseAbs().maxCoeff());
      for (int halving = 0; halving < 30; ++halving) {
        move(fraction * step);
        // Near the end rounding hides the descent; there the full step is right.
        if (potential() <= start_energy + 1e-10 * (1.0 + std::abs(start_energy))) break;
        state_ = start;
        fraction *= 0.5;
      }
    }
    return false;
  }

  /// Negative eigenvalues of the Hessian, by Sylvester's law of inertia.
  Eigen::Index unstable_modes() const {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(hessian());
    return (factor.vectorD().array() < 0.0).count();
  }

 private:
  static constexpr Eigen::Index kHeld = -1;
  static constexpr double kLongestStep = 0.2;

  Vec3 edge(Eigen::Index j) const { return state_.position.col(j + 1) - state_.position.col(j); }

  double potential() const {
    double work = 0.0;
    for (Eigen::Index k = 0; k < load_.size(); ++k) {
      work += load_[k] * (k % 4 == 3 ? state_.twist[k / 4] : state_.position(k % 4, k / 4));
    }
    return energy() - work;
  }

  std::vector<Eigen::Index> numbering() const {
    std::vector<Eigen::Index> number(leader_.size(), kHeld);
    Eigen::Index next = 0;
    for (std::size_t k = 0; k < leader_.size(); ++k) {
      if (leader_[k] == kHeld) continue;
      number[k] = leader_[k] == static_cast<Eigen::Index>(k) ? next++ : number[static_cast<std::size_t>(leader_[k])];
    }
    return number;
  }

  /// Newton's step, with a growing diagonal where the Hessian is not positive definite.
  Eigen::VectorXd descent(const Eigen::VectorXd& r) const {
    Eigen::SparseMatrix<double> h = hessian();
    Eigen::SparseMatrix<double> identity(h.rows(), h.cols());
    identity.setIdentity();
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(h);
    for (double shift = 1e-2; (factor.vectorD().array() <= 0.0).any(); shift *= 4.0) {
      factor.compute(h + shift * identity);
    }
    return factor.solve(-r);
  }

  StretchingLocal local_stretching(Eigen::Index j) const {
    return stretching(LinearStretching(), rod_.material.stretching_stiffness, rod_.rest_length[j], edge(j));
  }

  void assemble(Eigen::VectorXd* g, std::vector<Eigen::Triplet<double>>* h) const {
    const auto add = [&](Eigen::Index first, const auto& gradient, const auto& hessian) {
      g->segment(first, gradient.size()) += gradient;
      if (h == nullptr) return;
      for (Eigen::Index a = 0; a < hessian.rows(); ++a) {
        for (Eigen::Index b = 0; b < hessian.cols(); ++b) {
          h->emplace_back(static_cast<int>(first + a), static_cast<int>(first + b), hessian(a, b));
        }
      }
    };
    for (Eigen::Index j = 0; j < rod_.edges(); ++j) {
      const StretchingLocal local = local_stretching(j);
      StencilVector slope = StencilVector::Zero();
      StencilMatrix curve = StencilMatrix::Zero();
      slope.segment<3>(0) = -local.gradient;
      slope.segment<3>(4) = local.gradient;
      curve.block<3, 3>(0, 0) = local.hessian;
      curve.block<3, 3>(4, 4) = local.hessian;
      curve.block<3, 3>(0, 4) = -local.hessian;
      curve.block<3, 3>(4, 0) = -local.hessian;
      add(4 * j, slope.head<7>(), curve.topLeftCorner<7, 7>());
    }
    for (Eigen::Index i = 1; i + 1 < rod_.nodes(); ++i) {
      const InnerNode node = inner_node(rod_, state_, i);
      if (path_ == Path::kFull) {
        const StencilLocal local = bending(node.bending, node.e, node.f, node.on_e, node.on_f);
        add(4 * (i - 1), local.gradient, local.hessian);
      } else {
        const IsotropicBendingLocal local =
            isotropic_bending(node.bending.k_b, node.bending.voronoi_length, node.e, node.f);
        EdgePairHessian curve;
        curve.ee = local.hessian_ee;
        curve.ef = local.hessian_ef;
        curve.ff = local.hessian_ff;
        add(4 * (i - 1), on_nodes(EdgePairGradient{local.gradient_e, local.gradient_f, 0.0, 0.0}), on_nodes(curve));
      }
      if (path_ == Path::kTwistFree) continue;
      const StencilLocal local = twisting(node.twisting, node.e, node.f, node.twist);
      add(4 * (i - 1), local.gradient, local.hessian);
    }
  }

  RodProperties rod_;
  Path path_;
  RodState state_;
  Eigen::VectorXd load_;
  std::vector<Eigen::Index> leader_;
};

/// A rod of unit bending stiffness, n edges of length l.
inline RodProperties unit_rod(Eigen::Index n, double l, double stretching_stiffness, double twisting_stiffness = 1.0) {
  RodMaterial material;
  material.radius = 0.01;
  material.density = 1.0;
  material.bending_stiffness = 1.0;
  material.stretching_stiffness = stretching_stiffness;
  material.twisting_stiffness = twisting_stiffness;
  return make_rod(material, Eigen::VectorXd::Constant(n, l));
}

/// n edges of length l along +x, from x = start.
inline Points straight_line(Eigen::Index n, double l, double start = 0.0) {
  Points x = Points::Zero(3, n + 1);
  x.row(0).setLinSpaced(n + 1, start, start + static_cast<double>(n) * l);
  return x;
}

}  // namespace knot_utm
