// SPDX-License-Identifier: GPL-2.0-only
#include "triangle_mesh.h"

#include "text.h"
#include "vertex_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace eepa {

namespace {

  /// Corners nearer than this times the diagonal of the bounding box are the same: what single precision,
  /// in which binary files are written, leaves of a place.
  constexpr double relative_tolerance = 1e-7;
  /// Beyond these, squares of areas would leave the range of a double.
  constexpr double largest_coordinate = 1e30, least_diagonal = 1e-30;

  [[noreturn]] void refuse(const std::string &file, const std::string &message)
  {
    throw std::invalid_argument(file + ": " + message);
  }

  Vec3 point_of(const double *x)
  {
    return Vec3(x[0], x[1], x[2]);
  }

  /// Something of a triangle, found by the lowest of its vertices: sorting what a vertex has is cheaper
  /// than sorting all.
  struct Entry {
    int second, third;    ///< other vertices, or one and -1
    int place;
    bool same(const Entry &other) const { return second == other.second && third == other.third; }
    bool operator<(const Entry &other) const
    {
      if (second != other.second) return second < other.second;
      return third != other.third ? third < other.third : place < other.place;
    }
  };

  class ByLowestVertex {
   public:
    /// \param lowest  of each thing that will be put in
    ByLowestVertex(int vertices, const std::vector<int> &lowest) :
        begin_(vertices + 2), entries_(lowest.size())
    {
      for (const int v : lowest) ++begin_[v + 2];
      std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    }
    void put(int lowest, const Entry &entry) { entries_[begin_[lowest + 1]++] = entry; }

    /// Calls group(first, last) for the entries of each group that has the same vertices, in the order of
    /// places.
    template <class Function> void for_each_group(const Function &group)
    {
      for (std::size_t v = 0; v + 2 < begin_.size(); ++v) {
        Entry *entry = entries_.data() + begin_[v];
        Entry *const end = entries_.data() + begin_[v + 1];
        std::sort(entry, end);
        while (entry != end) {
          Entry *last = entry + 1;
          while (last != end && last->same(*entry)) ++last;
          group(entry, last);
          entry = last;
        }
      }
    }

   private:
    std::vector<int> begin_;
    std::vector<Entry> entries_;
  };

}    // namespace

TriangleMesh::TriangleMesh(const StlTriangles &stl, const MeshTransformation &transformation)
{
  const PointTransformation transform(transformation);
  weld(stl, transform);
  drop_degenerate(stl.name);
  drop_duplicates();
  drop_unused_vertices();
  measure();
  find_edges();
  check_orientations();
  check_stored_normals(stl, transform);
}

void TriangleMesh::note(MeshDefect kind, int triangle)
{
  auto found = std::find_if(findings.begin(), findings.end(), [kind](const MeshFinding &finding) {
    return finding.kind == kind;
  });
  if (found == findings.end()) {
    findings.push_back({kind, 0, {}});
    found = findings.end() - 1;
  }
  ++found->count;
  const int number = file_number[triangle];
  if (found->triangles.size() < named_triangles &&
      (found->triangles.empty() || found->triangles.back() != number))
    found->triangles.push_back(number);
}

void TriangleMesh::weld(const StlTriangles &stl, const PointTransformation &transform)
{
  const int n = stl.count();
  if (n == 0) refuse(stl.name, "holds no triangles");
  std::vector<Vec3> points(3 * static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = transform(point_of(&stl.corners[3 * i]));
    if (!(points[i].cwiseAbs().maxCoeff() <= largest_coordinate))
      refuse(stl.name,
             "triangle " + std::to_string(i / 3 + 1) + " has a corner at " + text_of(points[i]) +
                 ": coordinates must be between -" + text_of(largest_coordinate) + " and " +
                 text_of(largest_coordinate));
  }
  low = high = points[0];
  for (const Vec3 &point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double diagonal = (high - low).norm();
  if (diagonal > 0.0 && !(diagonal >= least_diagonal))
    refuse(stl.name,
           "its bounding box has a diagonal of " + text_of(diagonal) + ": it must be at least " +
               text_of(least_diagonal));
  tolerance = relative_tolerance * diagonal;

  facets.resize(n);
  file_number.resize(n);
  std::iota(file_number.begin(), file_number.end(), 1);
  if (!(diagonal > 0.0)) return;    // all triangles are a point, and will be dropped
  VertexGrid grid(low, tolerance, n, vertices);
  for (std::size_t i = 0; i < points.size(); ++i)
    facets[i / 3].corners[i % 3] = grid.number_of(points[i]);
}

void TriangleMesh::keep(const std::vector<char> &wanted, MeshDefect why)
{
  int kept = 0;
  for (int t = 0; t < count(); ++t) {
    if (!wanted[t]) {
      note(why, t);
      continue;
    }
    facets[kept].corners = facets[t].corners;
    file_number[kept] = file_number[t];
    ++kept;
  }
  facets.resize(kept);
  file_number.resize(kept);
}

void TriangleMesh::drop_degenerate(const std::string &name)
{
  std::vector<char> wanted(count(), 0);
  for (int t = 0; t < count(); ++t) {
    const Three &c = facets[t].corners;
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    const Vec3 &p = vertices[c[0]], &q = vertices[c[1]], &r = vertices[c[2]];
    const double longest =
        std::sqrt(std::max({squared_length(q - p), squared_length(r - q), squared_length(p - r)}));
    // the height over the longest edge
    wanted[t] = area_vector(p, q, r).norm() > tolerance * longest;
  }
  const int all = count();
  keep(wanted, MeshDefect::degenerate);
  if (facets.empty())
    refuse(name,
           all == 1 ? "its only triangle has no area"
                    : "none of its " + std::to_string(all) + " triangles has an area");
}

void TriangleMesh::drop_duplicates()
{
  std::vector<int> lowest(count());
  for (int t = 0; t < count(); ++t)
    lowest[t] = *std::min_element(facets[t].corners.begin(), facets[t].corners.end());
  ByLowestVertex sorted(static_cast<int>(vertices.size()), lowest);
  for (int t = 0; t < count(); ++t) {
    Three c = facets[t].corners;
    std::sort(c.begin(), c.end());
    sorted.put(c[0], {c[1], c[2], t});
  }
  std::vector<char> wanted(count(), 1);
  sorted.for_each_group([&](const Entry *first, const Entry *last) {
    for (const Entry *entry = first + 1; entry != last; ++entry) wanted[entry->place] = 0;
  });
  keep(wanted, MeshDefect::duplicate);
}

void TriangleMesh::drop_unused_vertices()
{
  std::vector<int> number(vertices.size(), -1);
  for (const Facet &facet : facets)
    for (const int v : facet.corners) number[v] = 0;
  int kept = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (number[v] < 0) continue;
    vertices[kept] = vertices[v];
    number[v] = kept++;
  }
  vertices.resize(kept);
  vertices.shrink_to_fit();
  for (Facet &facet : facets)
    for (int &v : facet.corners) v = number[v];
  low = high = vertices[0];
  for (const Vec3 &vertex : vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
}

void TriangleMesh::measure()
{
  areas.resize(facets.size());
  for (int t = 0; t < count(); ++t) {
    const Three &c = facets[t].corners;
    const Vec3 area = area_vector(vertices[c[0]], vertices[c[1]], vertices[c[2]]);
    const double length = std::sqrt(squared_length(area));
    areas[t] = 0.5 * length;
    // divided, not multiplied by a reciprocal: exactly 1 along an axis
    facets[t].triangle = {{vertices[c[0]], vertices[c[1]], vertices[c[2]]},
                          Vec3(area[0] / length, area[1] / length, area[2] / length)};
  }
}

void TriangleMesh::find_edges()
{
  std::vector<int> lowest(3 * facets.size());
  for (std::size_t i = 0; i < lowest.size(); ++i) {
    const Three &c = facets[i / 3].corners;
    lowest[i] = std::min(c[i % 3], c[(i + 1) % 3]);
  }
  ByLowestVertex sorted(static_cast<int>(vertices.size()), lowest);
  for (std::size_t i = 0; i < lowest.size(); ++i) {
    const Three &c = facets[i / 3].corners;
    sorted.put(lowest[i], {std::max(c[i % 3], c[(i + 1) % 3]), -1, static_cast<int>(i)});
  }
  edges.reserve(3 * facets.size() / 2 + 1);
  sorted.for_each_group([&](const Entry *first, const Entry *last) {
    const int number = static_cast<int>(edges.size());
    for (const Entry *entry = first; entry != last; ++entry)
      facets[entry->place / 3].edges[entry->place % 3] = number;
    Edge edge;
    edge.first = first->place / 3;
    edge.count = static_cast<int>(last - first);
    if (edge.count == 1) {
      note(MeshDefect::open_edge, edge.first);
    } else if (edge.count > 2) {
      note(MeshDefect::branching_edge, edge.first);
    } else {
      const int other = first[1].place;
      edge.second = other / 3;
      measure_edge(edge,
                   facets[edge.first].corners[first->place % 3] ==
                       facets[edge.second].corners[other % 3]);
    }
    edges.push_back(edge);
  });
}

void TriangleMesh::measure_edge(Edge &edge, bool same_direction)
{
  const Vec3 &n = normal(edge.first);
  const Vec3 m = same_direction ? Vec3(-normal(edge.second)) : normal(edge.second);
  edge.angle = static_cast<float>(std::atan2(cross(n, m).norm(), dot(n, m)));
  const int number = static_cast<int>(edges.size());
  double rounding = 0.0;
  for (const int t : {edge.first, edge.second}) {
    int k = 0;
    while (facets[t].edges[k] != number) ++k;
    const double length =
        (vertices[facets[t].corners[k]] - vertices[facets[t].corners[(k + 1) % 3]]).norm();
    rounding += tolerance * length / (2.0 * areas[t]);
  }
  edge.rounding = static_cast<float>(std::min(rounding, M_PI));
}

/// Triangles that are the other way round than most of those with which they hang together.
void TriangleMesh::check_orientations()
{
  enum : char { unknown, one_way, other_way };
  std::vector<char> ways(facets.size(), unknown);
  std::vector<int> part;    // triangles that hang together
  for (int start = 0; start < count(); ++start) {
    if (ways[start] != unknown) continue;
    part.assign(1, start);
    ways[start] = one_way;
    std::size_t others = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const int t = part[i];
      others += ways[t] == other_way;
      for (int k = 0; k < 3; ++k) {
        const int number = facets[t].edges[k];
        const Edge &edge = edges[number];
        if (edge.count != 2) continue;
        const int neighbour = edge.first == t ? edge.second : edge.first;
        if (ways[neighbour] != unknown) continue;
        int m = 0;
        while (facets[neighbour].edges[m] != number) ++m;
        // neighbours that are the same way round pass their edge in opposite directions
        const bool same = facets[t].corners[k] != facets[neighbour].corners[m];
        ways[neighbour] = same == (ways[t] == one_way) ? one_way : other_way;
        part.push_back(neighbour);
      }
    }
    const char wrong = 2 * others <= part.size() ? other_way : one_way;
    for (const int t : part) ways[t] = ways[t] == wrong ? other_way : one_way;
  }
  for (int t = 0; t < count(); ++t)
    if (ways[t] == other_way) note(MeshDefect::opposite, t);
}

void TriangleMesh::check_stored_normals(const StlTriangles &stl,
                                        const PointTransformation &transform)
{
  for (int t = 0; t < count(); ++t) {
    const float *stored = &stl.normals[3 * static_cast<std::size_t>(file_number[t] - 1)];
    const Vec3 direction = transform.rotate(Vec3(stored[0], stored[1], stored[2]));
    if (dot(direction, normal(t)) < 0.0) note(MeshDefect::stored_normal, t);
  }
}

}    // namespace eepa
