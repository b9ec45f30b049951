// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_TESTS_RANDOM_SCRIPT_H
#define EEPA_TESTS_RANDOM_SCRIPT_H

#include "packing.h"
#include "triangles.h"

#include "../random_parameters.h"

#include <eepa_commands/commands.h>

#include <cstdio>
#include <string>
#include <vector>

namespace eepa_test {

/// A small random problem with this package's features, drawn from a seed: law, coefficients,
/// walls, their motion, particles, and commands between runs. Laws and parameters are those of the
/// table of parameters. Add another feature to one of the functions below that draw, and every
/// comparison tests it.
class RandomScript {
 public:
  /// A run and the commands between it and the next one.
  struct Stage {
    int steps;
    std::string then;
  };

  explicit RandomScript(unsigned seed) : generator_(seed)
  {
    draw_particles();
    draw_law();
    draw_walls();
    for (int k = 1 + number(2); k >= 0; k--) stages.push_back({30 + number(50), event()});
  }

  std::vector<Sphere> spheres;
  std::string pair;        ///< pair_style and pair_coeff; a restart file has them
  std::string fixes;       ///< walls and gravity, without the integrator
  std::string boundary;    ///< of the box, that is [-half, half] in each direction
  double half = 0.0;
  std::vector<Corners> triangles;    ///< of the file that `fixes` names MESH; none without a mesh
  std::vector<std::string> walls;    ///< IDs of the wall fixes
  bool walls_move = false;           ///< whether any of them changes its place
  std::vector<Stage> stages;

  std::string text() const
  {
    std::string all = "boundary " + boundary + "\n" + pair + "\n" + fixes + "\n";
    for (const auto &stage : stages)
      all += "run " + std::to_string(stage.steps) + "\n" + stage.then + "\n";
    return all;
  }

 private:
  std::mt19937 generator_;
  std::string style_;
  eepa::LawSettings settings_;
  eepa::Parameters parameters_;

  int number(int below) { return static_cast<int>(generator_() % static_cast<unsigned>(below)); }
  bool chance(int percent) { return number(100) < percent; }
  double between(double low, double high)
  {
    return low + (high - low) * 0.5 * (1.0 + uniform(generator_));
  }
  static std::string word(double value)
  {
    char text[32];
    std::snprintf(text, sizeof(text), " %.6g", value);
    return text;
  }

  void draw_particles()
  {
    Packing packing;
    packing.side = 4 + number(2);
    packing.speed = between(0.2, 2.0);
    packing.types = 1 + number(2);
    packing.polydisperse = chance(50);
    spheres = packing.spheres(generator_());
    half = packing.half();
  }

  void draw_law()
  {
    settings_.law = static_cast<eepa::Law>(number(eepa::law_count));
    style_ = eepa::entry_of(settings_.law).name;
    if (chance(50)) style_ += " scale" + word(between(0.5, 2.0));
    if (eepa::entry_of(settings_.law).has_exponent && chance(40)) {
      style_ += " exponent" + word(between(1.0, 1.8));
      settings_.exponent = std::stod(style_.substr(style_.rfind(' ')));
    }
    if (chance(30)) style_ += " limit_damping yes";
    style_ += " dtcheck off";
    // those of one script can be mixed and used together
    draw_choices(
        [this] {
          return between(0.0, 1.0);
        },
        settings_, parameters_);
    pair = "pair_style gran/eepa " + style_;
    pair += "\npair_coeff * *" + coefficients();
    if (chance(50)) pair += "\npair_coeff 2 2" + coefficients();
    if (chance(30)) pair += "\npair_coeff 1 2" + coefficients();
  }

  std::string coefficients()
  {
    Spread spread{3.7, 4.2};
    spread.low = -1.0;
    spread.overlap = 5e-4;
    spread.mass = 0.01;
    const auto draw = [this] {
      return between(0.0, 1.0);
    };
    eepa::for_each_choice([&](const eepa::Choice &choice) {
      if (choice.merge == eepa::Merge::either) choice.set(parameters_, number(choice.count));
    });
    if (settings_.exponent != 1.0) parameters_.kt_given = true;
    draw_numbers(draw, spread, settings_, parameters_);
    return " " + eepa::to_words(parameters_);
  }

  void draw_walls()
  {
    const std::string lo = exact(-half), hi = exact(half);
    boundary = "p p p";
    if (chance(60))
      fixes += "fix gravity all gravity" + word(between(1.0, 50.0)) + " vector 0.3 0.1 -1\n";
    const int kind = number(6);
    if (kind == 1) {
      boundary = "p p f";
      add_wall("zplane " + lo + " " + hi, motion("z"));
    } else if (kind == 2) {
      boundary = "f f f";
      add_wall("xplane " + lo + " " + hi, motion("x"));
      add_wall("yplane " + lo + " " + hi, chance(50) ? "" : motion("y"));
      add_wall("zplane " + lo + " NULL", "");
      add_wall("zplane NULL " + hi,
               chance(50) ? " load" + word(-between(100.0, 2000.0)) + " mass" +
                       word(between(5.0, 50.0)) + " damping" + word(between(0.0, 100.0))
                          : motion("z"));
    } else if (kind == 3) {
      boundary = "f f p";
      const double radius = 1.1 * half;
      keep_within(radius, false);
      add_wall("zcylinder" + word(radius), chance(50) ? "" : motion("z"));
    } else if (kind == 4) {
      boundary = "f f f";
      draw_region();
    } else if (kind == 5) {
      boundary = "f f f";
      draw_mesh();
    }
  }

  /// Keeps the particles within a cylinder about z or a sphere, both about the origin.
  void keep_within(double radius, bool sphere)
  {
    std::vector<Sphere> inside;
    for (const auto &s : spheres) {
      const double z = sphere ? s.x.z() : 0.0;
      if (Vec3(s.x.x(), s.x.y(), z).norm() + s.radius < radius + 0.05) inside.push_back(s);
    }
    spheres = inside;
  }

  void draw_region()
  {
    const double radius = 1.1 * half;
    const std::string ends = " " + exact(-half) + " " + exact(half);
    switch (number(3)) {
      case 0:
        fixes += "region shape block" + ends + ends + ends + "\n";
        add_wall("region shape", shape_motion(0.5));
        break;
      case 1:
        keep_within(radius, true);
        fixes += "region shape sphere 0 0 0" + word(radius) + "\n";
        add_wall("region shape", shape_motion(5.0));
        break;
      default:
        keep_within(radius, false);
        fixes += "region shape cylinder z 0 0" + word(radius) + ends + "\n";
        add_wall("region shape", shape_motion(chance(50) ? 5.0 : 0.0));
    }
  }

  void draw_mesh()
  {
    if (chance(50)) {
      triangles = box(half, 1 + number(6), true);
      add_wall("mesh MESH", shape_motion(0.5));
    } else {
      const double radius = 1.1 * half;
      triangles = prism(12 + number(30), 1.04 * radius, half, true);
      keep_within(radius, false);
      add_wall("mesh MESH", shape_motion(5.0));
    }
  }

  /// \param fastest  rotation about z; others about any axis are slower, since edges would hit particles
  std::string shape_motion(double fastest)
  {
    std::string words;
    switch (number(5)) {
      case 0:
        words = " wiggle" + std::string(chance(50) ? " x" : " z") + word(between(0.0, 0.03)) +
            word(between(0.02, 0.1));
        break;
      case 1:
        words = " velocity" + word(between(-0.5, 0.5)) + word(between(-0.5, 0.5)) +
            word(between(-0.5, 0.5));
        break;
      case 2:
        words = " load z" + word(between(-500.0, 500.0)) + " mass" + word(between(5.0, 50.0)) +
            " damping" + word(between(0.0, 100.0));
        break;
      default:
        break;
    }
    if (chance(50))
      words += chance(70) ? " rotate 0 0 0 0 0 1" + word(between(-fastest, fastest))
                          : " rotate 0.3 0.1 0 1 -0.5 0.2" + word(between(-0.5, 0.5));
    return words;
  }

  void add_wall(const std::string &surface, const std::string &motion)
  {
    for (const char *drive : {" velocity", " wiggle", " load", " rotate"})
      if (motion.find(drive) != std::string::npos) walls_move = true;
    walls.push_back("wall" + std::to_string(walls.size() + 1));
    fixes += "fix " + walls.back() + " all wall/gran/eepa " + style_ + " coeff" + coefficients() +
        " wall " + surface + motion + (chance(30) ? " contacts" : "") + "\n";
  }

  /// \param along  the axis of planes, or that of a cylinder
  std::string motion(const std::string &along)
  {
    switch (number(4)) {
      case 0:
        return " wiggle " + along + word(between(0.0, 0.03)) + word(between(0.02, 0.1));
      case 1: {
        std::string words = " velocity";
        for (const char *axis : {"x", "y", "z"})
          words += axis == along ? word(between(-1.0, 1.0)) : " 0.5";
        return words;
      }
      case 2:
        return " shear " + std::string(along == "x" ? "y" : "x") + word(between(-2.0, 2.0));
      default:
        return "";
    }
  }

  std::string event()
  {
    switch (number(6)) {
      case 0:
        return "velocity all set 0.3 -0.2 0.1 sum yes units box";
      case 1:
        return "pair_coeff * *" + coefficients();
      case 2:
        return "group gone id 3:60:7\ndelete_atoms group gone compress no\ngroup gone delete";
      case 3:
        return "run 0 post no";
      default:
        return "";
    }
  }
};

}    // namespace eepa_test

#endif
