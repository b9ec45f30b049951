// SPDX-License-Identifier: GPL-2.0-only
#include "wall_commands.h"

#include <algorithm>
#include <stdexcept>

namespace eepa {

namespace {

  const Words motion_keywords = {"still", "velocity", "wiggle", "shear", "load"};

  [[noreturn]] void refuse(const std::string &message)
  {
    throw std::invalid_argument(message);
  }

  /// The values of one keyword.
  class Values {
   public:
    /// \param what  keyword and names of its values
    Values(const Words &words, std::size_t keyword, std::size_t count, const std::string &what) :
        words_(words), next_(keyword + 1)
    {
      if (next_ + count > words.size()) refuse("missing value: " + what);
    }

    const std::string &word() { return words_[next_++]; }
    double number(const std::string &name) { return parse_number(name, word()); }
    Quantity quantity(const std::string &name) { return parse_quantity(name, word()); }
    int dimension(const std::string &name)
    {
      const std::string &dim = word();
      if (dim != "x" && dim != "y" && dim != "z")
        refuse(name + " dimension '" + dim + "' is not allowed: it must be x, y or z");
      return dim[0] - 'x';
    }
    std::size_t next() const { return next_; }

   private:
    const Words &words_;
    std::size_t next_;
  };

  std::size_t parse_velocity(const Words &words, std::size_t key, MotionArguments &motion)
  {
    Values values(words, key, 3, "velocity vx vy vz");
    motion.drive = WallDrive::velocity;
    for (auto &component : motion.velocity) component = values.quantity("velocity");
    return values.next();
  }

  std::size_t parse_wiggle(const Words &words, std::size_t key, MotionArguments &motion)
  {
    Values values(words, key, 3, "wiggle dim A period");
    motion.drive = WallDrive::wiggle;
    motion.wiggle_axis = values.dimension("wiggle");
    motion.amplitude = values.number("wiggle A");
    motion.period = values.number("wiggle period");
    if (motion.period <= 0.0)
      refuse("wiggle period = " + words[values.next() - 1] + " is not allowed: it must be > 0");
    return values.next();
  }

  std::size_t parse_shear(const Words &words, std::size_t key, const WallForMotion &wall,
                          MotionArguments &motion)
  {
    Values values(words, key, 2, "shear dim v");
    if (motion.drive == WallDrive::still) motion.drive = WallDrive::shear;
    motion.slides = true;
    motion.shear_axis = values.dimension("shear");
    motion.shear = values.quantity("shear v");
    if (wall.plane && motion.shear_axis == wall.axis)
      refuse("shear dimension " + words[key + 1] +
             " is not allowed: it must lie in the plane; use velocity to move a plane along its "
             "normal");
    return values.next();
  }

  std::size_t parse_platen(const Words &words, std::size_t key, const Words &others,
                           const WallForMotion &wall, MotionArguments &motion)
  {
    if (!wall.plane || wall.surfaces != 1)
      refuse(std::string("load is not allowed with wall ") + (wall.plane ? "lo hi" : "zcylinder") +
             ": it needs one plane alone, lo or hi");
    motion.drive = WallDrive::load;
    Words ends = motion_keywords;
    ends.insert(ends.end(), others.begin(), others.end());
    return parse_load(words, key + 1, ends, motion.load);
  }

}    // namespace

const char *name_of(WallDrive drive)
{
  switch (drive) {
    case WallDrive::velocity:
      return "velocity";
    case WallDrive::wiggle:
      return "wiggle";
    case WallDrive::shear:
      return "shear";
    case WallDrive::load:
      return "load";
    default:
      return "still";
  }
}

bool is_motion(const std::string &word)
{
  return std::find(motion_keywords.begin(), motion_keywords.end(), word) != motion_keywords.end();
}

std::size_t parse_motion(const Words &words, std::size_t first, const Words &others,
                         const WallForMotion &wall, MotionArguments &motion)
{
  MotionArguments read;
  Words given;
  std::size_t next = first;
  while (next < words.size() && is_motion(words[next])) {
    const std::string &key = words[next];
    const bool loaded_slide = given.size() == 1 &&
        ((key == "shear" && given[0] == "load") || (key == "load" && given[0] == "shear"));
    if (!given.empty() && !loaded_slide)
      refuse("only one of velocity, wiggle, shear and load is allowed, or load and shear: " +
             given.back() + " and " + key + " are given");
    given.push_back(key);
    if (key == "velocity")
      next = parse_velocity(words, next, read);
    else if (key == "wiggle")
      next = parse_wiggle(words, next, read);
    else if (key == "shear")
      next = parse_shear(words, next, wall, read);
    else if (key == "load")
      next = parse_platen(words, next, others, wall, read);
    else
      next++;
  }
  motion = read;
  return next;
}

}    // namespace eepa
