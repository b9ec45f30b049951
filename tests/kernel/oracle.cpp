// SPDX-License-Identifier: GPL-2.0-only Replays the tables of tests/oracle (a second implementation
// of the law, in Python, from the contract alone) through the kernel, to 1e-12 relative.

#include "support.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

namespace oracle_test {
using namespace eepa_test;

const double tolerance = 1e-12;

std::string table_path(const std::string &name)
{
  const char *source = std::getenv("EEPA_SOURCE_DIR");
  const std::string here = __FILE__;
  const std::string tests = source ? std::string(source) + "/tests"
                                   : here.substr(0, here.find_last_of('/') + 1) + "..";
  return tests + "/oracle/tables/" + name;
}

struct Table {
  std::map<std::string, std::string> head;
  std::vector<std::vector<std::string>> rows;

  explicit Table(const std::string &name)
  {
    std::ifstream in(table_path(name));
    EXPECT_TRUE(in) << "no oracle table " << table_path(name);
    std::string line;
    bool titles = false;
    while (std::getline(in, line)) {
      if (line[0] == '#') {
        std::istringstream words(line.substr(1));
        std::string key, value;
        words >> key >> value;
        head[key] = value;
      } else if (!titles) {
        titles = true;
      } else {
        rows.emplace_back();
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
      }
    }
  }
  bool none(const std::string &key) const { return head.at(key) == "none"; }
  double number(const std::string &key) const { return std::strtod(head.at(key).c_str(), nullptr); }
  double radius_or_mass(const std::string &key) const { return none(key) ? infinity : number(key); }

  Material material() const
  {
    Material m;
    m.law.law = head.at("law") == "plateau" ? Law::plateau
        : head.at("law") == "luding"        ? Law::luding
                                            : Law::linear;
    m.law.exponent = number("n");
    if (!none("d_ref")) scale_with_diameter(m, number("d_ref"));
    m.law.limit_damping = head.at("limit_damping") == "True";
    m.p.k1 = number("k1");
    m.p.k2 = number("k2");
    m.p.k_adh = number("k_adh");
    m.p.f0 = number("f0");
    m.p.mu = number("mu");
    if (head.count("depth")) m.p.depth = number("depth");
    if (head.count("bound")) m.p.bound = FrictionBound::contact;
    m.p.kt_given = head.at("kt") != "default";
    if (m.p.kt_given) m.p.kt = number("kt");
    if (none("restitution")) {
      m.p.damping = Damping::viscous;
      m.p.viscous_normal = number("B_n");
      m.p.viscous_tangential = number("B_t");
    } else {
      m.p.restitution = number("restitution");
    }
    if (head.at("rolling") == "constant") m.p.rolling = RollingModel::constant;
    if (head.at("rolling") == "sds") m.p.rolling = RollingModel::sds;
    m.p.mu_r = number("mu_r");
    m.p.kr = number("k_r");
    m.p.rolling_viscous = number("g_r");
    return m;
  }
};

Branch branch_named(const std::string &name)
{
  return name == "loading"  ? Branch::loading
      : name == "unloading" ? Branch::unloading
                            : Branch::adhesive;
}

std::string numbered(const char *kind, int number)
{
  char name[32];
  std::snprintf(name, sizeof name, "%s_%02d.csv", kind, number);
  return name;
}

TEST(Oracle, NormalPaths)
{
  double worst = 0.0;
  int compared = 0;
  for (int number = 0; number < 19; number++) {
    const Table table(numbered("normal", number));
    SCOPED_TRACE(numbered("normal", number));
    ASSERT_GT(table.rows.size(), 100u);
    const Material m = table.material();
    const double R_i = table.number("R_i"), R_j = table.number("R_j");
    NormalPath path(m, R_i + R_j, effective_radius(R_i, R_j));
    // the largest terms of which a force is the difference
    double force_scale = 0.0, energy_scale = 0.0, last = 0.0;
    for (const auto &row : table.rows) {
      const double overlap = std::strtod(row[0].c_str(), nullptr);
      if (row[1] == "open") {
        path.max_overlap = 0.0;
        continue;
      }
      auto cell = [&](int k) {
        return std::strtod(row[k].c_str(), nullptr);
      };
      const NormalForce f = path.to(overlap);
      force_scale = std::max(force_scale, std::fabs(cell(2)));
      energy_scale = std::max(energy_scale, std::fabs(cell(5)));
      // a contact at rest on the adhesive branch is at the end of its new k2 line, too
      if (overlap != last || f.branch == Branch::loading) {
        ASSERT_EQ(f.branch, branch_named(row[1])) << "at overlap " << row[0];
      }
      last = overlap;
      const double bound = std::max(0.0, path.bound(f));
      worst = std::max({worst, deviation(f.force, cell(2), force_scale),
                        deviation(f.max_overlap, cell(3)), deviation(bound, cell(4), force_scale),
                        deviation(path.energy(overlap), cell(5), energy_scale)});
      ASSERT_LT(worst, tolerance) << "at overlap " << row[0];
      compared++;
    }
  }
  RecordProperty("worst", testing::PrintToString(worst));
  std::printf("    %d rows, worst deviation %.2g\n", compared, worst);
}

TEST(Oracle, FullContacts)
{
  double worst = 0.0;
  int compared = 0;
  for (int number = 0; number < 28; number++) {
    SCOPED_TRACE(numbered("full", number));
    const Table table(numbered("full", number));
    ASSERT_GT(table.rows.size(), 30u);
    const Material m = table.material();
    Bodies b;
    b.R_i = table.number("R_i");
    b.R_j = table.radius_or_mass("R_j");
    b.m_i = table.number("m_i");
    b.m_j = table.radius_or_mass("m_j");
    History history;
    double force_scale = 0.0, torque_scale = 0.0, energy_scale = 0.0, spring_scale = 0.0;
    double last = 0.0;
    for (const auto &row : table.rows) {
      auto cell = [&](int k) {
        return std::strtod(row[k].c_str(), nullptr);
      };
      auto vector = [&](int k) {
        return Vec3(cell(k), cell(k + 1), cell(k + 2));
      };
      if (row[17] == "open") {
        history = History();
        continue;
      }
      b.u = vector(1).normalized();
      b.overlap = cell(4);
      b.v_i = vector(5);
      b.v_j = vector(8);
      b.w_i = vector(11);
      b.w_j = vector(14);
      const Outcome out = evaluate(m, b, cell(0), history);
      if (b.overlap != last || out.branch == Branch::loading) {
        ASSERT_EQ(out.branch, branch_named(row[17]));
      }
      last = b.overlap;
      force_scale = std::max({force_scale, std::fabs(cell(18)), vector(19).norm()});
      torque_scale = std::max({torque_scale, vector(22).norm(), vector(25).norm()});
      spring_scale = std::max({spring_scale, vector(29).norm(), vector(32).norm()});
      energy_scale = std::max(energy_scale, std::fabs(cell(35)));
      worst = std::max({worst, deviation(out.hysteretic_force, cell(18), force_scale),
                        deviation(out.force, vector(19), force_scale),
                        deviation(out.torque_i, vector(22), torque_scale),
                        deviation(out.torque_j, vector(25), torque_scale),
                        deviation(history.max_overlap, cell(28)),
                        deviation(history.tangential_spring, vector(29), spring_scale),
                        deviation(history.rolling_spring, vector(32), spring_scale),
                        deviation(out.energy.normal, cell(35), energy_scale),
                        deviation(out.energy.tangential, cell(36), energy_scale),
                        deviation(out.energy.rolling, cell(37), energy_scale)});
      ASSERT_LT(worst, tolerance) << "at overlap " << row[4];
      compared++;
    }
  }
  RecordProperty("worst", testing::PrintToString(worst));
  std::printf("    %d rows, worst deviation %.2g\n", compared, worst);
}
}    // namespace oracle_test
