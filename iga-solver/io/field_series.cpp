// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/field_series.h"

#include <algorithm>

#include "io/field_places.h"

namespace io {

FieldSeries::FieldSeries(const ModelFile& model)
    : fields_(model.volume(), model.material, model.integration.quadrature, model.geometry.units,
              model.output->fields->of) {
  for (const std::string& word : model.output->fields->on) {
    Place place{{}, vtk::Series(model.output->file + "_" + word, fields_.units())};
    if (word != kVolumePlace) place.faces = faces_of(word, model.geometry);
    places_.push_back(std::move(place));
  }
}

std::optional<double> FieldSeries::resume(double time) {
  std::optional<double> last;
  for (Place& place : places_) last = std::max(last, place.series.resume_at(time));
  return last;
}

void FieldSeries::write(const SolidState& state) {
  std::optional<std::vector<nurbs::Face>> faces = std::vector<nurbs::Face>();
  for (const Place& place : places_) {
    if (!place.faces)
      faces.reset();
    else if (faces)
      faces->insert(faces->end(), place.faces->begin(), place.faces->end());
  }
  const vtk::PatchFields<3> volume = fields_.at(state, faces);
  for (Place& place : places_) {
    const long number = place.series.count();
    if (!place.faces) {
      place.series.write<3>(number, state.time, {volume});
      continue;
    }
    std::vector<vtk::PatchFields<2>> patches;
    for (const nurbs::Face face : *place.faces) patches.push_back(vtk::on_face(volume, face));
    place.series.write<2>(number, state.time, patches);
  }
}

}  // namespace io
