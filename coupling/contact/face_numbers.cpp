// SPDX-License-Identifier: GPL-2.0-or-later
// What a face in closed form is to its kernel.
#include <cmath>

#include "brep/face.h"
#include "coupling/contact/face_kernel.h"

namespace contact {

FaceNumbers FaceNumbers::of(const brep::Face& face) {
  using brep::Kind;
  FaceNumbers of;
  double* const value = of.value;
  for (int d = 0; d < 3; ++d) {
    value[origin + d] = face.frame.origin[d];
    value[x + d] = face.frame.x[d], value[y + d] = face.frame.y[d], value[z + d] = face.frame.z[d];
  }
  value[cos] = face.kind == Kind::cone ? std::cos(face.r) : 1.0;
  value[sin] = face.kind == Kind::cone ? std::sin(face.r) : 0.0;
  value[radius] = face.kind == Kind::cylinder ? face.R : 0.0;
  value[ring] = face.kind == Kind::torus ? face.R : 0.0;
  value[tube] = face.kind == Kind::torus ? face.r : face.R;
  value[least] = brep::kOnAxis * face.R;
  value[least_of_cone] = face.kind == Kind::cone ? brep::kOnAxis : 0.0;
  for (int i = 0; i < 2; ++i) value[low + i] = face.low[i], value[high + i] = face.high[i];
  value[is_plane] = face.kind == Kind::plane ? 1.0 : 0.0;
  value[is_circle] = face.kind == Kind::sphere || face.kind == Kind::torus ? 1.0 : 0.0;
  return of;
}

}  // namespace contact
