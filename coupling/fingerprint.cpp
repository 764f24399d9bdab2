// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/fingerprint.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace coupling {

namespace {

bool same_numbers(const std::vector<double>& a, const std::vector<double>& b) {
  const auto same = [](double x, double y) {
    return std::abs(x - y) <= kFingerprintTolerance * std::max(std::abs(x), std::abs(y));
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

const FingerprintPart* find(const Fingerprint& fingerprint, const std::string& name) {
  const auto found = std::find_if(fingerprint.begin(), fingerprint.end(),
                                  [&](const FingerprintPart& part) { return part.name == name; });
  return found == fingerprint.end() ? nullptr : &*found;
}

void add_sentence(std::string& sentences, const std::string& sentence) {
  sentences += (sentences.empty() ? "" : "; ") + sentence;
}

std::string text_of(const nurbs::Vector3& x) {
  std::ostringstream text;
  text << '[' << x[0] << ", " << x[1] << ", " << x[2] << ']';
  return text.str();
}

template <int Dim>
std::string text_of(const nurbs::Space<Dim>& patch) {
  std::ostringstream text;
  for (int d = 0; d < Dim; ++d) text << (d ? " x " : "") << patch.knots(d).element_count();
  text << " elements of degree";
  for (int d = 0; d < Dim; ++d) text << ' ' << patch.degree(d);
  return text.str();
}

void append(std::vector<double>& numbers, const std::string& text) {
  numbers.push_back(static_cast<double>(text.size()));
  for (const char c : text) numbers.push_back(static_cast<unsigned char>(c));
}

/// Takes what `append` put there, one after the other.
class NumberReader {
 public:
  explicit NumberReader(const std::vector<double>& numbers) : numbers_(numbers) {}

  bool at_end() const { return next_ == numbers_.size(); }
  std::vector<double> numbers() {
    if (at_end()) fail_as_damaged();
    const double size = numbers_[next_++];
    const std::size_t count = saved_size(size, numbers_.size() - next_);
    const auto first = numbers_.begin() + next_;
    next_ += count;
    return {first, first + count};
  }
  std::string text() {
    std::string text;
    for (const double c : numbers()) text += static_cast<char>(saved_size(c, 255));
    return text;
  }

 private:
  const std::vector<double>& numbers_;
  std::size_t next_ = 0;
};

}  // namespace

double checksum_term(std::size_t i, double x) {
  constexpr double kGoldenRatio = 0.61803398874989485;  // its multiples modulo 1 are all different
  const double place = kGoldenRatio * static_cast<double>(i);
  const double c = 0.5 + 0.5 * (place - std::floor(place));
  return 2.0 * std::abs(x) + c * x;
}

double checksum(const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += checksum_term(i, values[i]);
  return sum;
}

ControlPointDigest digest(const nurbs::NodalVectors& control_points) {
  ControlPointDigest digest{static_cast<std::size_t>(control_points.size()), 0.0,
                            control_points.rowwise().minCoeff(), control_points.rowwise().maxCoeff()};
  for (std::size_t i = 0; i < digest.numbers; ++i)
    digest.checksum += checksum_term(i, control_points.data()[i]);
  return digest;
}

template <int Dim>
FingerprintPart geometry_part(const std::vector<nurbs::Space<Dim>>& patches,
                              const ControlPointDigest& control_points) {
  std::vector<double> knots, numbers{Dim, static_cast<double>(patches.size())};
  std::size_t weight_count = 0;
  double weights = 0.0;
  int elements = 0;
  for (const nurbs::Space<Dim>& patch : patches) {
    elements += patch.element_count();
    for (const nurbs::KnotVector& direction : patch.knots()) {
      knots.insert(knots.end(), direction.knots().begin(), direction.knots().end());
      numbers.push_back(direction.degree());
      numbers.push_back(direction.element_count());
    }
    for (int A = 0; A < patch.control_point_count(); ++A)
      weights += checksum_term(weight_count++, patch.weight(A));
  }
  numbers.insert(numbers.end(), {static_cast<double>(control_points.numbers), control_points.checksum,
                                 checksum(knots), weights});

  std::ostringstream text;
  if (patches.size() == 1)
    text << text_of(patches.front());
  else
    text << patches.size() << " patches of " << elements << " elements";
  text << " from " << text_of(control_points.lower) << " to " << text_of(control_points.upper);
  return {"geometry", text.str(), std::move(numbers)};
}

template FingerprintPart geometry_part(const std::vector<nurbs::Space<2>>&, const ControlPointDigest&);
template FingerprintPart geometry_part(const std::vector<nurbs::Space<3>>&, const ControlPointDigest&);

FingerprintPart geometry_part(const brep::Surface& faces) {
  std::vector<double> shapes, corners;
  for (const brep::Face& face : faces.faces) {
    for (const nurbs::Vector3& x : {face.frame.origin, face.frame.x, face.frame.z})
      shapes.insert(shapes.end(), x.data(), x.data() + 3);
    shapes.insert(shapes.end(), {static_cast<double>(face.kind), face.R, face.r, face.low[0], face.low[1],
                                 face.high[0], face.high[1]});
  }
  for (const brep::Vertex& vertex : faces.vertices)
    if (faces.trimmed()) corners.insert(corners.end(), vertex.point.data(), vertex.point.data() + 3);
  for (const brep::Piece& piece : faces.pieces)
    for (const int vertex : piece.vertex)
      if (vertex >= 0)
        corners.insert(corners.end(), faces.vertices[vertex].point.data(),
                       faces.vertices[vertex].point.data() + 3);
  std::ostringstream text;
  text << faces.faces.size() << " faces from " << text_of(faces.low) << " to " << text_of(faces.high);
  return {"geometry",
          text.str(),
          {static_cast<double>(faces.faces.size()), static_cast<double>(faces.pieces.size()),
           checksum(shapes), checksum(corners)}};
}

FingerprintPart word_part(const std::string& name, const std::string& word) {
  return {name, word, {word.begin(), word.end()}};
}

std::string difference(const Fingerprint& then, const Fingerprint& now) {
  std::string differs;
  for (const FingerprintPart& part : then) {
    const FingerprintPart* const other = find(now, part.name);
    if (!other)
      add_sentence(differs, part.name + ": " + part.text + " then, none now");
    else if (!same_numbers(part.numbers, other->numbers))
      add_sentence(differs, part.name + ": " + part.text + " then, " +
                                (part.text == other->text ? "of other numbers" : other->text) + " now");
  }
  for (const FingerprintPart& part : now)
    if (!find(then, part.name)) add_sentence(differs, part.name + ": none then, " + part.text + " now");
  return differs;
}

std::vector<double> to_numbers(const Fingerprint& fingerprint) {
  std::vector<double> numbers;
  for (const FingerprintPart& part : fingerprint) {
    append(numbers, part.name);
    append(numbers, part.text);
    numbers.push_back(static_cast<double>(part.numbers.size()));
    numbers.insert(numbers.end(), part.numbers.begin(), part.numbers.end());
  }
  return numbers;
}

Fingerprint fingerprint_from(const std::vector<double>& numbers) {
  Fingerprint fingerprint;
  for (NumberReader reader(numbers); !reader.at_end();) {
    FingerprintPart part;
    part.name = reader.text();
    part.text = reader.text();
    part.numbers = reader.numbers();
    fingerprint.push_back(std::move(part));
  }
  return fingerprint;
}

void fail_as_damaged() {
  throw std::invalid_argument(
      "the wall's state in the restart file is damaged; use another restart file, or give the fix another "
      "ID, which starts the wall anew");
}

std::size_t saved_size(double number, std::size_t most) {
  if (!(number >= 0.0 && number <= static_cast<double>(most)) || number != std::floor(number))
    fail_as_damaged();
  return static_cast<std::size_t>(number);
}

}  // namespace coupling
