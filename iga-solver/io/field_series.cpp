// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/field_series.h"

#include <algorithm>

#include "io/field_places.h"

namespace io {

FieldSeries::FieldSeries(const ModelFile& model) : nodes_(model.nodes) {
  for (int p = 0; p < model.patch_count(); ++p) {
    fields_.emplace_back(model.volume(p), model.materials[p], model.integration.quadrature,
                         model.geometry.units, model.output->fields->of);
    elements_.push_back(elements_.back() + model.volume(p).space.element_count());
  }
  for (const std::string& word : model.output->fields->on) {
    Place place{{}, vtk::Series(model.output->file + "_" + word, fields_.front().units())};
    if (word != kVolumePlace) place.faces = faces_of(word, model.geometry, nodes_);
    places_.push_back(std::move(place));
  }
}

std::optional<double> FieldSeries::resume(double time) {
  std::optional<double> last;
  for (Place& place : places_) last = std::max(last, place.series.resume_at(time));
  return last;
}

SolidState FieldSeries::of_patch(int patch, const SolidState& body) const {
  std::vector<Eigen::Index> columns(nodes_.control_point_count(patch));
  for (std::size_t a = 0; a < columns.size(); ++a) columns[a] = nodes_.node(patch, static_cast<int>(a));
  const std::size_t per_element = body.memory.size() / elements_.back();
  const auto memory = body.memory.begin();
  return {body.time,
          body.u(Eigen::all, columns),
          body.v(Eigen::all, columns),
          {memory + static_cast<long>(elements_[patch] * per_element),
           memory + static_cast<long>(elements_[patch + 1] * per_element)}};
}

void FieldSeries::write(const SolidState& state) {
  std::vector<vtk::PatchFields<3>> volumes;
  const bool whole = std::any_of(places_.begin(), places_.end(), [](const Place& p) { return !p.faces; });
  for (std::size_t p = 0; p < fields_.size(); ++p) {
    std::vector<nurbs::Face> faces;
    for (const Place& place : places_)
      for (const structure::SkinPiece& piece : place.faces.value_or(std::vector<structure::SkinPiece>()))
        if (piece.patch == static_cast<int>(p)) faces.push_back(piece.face);
    volumes.push_back(fields_[p].at(of_patch(static_cast<int>(p), state),
                                    whole ? std::optional<std::vector<nurbs::Face>>() : faces));
  }
  for (Place& place : places_) {
    const long number = place.series.count();
    if (!place.faces) {
      place.series.write(number, state.time, volumes);
      continue;
    }
    std::vector<vtk::PatchFields<2>> patches;
    for (const structure::SkinPiece& piece : *place.faces)
      patches.push_back(vtk::on_face(volumes[piece.patch], piece.face));
    place.series.write(number, state.time, patches);
  }
}

}  // namespace io
