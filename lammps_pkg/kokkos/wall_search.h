// SPDX-License-Identifier: GPL-2.0-only
#ifndef LMP_EEPA_WALL_SEARCH_H
#define LMP_EEPA_WALL_SEARCH_H

#include "wall_surface_kokkos.h"

#include <eepa_walls/matching.h>
#include <eepa_walls/touched_wall.h>

#include <algorithm>

namespace LAMMPS_NS {

// The loops of WallSurfaceKokkos. A surface is a plain object as PlanesSurface is; candidates are numbered for those that
// keep a list for each.

template <class Surface> struct WithoutLists : Surface {
  explicit WithoutLists(const Surface &surface) : Surface(surface) {}

  KOKKOS_INLINE_FUNCTION bool is_near(int /*i*/, const eepa::Vec3 &centre, double reach) const
  {
    return Surface::is_near(centre, reach);
  }
  template <class Found>
  KOKKOS_INLINE_FUNCTION void visit(int /*candidate*/, const eepa::Vec3 &centre, double radius,
                                    const Found &found) const
  {
    Surface::visit(centre, radius, found);
  }
};

/// Whether a particle that moves by more than its radius in a step has got through the surface.
template <class DeviceType, class Surface>
KOKKOS_INLINE_FUNCTION bool is_through(const WallStep<DeviceType> &s, const Surface &surface, int i)
{
  if (!s.request.advance || !s.is_member(i)) return false;
  const eepa::Vec3 x = s.centre_of(i), v(s.v(i, 0), s.v(i, 1), s.v(i, 2));
  const eepa::Vec3 path = s.path_of(x, v);
  const double radius = s.radius(i);
  if (!(eepa::dot<double>(path, path) > radius * radius)) return false;
  const eepa::Vec3 now = s.motion.to_shape(x);
  const eepa::Vec3 before = now - s.motion.direction_to_shape(path);
  return surface.is_between(before, now);
}

template <class DeviceType, class Surface> struct FindOneBehind {
  WallStep<DeviceType> s;
  Surface surface;

  KOKKOS_INLINE_FUNCTION void operator()(int i, int &one) const
  {
    if (is_through(s, surface, i)) one = eepa::max(one, i);
  }
};

/// Square of the longest way that a particle has gone since it was collected.
template <class DeviceType> struct LongestPath {
  typename ArrayTypes<DeviceType>::t_x_array now, before;

  KOKKOS_INLINE_FUNCTION void operator()(int i, double &longest) const
  {
    const double x = now(i, 0) - before(i, 0), y = now(i, 1) - before(i, 1),
                 z = now(i, 2) - before(i, 2);
    const double squared = x * x + y * y + z * z;
    // one that is not a number counts as far
    if (!(squared <= longest)) longest = squared <= 1e300 ? squared : 1e300;
  }
};

template <class DeviceType, class Surface> struct CollectCandidates {
  WallStep<DeviceType> s;
  Surface surface;
  PartnerLists<DeviceType> lists;
  Kokkos::View<int *, DeviceType> particle;

  KOKKOS_INLINE_FUNCTION void operator()(int i, int &sum, bool is_final) const
  {
    const eepa::Vec3 centre = s.motion.to_shape(s.centre_of(i));
    if (lists.count(i) == 0 && !surface.is_near(i, centre, s.radius(i) + s.margin)) return;
    if (is_final) particle(sum) = i;
    sum++;
  }
};

/// Finds the contacts of one candidate: what FixWallGranEepa::meet() does before it evaluates them.
template <class DeviceType, class Surface> struct FindTouches {
  using Vec3 = eepa::Vec3;
  using Point = eepa::SurfacePoint;

  WallStep<DeviceType> s;
  Surface surface;

  KOKKOS_INLINE_FUNCTION void operator()(int c) const
  {
    const int i = s.rows.particle(c);
    const bigint first = s.rows.first(c);
    const bool member = s.is_member(i);
    if (!member && !s.ledger) s.rows.count(c) = 0;
    s.parted(c) = 0;
    const int had = s.rows.count(c);
    const double radius = s.radius(i);
    const Vec3 centre = s.motion.to_shape(s.centre_of(i));
    // one that stays near to where it was collected makes no larger steps than its radius
    if (!(2.0 * s.margin <= radius) && is_through(s, surface, i)) {
      s.found(c) = s.stops + WallStop::behind;
      return;
    }
    int n = 0;
    if (member) {
      const int room = s.room(c);
      surface.visit(c, centre, radius, [&](const Point &point) {
        if (n < room) keep(point, s.touches(first + n));
        n++;
      });
      if (n > room) {
        s.found(c) = s.stops + WallStop::too_many;
        return;
      }
    }
    s.found(c) = n;
    s.kept(c) = 0;
    if (n == 0 && had == 0 && !s.books_setup) return;
    eepa::match_contacts(Lists{*this, c, first, n, had, centre});

    const eepa::Body<double> body = s.body_of(i);
    const Vec3 path = s.motion.direction_to_shape(s.path_of(body.x, body.v));
    for (int m = 0; m < had; m++) {
      if (s.kept(c) >> m & 1U) continue;
      // as FixWallGranEepa::got_through() and part()
      const bool through = s.request.advance &&
          eepa::dot<double>(path, s.rows.normal(first + m)) < -0.5 * s.rows.distance(first + m);
      if (member && through) {
        s.found(c) = s.stops + WallStop::behind;
        return;
      }
      if (s.ledger && (s.request.advance || !member))
        note_parted(c, surface.nearest(s.rows.face(first + m), centre), body, m);
    }
    if (member && s.books_setup) note_parted_after_setup(c, n, had, body, centre);
    for (int k = 0; k < n; k++) {
      WallTouch &touch = s.touches(first + k);
      touch.wall = wall_of(point_of(touch), body);
    }
  }

 private:
  /// Contacts and histories of a candidate, for match_contacts().
  struct Lists {
    const FindTouches &of;
    int c;
    bigint first;
    int n, had;
    const Vec3 &centre;

    KOKKOS_INLINE_FUNCTION int found() const { return n; }
    KOKKOS_INLINE_FUNCTION int histories() const { return had; }
    KOKKOS_INLINE_FUNCTION bool is_taken(int k) const { return touch(k).history >= 0; }
    KOKKOS_INLINE_FUNCTION bool is_matched(int m) const { return of.s.kept(c) >> m & 1U; }
    KOKKOS_INLINE_FUNCTION double alike(int k, int m) const
    {
      return eepa::alikeness(of.s.rows.normal(first + m), touch(k).normal);
    }
    KOKKOS_INLINE_FUNCTION bool belong(int k, int m, bool same_face) const
    {
      const int face = of.s.rows.face(first + m);
      return same_face ? face == touch(k).face
                       : of.surface.continues(face, of.point_of(touch(k)), centre);
    }
    KOKKOS_INLINE_FUNCTION void match(int k, int m) const
    {
      touch(k).history = m;
      of.s.kept(c) |= 1U << m;
    }
    KOKKOS_INLINE_FUNCTION WallTouch &touch(int k) const { return of.s.touches(first + k); }
  };

  KOKKOS_INLINE_FUNCTION void keep(const Point &point, WallTouch &touch) const
  {
    touch.face = point.face;
    touch.history = -1;
    touch.normal = point.normal;
    touch.distance = point.distance;
    // until the motion of the wall is known
    touch.wall.overlap = point.curvature;
    touch.wall.normal = point.straight;
  }
  KOKKOS_INLINE_FUNCTION Point point_of(const WallTouch &touch) const
  {
    Point point;
    point.face = touch.face;
    point.normal = touch.normal;
    point.distance = touch.distance;
    point.curvature = touch.wall.overlap;
    point.straight = touch.wall.normal;
    return point;
  }
  KOKKOS_INLINE_FUNCTION eepa::WallPoint<double> wall_of(const Point &point,
                                                         const eepa::Body<double> &body) const
  {
    const Vec3 relative = body.v - s.motion.velocity_at(body.x);
    const Vec3 rate = eepa::normal_rate(point, s.motion.direction_to_shape(relative));
    return eepa::touched_wall(point, body, s.motion, rate, s.surface_speed, s.request.time_step);
  }
  /// Leaves a contact that has opened to the law, which knows its loss.
  KOKKOS_INLINE_FUNCTION void note_parted(int c, const Point &point, const eepa::Body<double> &body,
                                          int history) const
  {
    if (s.parted(c) >= 2 * s.room(c)) return;    // as many as there can be
    WallTouch &touch = s.partings(2 * s.rows.first(c) + s.parted(c));
    keep(point, touch);
    touch.history = history;
    touch.wall = wall_of(point, body);
    s.parted(c)++;
  }
  /// As FixWallGranEepa::part_after_setup()
  KOKKOS_INLINE_FUNCTION void note_parted_after_setup(int c, int n, int had,
                                                      const eepa::Body<double> &body,
                                                      const Vec3 &centre) const
  {
    const bigint first = s.rows.first(c);
    const double step = s.path_of(body.x, body.v).norm();
    surface.visit(c, centre, body.radius + step, [&](const Point &point) {
      if (point.distance < body.radius) return;
      for (int k = 0; k < n; k++)
        if (s.touches(first + k).face == point.face) return;
      for (int m = 0; m < had; m++)
        if (s.rows.face(first + m) == point.face) return;
      note_parted(c, point, body, -1);
    });
  }
};

/// What is the same for all surfaces.
template <class DeviceType, class Surface>
class WallSurfaceOf : public WallSurfaceKokkos<DeviceType> {
 public:
  using Step = WallStep<DeviceType>;
  using Range = Kokkos::RangePolicy<DeviceType>;

  explicit WallSurfaceOf(const Surface &surface) : surface(surface) {}

  int one_behind(const Step &step, int particles) const override
  {
    int one = -1;
    Kokkos::parallel_reduce("eepa:find_behind_wall", Range(0, particles),
                            FindOneBehind<DeviceType, Surface>{step, surface},
                            Kokkos::Max<int>(one));
    return std::max(one, -1);    // of no particles it is the least integer
  }
  void find(const Step &step) const override
  {
    Kokkos::parallel_for("gran/eepa:find_wall", Range(0, step.rows.candidates),
                         FindTouches<DeviceType, Surface>{step, surface});
  }

 protected:
  Surface surface;

  void collect_particles(WallRows<DeviceType> &rows, const Step &step,
                         const PartnerLists<DeviceType> &lists, int particles) const
  {
    reserve(rows.particle, "eepa:wall:particle", particles);
    rows.candidates = 0;
    Kokkos::parallel_scan(
        "eepa:collect_candidates", Range(0, particles),
        CollectCandidates<DeviceType, Surface>{step, surface, lists, rows.particle},
        rows.candidates);
    reserve(rows.first, "eepa:wall:first", rows.candidates + 1);
    reserve(rows.count, "eepa:wall:count", rows.candidates);
  }
  static void reserve_slots(WallRows<DeviceType> &rows, bigint slots)
  {
    rows.slots = slots;
    reserve(rows.face, "eepa:wall:face", slots);
    reserve(rows.quads, "eepa:wall:quads", slots * rows.quads_of_slot);
  }
};

}    // namespace LAMMPS_NS

#endif
