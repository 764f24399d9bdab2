// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/named_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "geometry_io/parse_number.h"

namespace geometry_io {
namespace {

constexpr const char* kAll = kAllPatches;

// The patches of triangles of that name.
std::vector<SurfacePiece> triangles_called(const std::string& name, const std::vector<Shape>& patches) {
  std::vector<SurfacePiece> pieces;
  for (int p = 0; p < static_cast<int>(patches.size()); ++p)
    if (is_triangles(patches[p]) && std::get<TriangleMesh>(patches[p]).name == name)
      pieces.push_back({p, std::nullopt});
  return pieces;
}

SurfacePiece parse_face(int patch, const std::string& word, const std::vector<Shape>& patches) {
  if (is_volume(patches[patch])) return {patch, nurbs::face_from_name(word)};
  throw std::invalid_argument(
      patches.size() == 1 ? fmt::format("unknown face '{}' of a surface patch, expected {}", word, kAll)
                          : fmt::format("face '{}' of patch {}, which is a surface: expected '{}' alone",
                                        word, patch, patch));
}

int parse_patch(const std::string& word, const std::vector<Shape>& patches) {
  int patch = 0;
  const int count = static_cast<int>(patches.size());
  if (!parse_number(word, patch) || patch < 0 || patch >= count)
    throw std::invalid_argument(
        fmt::format("patch is '{}', expected a number from 0 to {}", word, count - 1));
  return patch;
}

void append_all(const std::vector<Shape>& patches, std::vector<SurfacePiece>& pieces) {
  for (int p = 0; p < static_cast<int>(patches.size()); ++p) {
    if (is_volume(patches[p]))
      throw std::invalid_argument(
          patches.size() == 1
              ? fmt::format("'{}' of a volume, expected xi-, xi+, eta-, eta+, zeta- or zeta+", kAll)
              : fmt::format("'{}', but patch {} is a volume: expected a list of '{} FACE' and the like", kAll,
                            p, p));
    pieces.push_back({p, std::nullopt});
  }
}

// One word; `all` gives many pieces.
void parse_word(const std::string& word, const std::vector<Shape>& patches,
                std::vector<SurfacePiece>& pieces) {
  const size_t blank = word.find(' ');
  const std::vector<SurfacePiece> called = triangles_called(word, patches);
  if (word == kAll) {
    append_all(patches, pieces);
  } else if (!called.empty() && !word.empty() && word.find_first_not_of("0123456789") != std::string::npos) {
    pieces.insert(pieces.end(), called.begin(), called.end());
  } else if (blank != std::string::npos) {
    pieces.push_back(
        parse_face(parse_patch(word.substr(0, blank), patches), word.substr(blank + 1), patches));
  } else if (!word.empty() && word[0] >= '0' && word[0] <= '9') {
    const int patch = parse_patch(word, patches);
    if (is_volume(patches[patch]))
      throw std::invalid_argument(
          fmt::format("patch {} is a volume, expected '{} FACE' with xi-, xi+, eta-, eta+, zeta- or zeta+",
                      patch, patch));
    pieces.push_back({patch, std::nullopt});
  } else if (patches.size() == 1) {
    pieces.push_back(parse_face(0, word, patches));
  } else {
    throw std::invalid_argument(
        fmt::format("'{}', but there are {} patches: expected {}, PATCH (a surface) or 'PATCH FACE' (of a "
                    "volume)",
                    word, patches.size(), kAll));
  }
}

}  // namespace

std::vector<SurfacePiece> parse_surface(const std::vector<std::string>& words,
                                        const std::vector<Shape>& patches) {
  std::vector<SurfacePiece> pieces;
  for (const std::string& word : words) parse_word(word, patches, pieces);
  if (pieces.empty()) throw std::invalid_argument("the list is empty, expected one patch or face at least");
  for (size_t i = 0; i < pieces.size(); ++i)
    if (std::find(pieces.begin(), pieces.begin() + i, pieces[i]) != pieces.begin() + i)
      throw std::invalid_argument(fmt::format("patch {}{}{} is named twice, expected once", pieces[i].patch,
                                              pieces[i].face ? " " : "",
                                              pieces[i].face ? nurbs::face_name(*pieces[i].face) : ""));
  return pieces;
}

std::vector<std::string> surface_words(const std::vector<SurfacePiece>& pieces,
                                       const std::vector<Shape>& patches) {
  if (patches.size() == 1 && pieces.front().face && pieces.size() == 1)
    return {nurbs::face_name(*pieces.front().face)};
  bool all = pieces.size() == patches.size();
  for (size_t i = 0; all && i < pieces.size(); ++i)
    all = pieces[i] == SurfacePiece{static_cast<int>(i), std::nullopt};
  if (all) return {kAll};
  std::vector<std::string> words;
  for (const SurfacePiece& piece : pieces)
    words.push_back(piece.face ? fmt::format("{} {}", piece.patch, nurbs::face_name(*piece.face))
                               : fmt::format("{}", piece.patch));
  return words;
}

OrientedSurface extract(const SurfacePiece& piece, const std::vector<Shape>& patches) {
  if (!piece.face) return {std::get<nurbs::Surface>(patches[piece.patch]), 0};
  const nurbs::Volume& volume = std::get<nurbs::Volume>(patches[piece.patch]);
  nurbs::BoundarySurface face = nurbs::boundary_surface(volume.space, *piece.face);
  nurbs::NodalVectors control_points(3, face.space.control_point_count());
  for (int a = 0; a < face.space.control_point_count(); ++a)
    control_points.col(a) = volume.control_points.col(face.volume_control_point[a]);
  return {{std::move(face.space), std::move(control_points)}, face.outward_sign};
}

}  // namespace geometry_io
