// SPDX-License-Identifier: GPL-2.0-only

// Every law on a GPU: forces, states, energies and losses of contacts over some steps, compared
// with those of the host's processor. Compiling without a warning is a separate test, which needs
// no GPU. Prints one line a law and fails where the two differ by more than rounding.
//
//   nvcc -std=c++17 -O2 -fmad=false -I kernel -I <Eigen> tests/device/laws.cu -o laws && ./laws

#include <eepa/eepa.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

namespace {

using namespace eepa;

constexpr int contacts = 4096, steps = 40;
constexpr double time_step = 1e-6;

/// The compared results of a contact, as plain numbers.
enum Number {
  FORCE = 0,
  TORQUE_I = 3,
  TORQUE_J = 6,
  SPRING = 9,
  ROLLING = 12,
  TWIST = 15,
  MAX_DELTA,
  STATUS,
  ENERGY,
  LOST,
  OPENING,
  PLASTIC,
  N_NUMBERS
};

/// A pair of particles, or a particle and a wall, with prescribed motion.
struct Pair {
  Body<double> i, j;
  Vec3 acceleration;
  bool wall;
};

/// History rows of every kind: consecutive values as in LAMMPS, of stride `contacts`, and in quads.
struct Histories {
  double *rows, *strided;
  Quad *quads;
};

template <class ContactLaw> EEPA_FUNCTION Contact contact_at(const Pair &pair, int step)
{
  const double time = step * time_step;
  Body<double> i = pair.i;
  i.v += time * pair.acceleration;
  i.x += time * (pair.i.v + 0.5 * time * pair.acceleration);
  if (!pair.wall) return contact_of<ContactLaw>(i, pair.j, time_step);
  WallPoint<double> wall;
  wall.normal = Vec3(0, 0, 1);
  wall.overlap = i.radius - i.x[2];
  wall.velocity = pair.j.v;
  wall.normal_rate = Vec3(0.3 * i.v[0], 0.3 * i.v[1], 0.0);
  return contact_at_wall(i, wall, time_step);
}

/// One step of a contact, as in a driver. Its history is read from one kind of row and written to
/// all.
template <class ContactLaw>
EEPA_FUNCTION void live_one_step(const Coefficients &c, const Pair &pair, int step, int index,
                                 const Histories &all, double *numbers)
{
  using Layout = typename ContactLaw::Layout;
  const Contact contact = contact_at<ContactLaw>(pair, step);
  double *raw = all.rows + index * 8;
  const StridedRow<double> strided{all.strided + index, contacts};
  const QuadRow<Quad> quads{all.quads + index, contacts};
  History history = step % 3 == 0 ? load_history<Layout>(raw)
      : step % 3 == 1             ? load_history<Layout>(strided)
                                  : load_history<Layout>(quads);
  const History before = history;
  if (!(contact.overlap > 0.0)) {
    if (before.max_overlap > 0.0)
      numbers[OPENING] +=
          dissipation_of_opening<ContactLaw>(c, contact, time_step, before, true).total();
    history = History();
  } else {
    const Response response = ContactLaw::evaluate(c, contact, time_step, history);
    const Wrench<double> wrench = ContactLaw::wrench(response, contact);
    for (int k = 0; k < 3; k++) {
      numbers[FORCE + k] = wrench.force[k];
      numbers[TORQUE_I + k] = wrench.torque_i[k];
      numbers[TORQUE_J + k] = wrench.torque_j[k];
    }
    numbers[STATUS] = ContactStatus::of(response);
    numbers[ENERGY] = ContactLaw::stored_energy(c, contact, history).total();
    numbers[PLASTIC] = ContactLaw::Normal::plastic_overlap(c, ContactLaw::scale_of(c, contact),
                                                           history.max_overlap);
    numbers[LOST] += dissipation_of_step<ContactLaw>(c, contact, response, time_step,
                                                     before.max_overlap == 0.0, before, history)
                         .total();
  }
  store_history<Layout>(history, raw);
  store_history<Layout>(history, strided);
  store_history<Layout>(history, quads);
  for (int k = 0; k < 3; k++) {
    numbers[SPRING + k] = history.tangential_spring[k];
    numbers[ROLLING + k] = history.rolling_spring[k];
  }
  numbers[TWIST] = history.twisting_spring;
  numbers[MAX_DELTA] = history.max_overlap;
}

template <class ContactLaw>
__global__ void live(Coefficients c, const Pair *pairs, Histories all, double *numbers)
{
  const int index = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (index >= contacts) return;
  for (int step = 0; step < steps; step++)
    live_one_step<ContactLaw>(c, pairs[index], step, index, all, numbers + index * N_NUMBERS);
}

void require(cudaError_t status)
{
  if (status == cudaSuccess) return;
  std::fprintf(stderr, "CUDA: %s\n", cudaGetErrorString(status));
  std::exit(1);
}

/// A zeroed array that the GPU can access, too.
template <class T> class OnDevice {
 public:
  explicit OnDevice(std::size_t count) : size_(count * sizeof(T))
  {
    require(cudaMalloc(&data_, size_));
    require(cudaMemset(data_, 0, size_));
  }
  ~OnDevice() { cudaFree(data_); }
  OnDevice(const OnDevice &) = delete;
  OnDevice &operator=(const OnDevice &) = delete;
  T *data() const { return data_; }
  void upload(const T *from) const
  {
    require(cudaMemcpy(data_, from, size_, cudaMemcpyHostToDevice));
  }
  std::vector<T> download() const
  {
    std::vector<T> to(size_ / sizeof(T));
    require(cudaMemcpy(to.data(), data_, size_, cudaMemcpyDeviceToHost));
    return to;
  }

 private:
  T *data_ = nullptr;
  std::size_t size_;
};

std::vector<Pair> make_pairs()
{
  std::mt19937_64 engine(20261127);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto vector = [&](double size) {
    const double x = size * unit(engine), y = size * unit(engine);
    return Vec3(x, y, size * unit(engine));
  };
  std::vector<Pair> pairs(contacts);
  for (int n = 0; n < contacts; n++) {
    Pair &pair = pairs[n];
    pair.wall = n % 5 == 0;
    for (Body<double> *body : {&pair.i, &pair.j}) {
      body->radius = 5e-4 * (1.0 + 0.3 * unit(engine));
      body->mass = n % 11 == 0 ? HUGE_VAL : 8000.0 * std::pow(body->radius, 3.0);
      body->x = vector(1e-3);
      body->v = vector(0.05);
      body->omega = vector(300.0);
    }
    const double depth = 1e-5 * (unit(engine) + 0.8);
    Vec3 normal(0, 0, 1);
    if (!pair.wall) normal = (vector(1.0) + Vec3(0, 0, 1.8)).normalized();
    const double distance = pair.i.radius + (pair.wall ? 0.0 : pair.j.radius) - depth;
    pair.i.x = distance * normal;
    if (!pair.wall) pair.i.x += pair.j.x;
    // the particles approach and separate again, until the contact opens
    pair.i.v -= 0.6 * normal;
    pair.acceleration = 4e4 * normal;
  }
  return pairs;
}

template <class ContactLaw> bool compare(const char *name, const Coefficients &c)
{
  const std::vector<Pair> pairs = make_pairs();
  std::vector<double> rows(contacts * 8), strided(contacts * 8), here(contacts * N_NUMBERS);
  std::vector<Quad> quads(contacts * 2);
  const Histories mine = {rows.data(), strided.data(), quads.data()};
  for (int index = 0; index < contacts; index++)
    for (int step = 0; step < steps; step++)
      live_one_step<ContactLaw>(c, pairs[index], step, index, mine,
                                here.data() + index * N_NUMBERS);

  const OnDevice<Pair> device_pairs(contacts);
  device_pairs.upload(pairs.data());
  const OnDevice<double> device_rows(contacts * 8), device_strided(contacts * 8),
      numbers(contacts * N_NUMBERS);
  const OnDevice<Quad> device_quads(contacts * 2);
  live<ContactLaw><<<(contacts + 127) / 128, 128>>>(
      c, device_pairs.data(),
      Histories{device_rows.data(), device_strided.data(), device_quads.data()}, numbers.data());
  require(cudaGetLastError());
  require(cudaDeviceSynchronize());
  const std::vector<double> there = numbers.download();

  long different = 0;
  double worst = 0.0;
  int touching = 0;
  for (int k = 0; k < N_NUMBERS; k++) {
    double largest = 0.0, deviation = 0.0;
    for (int index = 0; index < contacts; index++) {
      const double a = here[index * N_NUMBERS + k], b = there[index * N_NUMBERS + k];
      if (k == STATUS && a != 0.0) touching++;
      if (!(a == b)) different++;
      largest = std::max(largest, std::fabs(a));
      deviation = std::isfinite(a - b) ? std::max(deviation, std::fabs(a - b)) : HUGE_VAL;
    }
    if (largest > 0.0) worst = std::max(worst, deviation / largest);
  }
  std::printf("%-40s %5d contacts, %6ld of %d numbers differ, by at most %.1e of the largest\n",
              name, touching, different, contacts * N_NUMBERS, worst);
  return worst < 1e-10 && touching > contacts / 2;
}

bool compare_models(const char *law_name, LawSettings settings, Parameters p)
{
  const struct {
    RollingModel model;
    const char *name;
  } rollings[] = {{RollingModel::none, ""},
                  {RollingModel::constant, ", constant"},
                  {RollingModel::sds, ", sds"}};
  bool passed = true;
  for (const auto &rolling : rollings) {
    for (const bool twists : {false, true}) {
      p.rolling = rolling.model;
      p.twisting = twists ? TwistingModel::marshall : TwistingModel::none;
      const Coefficients c = resolve(p, settings);
      char name[100];
      std::snprintf(name, sizeof(name), "%s%s%s", law_name, rolling.name,
                    twists ? ", twisting" : "");
      passed &= with_law(settings, p, [&](auto law) {
        return compare<decltype(law)>(name, c);
      });
    }
  }
  return passed;
}

}    // namespace

int main()
{
  int devices = 0;
  if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0) {
    std::printf("no GPU: nothing is compared\n");
    return 77;
  }
  cudaDeviceProp card;
  require(cudaGetDeviceProperties(&card, 0));
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  std::printf("%s\n", card.name);

  Parameters p;
  p.k1 = 5e3;
  p.k2 = 1e4;
  p.k_adh = 4e3;
  p.f0 = -1e-3;
  p.mu = 0.4;
  p.kt_given = true;
  p.kt = 2e3;
  p.restitution = 0.5;
  p.mu_r = 0.1;
  p.kr = 1e3;
  p.rolling_viscous = 1e-3;
  LawSettings settings;
  settings.scaled = true;
  settings.reference_diameter = 1e-3;
  bool passed = true;
  settings.law = Law::plateau;
  passed &= compare_models("plateau", settings, p);
  settings.law = Law::linear;
  settings.limit_damping = true;
  passed &= compare_models("linear", settings, p);
  settings.law = Law::luding;
  p.depth = 0.02;
  p.bound = FrictionBound::contact;
  passed &= compare_models("luding, bound contact", settings, p);
  settings.law = Law::linear;
  settings.exponent = 1.5;
  p.k1 *= 300.0;
  p.k2 *= 300.0;
  p.k_adh *= 300.0;
  p.damping = Damping::viscous;
  p.viscous_normal = p.viscous_tangential = 0.05;
  passed &= compare_models("linear, exponent 1.5", settings, p);
  return passed ? 0 : 1;
}
