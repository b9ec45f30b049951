// SPDX-License-Identifier: GPL-2.0-only

// The shape of a mesh on a device: its triangles, and for each particle that may touch it those that it may touch.

#include "wall_search.h"

#include <eepa_walls/mesh_shape.h>
#include <eepa_walls/triangle_grid.h>

using namespace LAMMPS_NS;
using eepa::SurfacePiece;
using eepa::SurfacePoint;
using eepa::Vec3;

namespace {

template <class DeviceType> struct MeshOnDevice {
  eepa::MeshView mesh;
  eepa::TriangleGridView grid;

  Kokkos::View<int *, DeviceType>
      near;    ///< of a particle, the number of triangles that it may touch
  Kokkos::View<bigint *, DeviceType> first;    ///< first piece of a candidate, and the end of all
  Kokkos::View<SurfacePiece *, DeviceType> pieces;    ///< of a candidate, the nearest first
  Kokkos::View<double *[3], Kokkos::LayoutRight, DeviceType>
      centres;    ///< of candidates when they were collected
  Kokkos::View<eepa::MeshTouch *, DeviceType> touches;    ///< of a force call, beside the pieces

  KOKKOS_INLINE_FUNCTION bool is_near(int i, const Vec3 &, double) const { return near(i) > 0; }
  KOKKOS_INLINE_FUNCTION SurfacePoint nearest(int face, const Vec3 &centre) const
  {
    const eepa::Triangle &triangle = mesh.triangle(face);
    return eepa::surface_point(triangle, face, eepa::closest_point(centre, triangle), centre);
  }
  KOKKOS_INLINE_FUNCTION bool continues(int face, const SurfacePoint &now, const Vec3 &centre) const
  {
    return eepa::continues(mesh, face, now, centre);
  }
  KOKKOS_INLINE_FUNCTION bool is_between(const Vec3 &before, const Vec3 &now) const
  {
    Vec3 low, high;
    for (int k = 0; k < 3; k++) {
      low[k] = eepa::min(before[k], now[k]) - mesh.rounding;
      high[k] = eepa::max(before[k], now[k]) + mesh.rounding;
    }
    bool found = false;
    grid.for_each_in(mesh, low, high, [&](int t) {
      found = found || eepa::crosses(before, now, mesh.triangle(t), mesh.rounding);
    });
    return found;
  }
  template <class Found>
  KOKKOS_INLINE_FUNCTION void visit(int c, const Vec3 &centre, double radius,
                                    const Found &found) const
  {
    const bigint begin = first(c), end = first(c + 1);
    const Vec3 path = centre - Vec3(centres(c, 0), centres(c, 1), centres(c, 2));
    const double moved = eepa::dot<double>(path, path) * (1.0 + 1e-12);
    int count = 0;
    for (bigint k = begin; k < end && eepa::may_touch(pieces(k), radius, moved); k++) {
      const int t = pieces(k).number;
      const eepa::TrianglePoint at = eepa::closest_point(centre, mesh.triangle(t));
      if (at.distance < radius) touches(begin + count++) = eepa::MeshTouch{at, t, 0, 0};
    }
    if (count == 0) return;
    eepa::MeshTouch *touched = &touches(begin);
    eepa::find_mesh_contacts(mesh, touched, count, centre);
    for (int last = -1;;) {    // by the number of the triangle
      int next = -1;
      for (int k = 0; k < count; k++)
        if (touched[k].group == k && touched[k].triangle > last &&
            (next < 0 || touched[k].triangle < touched[next].triangle))
          next = k;
      if (next < 0) return;
      last = touched[next].triangle;
      found(eepa::surface_point(mesh.triangle(last), last, touched[next].at, centre));
    }
  }
};

template <class DeviceType> struct CountPieces {
  WallStep<DeviceType> s;
  MeshOnDevice<DeviceType> surface;

  KOKKOS_INLINE_FUNCTION void operator()(int i) const
  {
    int count = 0;
    eepa::for_each_piece(surface.mesh, surface.grid, s.motion.to_shape(s.centre_of(i)),
                         s.radius(i) + s.margin, [&](const SurfacePiece &) {
                           count++;
                         });
    surface.near(i) = count;
  }
};

/// Gives each candidate its part of the pieces.
template <class DeviceType> struct PlacePieces {
  WallRows<DeviceType> rows;
  MeshOnDevice<DeviceType> surface;

  KOKKOS_INLINE_FUNCTION void operator()(int c, bigint &sum, bool is_final) const
  {
    if (is_final) surface.first(c) = sum;
    sum += surface.near(rows.particle(c));
    if (is_final) surface.first(c + 1) = sum;
  }
};

/// A slot for each contact that a candidate can have, and for those that it had.
template <class DeviceType> struct PlaceSlotsOfMesh {
  WallRows<DeviceType> rows;
  MeshOnDevice<DeviceType> surface;
  PartnerLists<DeviceType> lists;

  KOKKOS_INLINE_FUNCTION void operator()(int c, bigint &sum, bool is_final) const
  {
    constexpr int most = WallStep<DeviceType>::most_slots;
    const int i = rows.particle(c);
    if (is_final) {
      rows.first(c) = sum;
      rows.count(c) = 0;
    }
    sum += eepa::min(most, eepa::max(surface.near(i), lists.count(i)));
    if (is_final) rows.first(c + 1) = sum;
  }
};

template <class DeviceType> struct FillPieces {
  WallStep<DeviceType> s;
  WallRows<DeviceType> rows;
  MeshOnDevice<DeviceType> surface;

  KOKKOS_INLINE_FUNCTION void operator()(int c) const
  {
    const int i = rows.particle(c);
    const Vec3 centre = s.motion.to_shape(s.centre_of(i));
    for (int k = 0; k < 3; k++) surface.centres(c, k) = centre[k];
    const bigint begin = surface.first(c);
    bigint end = begin;
    eepa::for_each_piece(
        surface.mesh, surface.grid, centre, s.radius(i) + s.margin, [&](const SurfacePiece &piece) {
          bigint at = end++;
          for (; at > begin && eepa::is_nearer(piece, surface.pieces(at - 1)); at--)
            surface.pieces(at) = surface.pieces(at - 1);
          surface.pieces(at) = piece;
        });
  }
};

template <class DeviceType>
class WallMeshKokkos final : public WallSurfaceOf<DeviceType, MeshOnDevice<DeviceType>> {
  using Base = WallSurfaceOf<DeviceType, MeshOnDevice<DeviceType>>;
  using Base::surface;
  using typename Base::Range;
  using typename Base::Step;

 public:
  explicit WallMeshKokkos(const eepa::MeshShape &shape) : Base(MeshOnDevice<DeviceType>())
  {
    const eepa::TriangleGrid grid(shape.mesh());
    send_to_device(shape.mesh().facets, "eepa:mesh:facets", facets);
    send_to_device(shape.smooth_edges(), "eepa:mesh:smooth_edges", smooth_edges);
    send_to_device(grid.first(), "eepa:mesh:cells", cells);
    send_to_device(grid.triangles(), "eepa:mesh:triangles", triangles);
    surface.mesh = shape.view();
    surface.mesh.facets = facets.data();
    surface.mesh.smooth_edges = smooth_edges.data();
    surface.grid = grid.view(cells.data(), triangles.data());
  }

  int most_contacts() const override { return Step::most_slots; }

  void collect(WallRows<DeviceType> &rows, const Step &step, const PartnerLists<DeviceType> &lists,
               int particles) override
  {
    reserve(surface.near, "eepa:mesh:near", particles);
    Kokkos::parallel_for("eepa:count_triangles", Range(0, particles),
                         CountPieces<DeviceType>{step, surface});
    this->collect_particles(rows, step, lists, particles);
    const Range candidates(0, rows.candidates);
    reserve(surface.first, "eepa:mesh:first", rows.candidates + 1);
    reserve(surface.centres, "eepa:mesh:centres", rows.candidates);
    bigint pieces = 0, slots = 0;
    Kokkos::parallel_scan("eepa:place_triangles", candidates,
                          PlacePieces<DeviceType>{rows, surface}, pieces);
    Kokkos::parallel_scan("eepa:place_wall_slots", candidates,
                          PlaceSlotsOfMesh<DeviceType>{rows, surface, lists}, slots);
    reserve(surface.pieces, "eepa:mesh:pieces", pieces);
    reserve(surface.touches, "eepa:mesh:touches", pieces);
    this->reserve_slots(rows, slots);
    Kokkos::parallel_for("eepa:fill_triangles", candidates,
                         FillPieces<DeviceType>{step, rows, surface});
  }

 private:
  Kokkos::View<eepa::TriangleMesh::Facet *, DeviceType> facets;
  Kokkos::View<char *, DeviceType> smooth_edges;
  Kokkos::View<int *, DeviceType> cells, triangles;
};

}    // namespace

template <class DeviceType>
MadeSurface<DeviceType> LAMMPS_NS::make_wall_mesh(const eepa::MeshShape &shape)
{
  return std::make_unique<WallMeshKokkos<DeviceType>>(shape);
}

namespace LAMMPS_NS {
template MadeSurface<LMPDeviceType> make_wall_mesh<LMPDeviceType>(const eepa::MeshShape &);
#ifdef LMP_KOKKOS_GPU
template MadeSurface<LMPHostType> make_wall_mesh<LMPHostType>(const eepa::MeshShape &);
#endif
}    // namespace LAMMPS_NS
