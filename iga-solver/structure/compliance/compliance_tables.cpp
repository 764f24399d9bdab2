// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/compliance_tables.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace structure {

namespace {

/// Changes the values inside as smoothly as `change` asks for on the sides: bilinear between them (Coons,
/// 1967).
void blend(const std::array<int, 2>& counts, const std::vector<Matrix3>& change,
           std::vector<Matrix3>& values) {
  const std::vector<double> s = lobatto_points(counts[0]), t = lobatto_points(counts[1]);
  const int right = counts[0] - 1, top = counts[1] - 1;
  const auto at = [&](int i, int j) -> const Matrix3& { return change[i + counts[0] * j]; };
  for (int j = 1; j < top; ++j)
    for (int i = 1; i < right; ++i) {
      const double x1 = 0.5 * (1.0 + s[i]), x0 = 1.0 - x1, y1 = 0.5 * (1.0 + t[j]), y0 = 1.0 - y1;
      values[i + counts[0] * j] += x0 * at(0, j) + x1 * at(right, j) + y0 * at(i, 0) + y1 * at(i, top) -
                                   x0 * y0 * at(0, 0) - x1 * y0 * at(right, 0) - x0 * y1 * at(0, top) -
                                   x1 * y1 * at(right, top);
    }
}

/// With the normal, as contacts over an edge are.
Matrix3 turned(const Matrix3& tensor, const Vector3& from, const Vector3& to) {
  if (from == to) return tensor;
  const Vector3 axis = from.cross(to);
  const Matrix3 turn =
      Eigen::AngleAxisd(std::atan2(axis.norm(), from.dot(to)), axis.normalized()).toRotationMatrix();
  return turn * tensor * turn.transpose();
}

/// Where the `part`th of two begins, or the only one.
int offset_of(int part, const std::vector<Matrix3>& tensors) {
  return part * static_cast<int>(tensors.size() / 2);
}

constexpr int kMostFunctions = 4 * 4 * 4;  // of degree 3

/// How long an element is along each of its directions, by its control points [length].
Vector3 lengths(const nurbs::Volume& patch, int element) {
  const nurbs::Space<3>& space = patch.space;
  std::array<int, kMostFunctions> points;
  space.element_control_points(element, points.data());
  Vector3 sums = Vector3::Zero();
  int stride = 1;
  for (int d = 0; d < 3; ++d) {
    const int count = space.degree(d) + 1;
    for (int a = 0; a < space.functions_per_element(); ++a)
      if (a / stride % count == 0)
        sums[d] +=
            (patch.control_points.col(points[a + (count - 1) * stride]) - patch.control_points.col(points[a]))
                .norm();
    stride *= count;
  }
  return sums;
}

/// So much that c may have changed by kChange of itself: it is as one over the size of elements along the
/// surface, and less than that across.
bool differ(const nurbs::Volume& a, const nurbs::Volume& b, int element) {
  constexpr double kChange = 0.05;
  const Vector3 ratio = lengths(a, element).cwiseQuotient(lengths(b, element));
  return !((ratio.array() < 1.0 + kChange).all() && (ratio.array() > 1.0 / (1.0 + kChange)).all());
}

ReferenceBody at_places(const ReferenceBody& body, const NodalVectors& places) {
  ReferenceBody moved = body;
  for (std::size_t p = 0; p < moved.patches.size(); ++p)
    for (Eigen::Index a = 0; a < moved.patches[p].control_points.cols(); ++a)
      moved.patches[p].control_points.col(a) =
          places.col(body.nodes.node(static_cast<int>(p), static_cast<int>(a)));
  return moved;
}

NodalVectors places_of(const ReferenceBody& body) {
  NodalVectors places(3, body.nodes.node_count());
  for (Id node = 0; node < body.nodes.node_count(); ++node) places.col(node) = body.place(node);
  return places;
}

}  // namespace

ComplianceTables::ComplianceTables(ReferenceBody body, std::vector<SkinPiece> skin, bool beside_links)
    : skin_(std::move(skin)),
      undeformed_(std::make_shared<ElementCompliances>(std::move(body), skin_)),
      borders_(*undeformed_) {
  if (beside_links) links_ = std::make_unique<CrossCompliance>(undeformed_->body(), skin_);
  for (std::size_t piece = 0; piece < skin_.size(); ++piece) {
    const int count = undeformed_->surface(static_cast<int>(piece)).space().element_count();
    state_of_.emplace_back(count, undeformed_);
    tables_.known.emplace_back(count, nullptr);
    spread_tables_.known.emplace_back(count, nullptr);
  }
  tables_.known_plain = tables_.known;
  spread_tables_.known_plain = spread_tables_.known;
}

/// Of one that shares a point with an element, in the directions of that one's state of the body.
Matrix3 ComplianceTables::tensor(const TablePoint& point, const Tensors& tensors, int index,
                                 const ElementCompliances& state) const {
  const ElementCompliances& own = *state_of_[point.piece][point.element];
  const Matrix3& tensor = tensors[index];
  if (&own == &state) return tensor;
  const nurbs::Parameter<2> xi = table_points(own.surface(point.piece).space(), point.element)[point.index];
  const auto frame_in = [&](const ElementCompliances& some) {
    return some.hit(point.piece, point.element).frame(xi);
  };
  const Matrix3 turn = frame_in(state) * frame_in(own).transpose();
  return turn * tensor * turn.transpose();
}

/// Of the first of the elements that are alike where links are, too, to the last bit; and whose it is.
std::pair<std::vector<double>, int> ComplianceTables::taken_off(int piece, int element, int alike) {
  if (!links_) return {{}, alike};
  constexpr double kSame = 1e-9;
  std::vector<double>& first = linked_[{piece, alike}];
  if (first.empty()) first = linked(piece, alike);
  if (element == alike) return {first, alike};
  std::vector<double> own = linked(piece, element);
  const bool same = std::equal(own.begin(), own.end(), first.begin(),
                               [](double a, double b) { return std::abs(a - b) <= kSame * std::abs(b); });
  return same ? std::pair{first, alike} : std::pair{std::move(own), element};
}

/// What links take at the points of an element.
std::vector<double> ComplianceTables::linked(int piece, int element) const {
  std::vector<SkinPoint> feet;
  const FaceSurface& surface = undeformed_->surface(piece);
  for (const nurbs::Parameter<2>& xi : table_points(surface.space(), element))
    feet.push_back(net().seams.carried(surface.at(element, xi)));
  return links_->taken_at(feet);
}

void ComplianceTables::expect_solved(const ElementCompliances::Solved& own, int piece, int element) const {
  if (own.problem.empty()) return;
  const Vector3 X = state_of_[piece][element]->surface(piece).at_centre(element);
  throw std::invalid_argument(
      fmt::format("no local compliance of the element about ({:.6g}, {:.6g}, {:.6g}): {}", X[0], X[1], X[2],
                  own.problem));
}

/// At its points, on borders the mean of all that have them: of `solved(state, piece, element)` of each,
/// `offset` from the first. To `origin` goes what they are made of.
template <class Solved>
ComplianceTables::Tensors ComplianceTables::means(int piece, int element, int offset, Solved solved,
                                                  Origin& origin) const {
  ElementCompliances& state = *state_of_[piece][element];
  const Tensors& own = solved(state, piece, element).tensors;
  Tensors means, change;
  for (const std::vector<TablePoint>& points : state.shared().of(piece, element)) {
    const TablePoint here{piece, element, static_cast<int>(means.size()), {}};
    const Vector3& normal = std::lower_bound(points.begin(), points.end(), here)->normal;
    Matrix3 sum = Matrix3::Zero();
    int count = 0;
    for (const TablePoint& point : points) {
      ElementCompliances& theirs = *state_of_[point.piece][point.element];
      const Tensors& tensors = solved(theirs, point.piece, point.element).tensors;
      if (&theirs != &state) theirs.rest();
      if (tensors.empty()) continue;
      const int index = offset_of(offset, tensors) + point.index;
      sum += turned(tensor(point, tensors, index, state), point.normal, normal);
      ++count;
      origin.emplace_back(&tensors, index);
    }
    origin.emplace_back(nullptr, 0);
    means.push_back(sum / count);
    change.push_back(means.back() - own[offset_of(offset, own) + here.index]);
  }
  blend(table_counts(state.surface(piece).space()), change, means);
  return means;
}

/// Null where none can be made.
const ComplianceTable* ComplianceTables::plain(int piece, int element) {
  const ComplianceTable*& known = tables_.known_plain[piece][element];
  if (known) return known;
  ElementCompliances& state = *state_of_[piece][element];
  const auto solved = [](ElementCompliances & of, int p, int e) -> auto& { return of.solved(p, e); };
  if (!solved(state, piece, element).problem.empty()) return nullptr;
  Origin origin;
  const Tensors tensors = means(piece, element, 0, solved, origin);
  const auto [taken, first] = taken_off(piece, element, state.first_alike(piece, element));
  origin.emplace_back(nullptr, first);
  std::unique_ptr<ComplianceTable>& made = tables_.plain[origin];
  if (!made) made = state.table(piece, element, tensors, taken);
  if (asked_ && asked_.get() != &state) asked_->rest();
  asked_ = state_of_[piece][element];
  return known = made.get();
}

const SpreadTable* ComplianceTables::plain_spread(int piece, int element) {
  const SpreadTable*& known = spread_tables_.known_plain[piece][element];
  if (known) return known;
  ElementCompliances& state = *state_of_[piece][element];
  const auto solved = [](ElementCompliances & of, int p, int e) -> auto& { return of.solved_spread(p, e); };
  if (!solved(state, piece, element).problem.empty()) return nullptr;
  Origin origin;
  Tensors tensors = means(piece, element, 0, solved, origin);
  const Tensors both = means(piece, element, 1, solved, origin);
  tensors.insert(tensors.end(), both.begin(), both.end());
  const int first = taken_off(piece, element, state.first_alike(piece, element)).second;
  origin.emplace_back(nullptr, first);
  std::unique_ptr<SpreadTable>& made = spread_tables_.plain[origin];
  if (!made) made = state.spread_table(piece, first, tensors, links_.get());
  return known = made.get();
}

/// The element's own, rounded on borders where it goes on as those beside it.
template <class Table, class Plain>
const Table& ComplianceTables::joined(Kind<Table>& tables, int piece, int element, Plain plain) {
  const SmoothBorders::Around around = borders_.around(piece, element);
  std::array<const Table*, 9> of{};
  for (int k = 0; k < 9; ++k)
    if (const SkinElement& one = around.elements[k / 3][k % 3]; one.piece >= 0)
      of[k] = plain(one.piece, one.element);
  const std::pair<int, int> alone = around.is_regular ? std::pair{-1, -1} : std::pair{piece, element};
  std::unique_ptr<Table>& made = tables.made[{of, alone}];
  if (!made) {
    const auto powers = [&](int p, int e) -> const double* {
      const Table* const table = plain(p, e);
      return table ? table->powers() : nullptr;
    };
    const typename Table::Strips strips(
        table_counts(undeformed_->surface(piece).space()),
        borders_.kinks(piece, element, {Table::kPolynomials, powers, Table::turn}));
    made = std::make_unique<Table>(*of[4], strips);
  }
  return *(tables.known[piece][element] = made.get());
}

const ComplianceTable& ComplianceTables::find(int piece, int element) {
  expect_solved(state_of_[piece][element]->solved(piece, element), piece, element);
  return joined(tables_, piece, element, [&](int p, int e) { return plain(p, e); });
}

const SpreadTable& ComplianceTables::find_spread(int piece, int element) {
  expect_solved(state_of_[piece][element]->solved_spread(piece, element), piece, element);
  return joined(spread_tables_, piece, element, [&](int p, int e) { return plain_spread(p, e); });
}

bool ComplianceTables::follows_strain() const {
  const ReferenceBody& body = undeformed_->body();
  return std::any_of(skin_.begin(), skin_.end(),
                     [&](const SkinPiece& piece) { return !body.materials[piece.patch]->is_small_strain(); });
}

/// Those of the skin that have a corner of this one.
template <class Function>
void ComplianceTables::for_each_neighbour(const SkinElement& of, Function f) const {
  const ReferenceBody& body = undeformed_->body();
  const BodyElement behind = element_behind(body, skin_[of.piece], of.element);
  for (const BodyElement& neighbour : undeformed_->near().neighbours(behind))
    for (std::size_t piece = 0; piece < skin_.size(); ++piece) {
      if (skin_[piece].patch != neighbour.patch) continue;
      const int element = element_on(body, skin_[piece], neighbour.element);
      if (element >= 0) f(static_cast<int>(piece), element);
    }
}

// Plain tables have points in common, so one that changes is new to its neighbours, and what is made of those
// to theirs.
bool ComplianceTables::follow(const NodalVectors& places, const std::vector<SkinElement>& touched) {
  const ReferenceBody& undeformed = undeformed_->body();
  std::vector<std::vector<bool>> stays;
  for (const auto& elements : state_of_) stays.emplace_back(elements.size(), false);
  for (const SkinElement& one : touched)
    for_each_neighbour(one, [&](int p, int e) {
      for_each_neighbour({p, e}, [&](int piece, int element) { stays[piece][element] = true; });
    });
  ReferenceBody now = at_places(undeformed, places);
  std::vector<SkinElement> changed;
  for (std::size_t piece = 0; piece < skin_.size(); ++piece)
    for (std::size_t element = 0; element < stays[piece].size(); ++element) {
      const int patch = skin_[piece].patch, e = static_cast<int>(element);
      const int volume = element_behind(undeformed, skin_[piece], e).element;
      if (!stays[piece][element] &&
          differ(now.patches[patch], state_of_[piece][element]->body().patches[patch], volume))
        changed.push_back({static_cast<int>(piece), e});
    }
  if (changed.empty()) return false;
  const auto state = std::make_shared<ElementCompliances>(std::move(now), skin_, undeformed_->net());
  for (const SkinElement& one : changed) {
    const int patch = skin_[one.piece].patch,
              volume = element_behind(undeformed, skin_[one.piece], one.element).element;
    const bool is_back = !differ(state->body().patches[patch], undeformed.patches[patch], volume);
    state_of_[one.piece][one.element] = is_back ? undeformed_ : state;
    for_each_neighbour(one, [&](int p, int e) {
      tables_.known_plain[p][e] = nullptr;
      spread_tables_.known_plain[p][e] = nullptr;
      for_each_neighbour({p, e}, [&](int piece, int element) {
        tables_.known[piece][element] = nullptr;
        spread_tables_.known[piece][element] = nullptr;
      });
    });
  }
  tables_.forget_unused();
  spread_tables_.forget_unused();
  return true;
}

namespace {

template <class Known, class Tables>
void erase_unknown(const Known& known, Tables& tables) {
  std::set<const void*> used;
  for (const auto& elements : known) used.insert(elements.begin(), elements.end());
  for (auto table = tables.begin(); table != tables.end();)
    table = used.count(table->second.get()) > 0 ? std::next(table) : tables.erase(table);
}

}  // namespace

template <class Table>
void ComplianceTables::Kind<Table>::forget_unused() {
  erase_unknown(known, made);
  erase_unknown(known_plain, plain);
}

template <class Table>
void ComplianceTables::Kind<Table>::forget_all() {
  for (Known* of : {&known, &known_plain})
    for (auto& elements : *of) std::fill(elements.begin(), elements.end(), nullptr);
  forget_unused();
}

std::vector<double> ComplianceTables::save() const {
  std::vector<const ElementCompliances*> states{undeformed_.get()};
  std::vector<double> indices, numbers;
  for (const auto& elements : state_of_)
    for (const auto& state : elements) {
      const auto known = std::find(states.begin(), states.end(), state.get());
      indices.push_back(static_cast<double>(known - states.begin()));
      if (known == states.end()) states.push_back(state.get());
    }
  if (states.size() == 1) return {};
  numbers.push_back(static_cast<double>(states.size() - 1));
  for (std::size_t k = 1; k < states.size(); ++k) {
    const NodalVectors places = places_of(states[k]->body());
    numbers.insert(numbers.end(), places.data(), places.data() + places.size());
  }
  numbers.insert(numbers.end(), indices.begin(), indices.end());
  return numbers;
}

void ComplianceTables::load(const std::vector<double>& numbers) {
  const ReferenceBody& undeformed = undeformed_->body();
  const std::size_t size = 3 * static_cast<std::size_t>(undeformed.nodes.node_count());
  std::size_t elements = 0;
  for (const auto& of_piece : state_of_) elements += of_piece.size();
  const double count = numbers.empty() ? 0.0 : numbers[0];
  const auto expected = [&] {
    return 1.0 + count * static_cast<double>(size) + static_cast<double>(elements);
  };
  if (!numbers.empty() && static_cast<double>(numbers.size()) != expected())
    throw std::invalid_argument(
        fmt::format("states of strain in {} numbers, expected {}", numbers.size(), expected()));
  std::vector<std::shared_ptr<ElementCompliances>> states{undeformed_};
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
    states.push_back(std::make_shared<ElementCompliances>(
        at_places(undeformed, Eigen::Map<const NodalVectors>(numbers.data() + 1 + k * size, 3,
                                                             static_cast<Eigen::Index>(size / 3))),
        skin_, undeformed_->net()));
  const double* index = numbers.data() + numbers.size() - elements;
  for (auto& of_piece : state_of_)
    for (auto& state : of_piece) {
      const double k = numbers.empty() ? 0.0 : *index++;
      if (!(k >= 0.0 && k < static_cast<double>(states.size())))
        throw std::invalid_argument(
            fmt::format("a state of strain with the number {}, expected 0 to {}", k, states.size() - 1));
      state = states[static_cast<std::size_t>(k)];
    }
  tables_.forget_all();
  spread_tables_.forget_all();
}

}  // namespace structure
