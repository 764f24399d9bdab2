// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/analysis/modes.h"

#include <fmt/format.h>

#include <Spectra/SymGEigsShiftSolver.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "structure/analysis/coloured_products.h"
#include "structure/analysis/conjugate_gradients.h"
#include "structure/analysis/rigid_motions.h"

namespace structure {

namespace {

/// Free degrees of freedom of nodal arrays, one after the other.
class FreeDofs {
 public:
  FreeDofs(const Supports& supports, int node_count)
      : numbers_(numbers_of_free(supports, node_count)),
        count_(static_cast<Eigen::Index>(numbers_.size() - supports.fixed_dofs().size())) {}
  Eigen::Index count() const { return count_; }
  void spread(const double* values, NodalVectors& q) const {
    for (std::size_t dof = 0; dof < numbers_.size(); ++dof)
      q.data()[dof] = numbers_[dof] < 0 ? 0.0 : values[numbers_[dof]];
  }
  void gather(const NodalVectors& q, double* values) const {
    for (std::size_t dof = 0; dof < numbers_.size(); ++dof)
      if (numbers_[dof] >= 0) values[numbers_[dof]] = q.data()[dof];
  }

 private:
  std::vector<int> numbers_;
  Eigen::Index count_;
};

/// y = M x, as Spectra asks for it.
class MassProduct {
 public:
  using Scalar = double;
  MassProduct(const MassMatrix& mass, const FreeDofs& free, int node_count)
      : mass_(mass), free_(free), q_(3, node_count) {}
  Eigen::Index rows() const { return free_.count(); }
  void perform_op(const double* x, double* y) const {
    free_.spread(x, q_);
    free_.gather(mass_ * q_, y);
  }

 private:
  const MassMatrix& mass_;
  const FreeDofs& free_;
  mutable NodalVectors q_;
};

/// Shapes with q . M q = 1, each at right angles to the others in this sense.
class OrthonormalShapes {
 public:
  explicit OrthonormalShapes(const MassMatrix& mass) : mass_(mass) {}
  double product(const NodalVectors& a, const NodalVectors& b) const {
    return a.cwiseProduct(mass_ * b).sum();
  }
  /// Takes from q what is along them; twice, for round-off.
  void remove_from(NodalVectors& q) const {
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t k = 0; k < shapes_.size(); ++k) q -= M_shapes_[k].cwiseProduct(q).sum() * shapes_[k];
  }
  /// The same from forces b: then M^-1 b is free of them.
  void remove_from_forces(NodalVectors& b) const {
    for (std::size_t k = 0; k < shapes_.size(); ++k) b -= M_shapes_[k] * shapes_[k].cwiseProduct(b).sum();
  }
  void add(NodalVectors q) {
    remove_from(q);
    shapes_.push_back(q / std::sqrt(product(q, q)));
    M_shapes_.push_back(mass_ * shapes_.back());
  }
  const std::vector<NodalVectors>& all() const { return shapes_; }

 private:
  const MassMatrix& mass_;
  std::vector<NodalVectors> shapes_, M_shapes_;
};

/// y = c (K + s M)^-1 x, likewise, without what is along shapes that are known.  Spectra takes for zero what
/// is small beside 1, so c is chosen such that the largest eigenvalues are of that size.
class InverseProduct {
 public:
  using Scalar = double;
  InverseProduct(const Tangent& tangent, const FreeDofs& free, const OrthonormalShapes& known,
                 const ModeOptions& options)
      : tangent_(tangent),
        free_(free),
        known_(known),
        preconditioner_(make_preconditioner(tangent, options.preconditioner)),
        limits_{0.01 * options.tolerance},
        on_solve_(options.on_solve),
        b_(3, tangent.body().node_count()) {}
  Eigen::Index rows() const { return free_.count(); }
  /// Of the space that the known shapes leave.
  Eigen::Index dimension() const { return rows() - static_cast<Eigen::Index>(known_.all().size()); }
  void set_shift(double /*sigma*/) {}  // the tangent has it
  /// Of this many, at least, from now on, whose first chooses c.
  void begin(int products) {
    expected_ = solved_ + products;
    scale_ = 0.0;
  }
  /// omega^2 of what Spectra found, and q of its numbers.
  Mode mode(double eigenvalue, const double* values, double shift) const {
    Mode mode{scale_ * eigenvalue - shift, NodalVectors(3, tangent_.body().node_count())};
    free_.spread(values, mode.shape);
    mode.shape /= std::sqrt(known_.product(mode.shape, mode.shape));
    return mode;
  }
  /// Where one is left.
  Mode last_mode(double shift) {
    begin(1);
    Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(rows(), 1.0, 2.0);
    perform_op(values.data(), values.data());
    return mode(1.0, values.data(), shift);
  }
  /// Rayleigh's quotient less omega^2, relative: the square of what a shape has of other modes.
  double error(const Mode& mode, double shift) const {
    tangent_.multiply(mode.shape, b_);
    const double quotient = b_.cwiseProduct(mode.shape).sum() / known_.product(mode.shape, mode.shape);
    return std::abs(quotient / (mode.eigenvalue + shift) - 1.0);
  }
  void perform_op(const double* x, double* y) const {
    free_.spread(x, b_);
    known_.remove_from_forces(b_);
    tangent_.supports().apply(b_);  // consistent masses act on fixed degrees of freedom, too
    const CgResult result = conjugate_gradients(tangent_.product(), *preconditioner_, b_, x_, limits_);
    if (!result.is_positive)
      throw std::runtime_error("modes: the stiffness is not positive: the body has buckled");
    if (!result.converged)
      throw std::runtime_error(
          fmt::format("modes: conjugate gradients are at {:.2e} after {} products, expected {:.1e}",
                      result.residual, result.products, limits_.tolerance));
    known_.remove_from(x_);
    if (scale_ == 0.0) scale_ = x_.cwiseProduct(b_).sum() / known_.product(x_, x_);
    x_ *= scale_;
    free_.gather(x_, y);
    if (on_solve_) on_solve_(++solved_, expected_);
  }

 private:
  const Tangent& tangent_;
  const FreeDofs& free_;
  const OrthonormalShapes& known_;
  std::unique_ptr<Preconditioner> preconditioner_;
  CgLimits limits_;
  std::function<void(int, int)> on_solve_;
  mutable NodalVectors b_, x_;
  mutable double scale_ = 0.0;
  mutable int solved_ = 0;
  int expected_ = 0;
};

/// The least quotient of the springs' stiffness and the mass, of rigid motions that springs alone hold.
double least_on_springs(const NodalVectors& positions, const Supports& supports, const Springs& springs,
                        const OrthonormalShapes& known) {
  constexpr double kRest = 1e-6;  // below it, the motion is a known one
  double least = std::numeric_limits<double>::infinity();
  if (springs.empty()) return least;
  for (const NodalVectors& motion : free_rigid_motions(positions, supports)) {
    NodalVectors rest = motion, force = NodalVectors::Zero(3, motion.cols());
    known.remove_from(rest);
    const double mass = known.product(rest, rest);
    if (mass < kRest * known.product(motion, motion)) continue;
    springs.add_forces(rest, force);
    least = std::min(least, rest.cwiseProduct(force).sum() / mass);
  }
  return least;
}

/// A shift where the body can move as a whole: about the least omega^2 of displacements that are quadratic in
/// one coordinate, less what rigid motions have of them.
double shift_of_free_body(const Tangent& tangent, const OrthonormalShapes& rigid) {
  const NodalVectors& X = tangent.body().reference();
  double least = std::numeric_limits<double>::infinity();
  NodalVectors f(3, X.cols());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      NodalVectors bent = NodalVectors::Zero(3, X.cols());
      bent.row(i) = X.row(j).cwiseAbs2();
      rigid.remove_from(bent);
      tangent.supports().apply(bent);
      tangent.multiply(bent, f);
      const double quotient = bent.cwiseProduct(f).sum() / rigid.product(bent, bent);
      if (quotient > 0.0) least = std::min(least, quotient);
    }
  return least;
}

/// Of the lowest `count` that are not among the known those that round-off lets be found.
std::vector<Mode> further_modes(InverseProduct& inverse, MassProduct& mass, int count, double shift,
                                double tolerance) {
  if (inverse.dimension() == 1) return {inverse.last_mode(shift)};
  const Eigen::Index basis = std::min<Eigen::Index>(inverse.dimension(), 2 * count + 10);
  inverse.begin(static_cast<int>(basis));
  Spectra::SymGEigsShiftSolver<InverseProduct, MassProduct, Spectra::GEigsMode::ShiftInvert> solver(
      inverse, mass, count, basis, 0.0);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, 1000, tolerance, Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw std::runtime_error(fmt::format("modes: {} of {} modes found", solver.eigenvalues().size(), count));
  constexpr double kLargestError = 1e-6;  // above the round-off of slender bodies
  double least = std::numeric_limits<double>::infinity();
  std::vector<Mode> modes;
  const Eigen::MatrixXd shapes = solver.eigenvectors();
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    Mode mode = inverse.mode(solver.eigenvalues()[k], shapes.col(k).data(), shift);
    const double error = inverse.error(mode, shift);
    least = std::min(least, error);
    if (error <= kLargestError) modes.push_back(std::move(mode));
  }
  if (modes.empty())
    throw std::runtime_error(fmt::format(
        "modes: omega^2 of {} modes differs from their stiffness over mass by {:.1e} of it or more, "
        "expected {:.0e}: stiffnesses may lie too far apart for double precision, as those of very "
        "weak springs and of the body; make them less different",
        count, least, kLargestError));
  return modes;
}

}  // namespace

double Mode::frequency() const { return std::sqrt(std::max(0.0, eigenvalue)) / nurbs::kTwoPi; }

// Lanczos' method from one start sees one mode of several that have the same frequency, as a square plate
// has: so it is asked again, without what is known, until nothing lower comes.
std::vector<Mode> lowest_modes(const Body& body, const Supports& supports, const NodalVectors& u,
                               const ModeOptions& options, const Springs& springs) {
  const FreeDofs free(supports, body.node_count());
  if (options.count >= free.count())
    throw std::invalid_argument(
        fmt::format("modes: count is {}, expected less than the {} free degrees of freedom", options.count,
                    free.count()));
  const MassMatrix mass(body, options.mass);
  OrthonormalShapes known(mass);
  const std::vector<const Material*> laws = body.materials();
  const bool turns =
      std::none_of(laws.begin(), laws.end(), [](const Material* law) { return law->is_small_strain(); });
  const NodalVectors positions = turns ? body.reference() + u : body.reference();
  for (NodalVectors& motion : free_rigid_motions(positions, supports, springs)) known.add(std::move(motion));
  std::vector<Mode> modes;
  for (const NodalVectors& shape : known.all()) modes.push_back({0.0, shape});
  const double shift = modes.empty() ? 0.0
                                     : std::min(shift_of_free_body(Tangent(body, supports, u), known),
                                                least_on_springs(positions, supports, springs, known));
  const Tangent tangent(body, supports, u, shift, springs, &mass);
  InverseProduct inverse(tangent, free, known, options);
  MassProduct mass_product(mass, free, body.node_count());
  const auto is_lower = [](const Mode& a, const Mode& b) { return a.eigenvalue < b.eigenvalue; };
  for (int wanted = options.count - static_cast<int>(modes.size()); wanted > 0 && inverse.dimension() > 0;
       wanted = 1) {
    const std::vector<Mode> found = further_modes(inverse, mass_product, wanted, shift, options.tolerance);
    const bool is_all =
        static_cast<int>(modes.size()) >= options.count && !is_lower(found.front(), modes[options.count - 1]);
    if (is_all) break;
    for (const Mode& mode : found) known.add(mode.shape);
    modes.insert(modes.end(), found.begin(), found.end());
    std::stable_sort(modes.begin(), modes.end(), is_lower);
  }
  modes.resize(std::min<std::size_t>(modes.size(), options.count));
  return modes;
}

}  // namespace structure
