// SPDX-License-Identifier: GPL-2.0-only
#include "mesh_transformation.h"

#include "text.h"

#include <cmath>
#include <stdexcept>

namespace eepa {

namespace {

  [[noreturn]] void refuse(const std::string &name, const std::string &value,
                           const std::string &allowed)
  {
    throw std::invalid_argument(name + " of a mesh = " + value + " is not allowed: it must be " +
                                allowed);
  }

  /// sin and cos of an angle in degrees, exact for multiples of 90.
  void sine_and_cosine(double degrees, double &sine, double &cosine)
  {
    int quarters = 0;
    const double rest = std::remquo(degrees, 90.0, &quarters);
    const double s = std::sin(rest * M_PI / 180.0), c = std::cos(rest * M_PI / 180.0);
    switch (quarters & 3) {
      case 0:
        sine = s, cosine = c;
        break;
      case 1:
        sine = c, cosine = -s;
        break;
      case 2:
        sine = -s, cosine = -c;
        break;
      default:
        sine = -c, cosine = s;
        break;
    }
  }

}    // namespace

PointTransformation::PointTransformation(const MeshTransformation &t) :
    scale_(t.scale), offset_(t.offset)
{
  if (!(std::isfinite(t.scale) && t.scale > 0.0)) refuse("scale", text_of(t.scale), "> 0");
  if (!std::isfinite(t.angle)) refuse("rotation angle", text_of(t.angle), "a finite number");
  if (!t.offset.allFinite()) refuse("offset", text_of(t.offset), "finite");
  const double length = t.axis.stableNorm();
  if (!(std::isfinite(length) && length > 0.0))
    refuse("rotation axis", text_of(t.axis), "finite and not zero");
  const Vec3 k = t.axis / length;
  double s = 0.0, c = 1.0;
  sine_and_cosine(t.angle, s, c);
  // Rodrigues' formula: c 1 + (1 - c) k k^T + s [k]
  rows_[0] = (1.0 - c) * k[0] * k + Vec3(c, -s * k[2], s * k[1]);
  rows_[1] = (1.0 - c) * k[1] * k + Vec3(s * k[2], c, -s * k[0]);
  rows_[2] = (1.0 - c) * k[2] * k + Vec3(-s * k[1], s * k[0], c);
}

Vec3 PointTransformation::rotate(const Vec3 &v) const
{
  return Vec3(dot(rows_[0], v), dot(rows_[1], v), dot(rows_[2], v));
}

Vec3 PointTransformation::operator()(const Vec3 &point) const
{
  return rotate(scale_ * point) + offset_;
}

}    // namespace eepa
