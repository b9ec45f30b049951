// SPDX-License-Identifier: GPL-2.0-only

// Contacts evaluated side by side have the results of single ones: every lane gives the bits of a
// double.

#include <eepa/coefficient_rows.h>
#include <eepa/dispatch.h>

#include "../random_parameters.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#ifdef EEPA_HAS_LANES

namespace lanes_test {
using namespace eepa;

constexpr int width = static_cast<int>(Lanes::size());

struct Case {
  const char *name;
  LawSettings settings;
  RollingModel rolling;
  Damping damping;
  TwistingModel twisting = TwistingModel::none;
  FrictionBound bound = FrictionBound::adhesive;
};

/// Numbers from a fixed seed, and contacts made of them.
class Generator {
 public:
  double between(double lowest, double highest)
  {
    return lowest + (highest - lowest) * uniform_(engine_);
  }
  Vec3 vector(double size)
  {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  Contact contact()
  {
    Contact c;
    c.normal = vector(1.0);
    c.normal /= c.normal.norm();
    const double radius_i = between(0.2, 1.0), radius_j = between(0.2, 1.0);
    c.size = radius_i + radius_j;
    c.overlap = between(1e-6, 0.05);
    const double frozen = std::numeric_limits<double>::infinity();
    c.effective_mass =
        effective_mass(between(0.1, 2.0), between(0.0, 1.0) < 0.1 ? frozen : between(0.1, 2.0));
    c.effective_radius = effective_radius(radius_i, radius_j);
    c.velocity = vector(1.0);
    c.arm_i = radius_i - 0.5 * c.overlap;
    c.arm_j = radius_j - 0.5 * c.overlap;
    c.spin = vector(1.0);
    c.angular_velocity = vector(1.0);
    c.turn = vector(1e-3);
    c.twist = between(-1e-3, 1e-3);
    return c;
  }

 private:
  std::mt19937_64 engine_{20261125};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

Vector3<Lanes> in_lanes(const Vec3 *vectors)
{
  return Vector3<Lanes>(Lanes([&](auto l) {
                          return vectors[l][0];
                        }),
                        Lanes([&](auto l) {
                          return vectors[l][1];
                        }),
                        Lanes([&](auto l) {
                          return vectors[l][2];
                        }));
}

template <class Member> Lanes member(const std::vector<Contact> &contacts, Member m)
{
  return Lanes([&](auto l) {
    return contacts[l].*m;
  });
}
template <class Member> Vector3<Lanes> vector_member(const std::vector<Contact> &contacts, Member m)
{
  Vec3 vectors[width];
  for (int l = 0; l < width; l++) vectors[l] = contacts[l].*m;
  return in_lanes(vectors);
}

ContactOf<Lanes> side_by_side(const std::vector<Contact> &contacts)
{
  ContactOf<Lanes> c;
  c.normal = vector_member(contacts, &Contact::normal);
  c.overlap = member(contacts, &Contact::overlap);
  c.size = member(contacts, &Contact::size);
  c.effective_mass = member(contacts, &Contact::effective_mass);
  c.effective_radius = member(contacts, &Contact::effective_radius);
  c.velocity = vector_member(contacts, &Contact::velocity);
  c.arm_i = member(contacts, &Contact::arm_i);
  c.arm_j = member(contacts, &Contact::arm_j);
  c.spin = vector_member(contacts, &Contact::spin);
  c.angular_velocity = vector_member(contacts, &Contact::angular_velocity);
  c.turn = vector_member(contacts, &Contact::turn);
  c.twist = member(contacts, &Contact::twist);
  return c;
}

void expect_bits(double lane, double one, const char *what)
{
  // 0 and -0 are the same force
  EXPECT_TRUE(lane == one || (std::isnan(lane) && std::isnan(one)))
      << what << ": " << lane << " and " << one << " differ by " << lane - one;
}
void expect_bits(const Vector3<Lanes> &lanes, int l, const Vec3 &one, const char *what)
{
  for (int k = 0; k < 3; k++) expect_bits(lanes[k][l], one[k], what);
}

/// Parameters of a case, every one that the table has.
Parameters draw_parameters(Generator &generator, const Case &given)
{
  Parameters p;
  p.kt_given = true;
  p.damping = given.damping;
  p.rolling = given.rolling;
  p.twisting = given.twisting;
  p.bound = given.bound;
  eepa_test::Spread spread{3.0, 4.0};
  spread.overlap = 0.03;
  spread.high = 0.5;
  const auto draw = [&generator] {
    return generator.between(0.0, 1.0);
  };
  eepa_test::draw_numbers(draw, spread, given.settings, p);
  return p;
}

/// Parameters of one of several pairs of types. They also differ in what each pair chooses.
Parameters draw_other_choices(Generator &generator, const Case &given)
{
  const auto chance = [&generator](double share) {
    return generator.between(0.0, 1.0) < share;
  };
  Parameters p = draw_parameters(generator, given);
  p.damping = chance(0.5) ? Damping::restitution : Damping::viscous;
  p.bound = chance(0.5) ? FrictionBound::adhesive : FrictionBound::contact;
  if (chance(0.2)) p.rolling = RollingModel::none;
  if (chance(0.2)) p.twisting = TwistingModel::none;
  return p;
}

class SideBySide : public testing::TestWithParam<Case> {};

/// Compares lanes with single contacts.
/// \param same  whether all lanes have the same coefficients; else each has its own
void compare_lanes(const Case &given, bool same)
{
  with_law(given.settings, given.rolling, given.twisting, [&](auto law) {
    using ContactLaw = decltype(law);
    Generator generator;
    int branches[4] = {0, 0, 0, 0}, sliding = 0, sticking = 0;
    for (int round = 0; round < 200; round++) {
      LawSettings settings = given.settings;
      settings.limit_damping = round % 2;
      std::vector<Coefficients> c(width);
      std::vector<CoefficientRows> rows;
      LanePointers<const CoefficientRows> of_lane;
      const Parameters all = draw_parameters(generator, given);
      for (Coefficients &own : c) {
        own = resolve(same ? all : draw_other_choices(generator, given), settings);
        rows.emplace_back(own);
      }
      for (int l = 0; l < width; l++) of_lane[l] = &rows[l];

      std::vector<History> one(width);
      for (auto &history : one) {
        if (generator.between(0.0, 1.0) < 0.2) continue;    // virgin
        history.max_overlap = generator.between(0.0, 0.06);
        history.tangential_spring = generator.vector(0.01);
        history.rolling_spring = generator.vector(0.01);
        history.twisting_spring = generator.between(-0.01, 0.01);
      }
      // through a driver's flat arrays, where LAMMPS may have changed every sign
      std::vector<double> flat(width * ContactLaw::history_size);
      LanePointers<double> at;
      for (int l = 0; l < width; l++) {
        at[l] = flat.data() + l * ContactLaw::history_size;
        store_history<typename ContactLaw::Layout>(one[l], at[l]);
      }
      for (int step = 0; step < 10; step++) {
        std::vector<Contact> contacts(width);
        for (auto &contact : contacts) contact = generator.contact();
        const ContactOf<Lanes> together = side_by_side(contacts);
        HistoryOf<Lanes> history = load_history<typename ContactLaw::Layout>(at);
        const auto response = same
            ? ContactLaw::evaluate(c[0], together, 1e-3, history)
            : ContactLaw::evaluate(gather_coefficients(of_lane, c[0]), together, 1e-3, history);
        store_history<typename ContactLaw::Layout>(history, at);
        const Wrench<Lanes> wrench = ContactLaw::wrench(response, together);
        for (int l = 0; l < width; l++) {
          const Response alone = ContactLaw::evaluate(c[l], contacts[l], 1e-3, one[l]);
          expect_bits(response.normal_force[l], alone.normal_force, "normal force");
          expect_bits(response.hysteretic_force[l], alone.hysteretic_force, "f_hys");
          expect_bits(response.friction_bound[l], alone.friction_bound, "bound");
          expect_bits(response.tangential_force, l, alone.tangential_force, "tangential force");
          const Wrench<double> own = ContactLaw::wrench(alone, contacts[l]);
          expect_bits(wrench.force, l, own.force, "force");
          expect_bits(wrench.torque_i, l, own.torque_i, "torque on i");
          expect_bits(wrench.torque_j, l, own.torque_j, "torque on j");
          if constexpr (ContactLaw::has_rolling)
            expect_bits(response.rolling_torque, l, alone.rolling_torque, "rolling torque");
          if constexpr (ContactLaw::has_twisting)
            expect_bits(response.twisting_torque[l], alone.twisting_torque, "twisting torque");
          EXPECT_EQ(response.branch[l], static_cast<double>(alone.branch));
          EXPECT_EQ(response.sliding[l], alone.sliding);
          const auto stored =
              load_history<typename ContactLaw::Layout>(static_cast<const double *>(at[l]));
          expect_bits(stored.max_overlap, one[l].max_overlap, "delta_max");
          for (int k = 0; k < 3; k++) {
            expect_bits(stored.tangential_spring[k], one[l].tangential_spring[k], "spring");
            if (ContactLaw::Rolling::has_spring)
              expect_bits(stored.rolling_spring[k], one[l].rolling_spring[k], "rolling spring");
          }
          if (ContactLaw::has_twisting)
            expect_bits(stored.twisting_spring, one[l].twisting_spring, "twisting spring");
          branches[static_cast<int>(alone.branch)]++;
          (alone.sliding ? sliding : sticking)++;
        }
        if (testing::Test::HasFailure()) return;
      }
    }
    // the cases must not all be of one kind
    for (const Branch branch : {Branch::loading, Branch::unloading, Branch::adhesive})
      EXPECT_GT(branches[static_cast<int>(branch)], 50);
    EXPECT_GT(sliding, 50);
    EXPECT_GT(sticking, 50);
  });
}

TEST_P(SideBySide, EveryLaneHasTheBitsOfOneContact)
{
  compare_lanes(GetParam(), true);
}

TEST_P(SideBySide, EveryLaneHasItsOwnCoefficients)
{
  compare_lanes(GetParam(), false);
}

LawSettings settings(Law law, double exponent, bool scaled)
{
  LawSettings s;
  s.law = law;
  s.exponent = exponent;
  s.scaled = scaled;
  s.reference_diameter = 0.7;
  return s;
}

const Case cases[] = {
    {"plateau", settings(Law::plateau, 1.0, false), RollingModel::none, Damping::restitution},
    {"plateau_scaled_sds", settings(Law::plateau, 1.0, true), RollingModel::sds, Damping::viscous},
    {"linear", settings(Law::linear, 1.0, false), RollingModel::none, Damping::viscous},
    {"linear_scaled_constant", settings(Law::linear, 1.0, true), RollingModel::constant,
     Damping::restitution},
    {"linear_sds", settings(Law::linear, 1.0, false), RollingModel::sds, Damping::restitution},
    {"exponent_scaled", settings(Law::linear, 1.5, true), RollingModel::none, Damping::restitution},
    {"exponent_constant", settings(Law::linear, 1.5, false), RollingModel::constant,
     Damping::viscous},
    {"exponent_scaled_sds", settings(Law::linear, 2.0, true), RollingModel::sds,
     Damping::restitution},
    {"linear_scaled_twisting", settings(Law::linear, 1.0, true), RollingModel::none,
     Damping::restitution, TwistingModel::marshall},
    {"plateau_sds_twisting", settings(Law::plateau, 1.0, false), RollingModel::sds,
     Damping::viscous, TwistingModel::marshall},
    {"exponent_constant_twisting", settings(Law::linear, 1.5, false), RollingModel::constant,
     Damping::restitution, TwistingModel::marshall},
    {"luding", settings(Law::luding, 1.0, false), RollingModel::none, Damping::viscous},
    {"luding_scaled_sds", settings(Law::luding, 1.0, true), RollingModel::sds,
     Damping::restitution},
    {"luding_constant_twisting_contact", settings(Law::luding, 1.0, false), RollingModel::constant,
     Damping::restitution, TwistingModel::marshall, FrictionBound::contact},
    {"linear_contact", settings(Law::linear, 1.0, false), RollingModel::none, Damping::viscous,
     TwistingModel::none, FrictionBound::contact},
};
INSTANTIATE_TEST_SUITE_P(Laws, SideBySide, testing::ValuesIn(cases), [](const auto &info) {
  return std::string(info.param.name);
});

// Each number comes from the row of its lane, and from nowhere else.
TEST(CoefficientRows, AreGatheredLaneByLane)
{
  std::vector<Coefficients> c(width);
  double next = 1.0;
  for (Coefficients &own : c)
    for (const auto member : detail::row_members<double>) own.*member = next++;
  c[0].exponent = 1.5;
  c[0].inverse_reference_diameter = 0.25;
  c[0].limit_damping = true;
  const std::vector<CoefficientRows> rows(c.begin(), c.end());
  LanePointers<const CoefficientRows> of_lane;
  for (int l = 0; l < width; l++) of_lane[l] = &rows[width - 1 - l];
  const CoefficientsOf<Lanes> gathered = gather_coefficients(of_lane, c[0]);
  for (std::size_t k = 0; k < detail::row_members<double>.size(); k++)
    for (int l = 0; l < width; l++)
      EXPECT_EQ((gathered.*detail::row_members<Lanes>[k])[l],
                c[width - 1 - l].*detail::row_members<double>[k])
          << k << ' ' << l;
  EXPECT_EQ(gathered.exponent, 1.5);
  EXPECT_EQ(gathered.inverse_reference_diameter, 0.25);
  EXPECT_TRUE(gathered.limit_damping);
}

}    // namespace lanes_test

#endif
