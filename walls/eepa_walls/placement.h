// SPDX-License-Identifier: GPL-2.0-only
#ifndef EEPA_WALLS_PLACEMENT_H
#define EEPA_WALLS_PLACEMENT_H

#include <eepa/eigen.h>
#include <eepa/vector.h>

namespace eepa {

/// Where a rigid shape is at present and how fast it moves, in plain numbers, for GPUs too. The shape's own frame
/// is that in which it was made.
class RigidMotion {
 public:
  Vec3 displacement = Vec3::Zero();    ///< [length]
  Vec3 velocity = Vec3::Zero();        ///< of the displacement [length/time]
  Vec3 pivot = Vec3::Zero();           ///< point of the axis of rotation less displacement [length]

  EEPA_FUNCTION bool is_turned() const { return is_turned_; }
  EEPA_FUNCTION const Vec3 &angular_velocity() const { return angular_velocity_; }
  EEPA_FUNCTION bool turns() const { return turns_; }

  EEPA_FUNCTION Vec3 to_shape(const Vec3 &point) const
  {
    const Vec3 still = point - displacement;
    if (!is_turned_) return still;
    return matrix_.transpose() * (still - shift_);
  }
  EEPA_FUNCTION Vec3 to_space(const Vec3 &point) const
  {
    if (!is_turned_) return point + displacement;
    return matrix_ * point + shift_ + displacement;
  }
  EEPA_FUNCTION Vec3 direction_to_shape(const Vec3 &direction) const
  {
    if (!is_turned_) return direction;
    return matrix_.transpose() * direction;
  }
  EEPA_FUNCTION Vec3 direction_to_space(const Vec3 &direction) const
  {
    if (!is_turned_) return direction;
    return matrix_ * direction;
  }

  /// Velocity of the shape at a point of space [length/time]
  EEPA_FUNCTION Vec3 velocity_at(const Vec3 &point) const
  {
    if (!turns_) return velocity;
    const Vec3 arm = point - displacement - pivot;
    return velocity + angular_velocity_.cross(arm);
  }

  /// Velocity of the shape at a moving point, some time ago [length/time]
  /// \param velocity_of_point  [length/time]
  /// \param time  before the present, short
  EEPA_FUNCTION Vec3 velocity_before(const Vec3 &point, const Vec3 &velocity_of_point,
                                     double time) const
  {
    if (!turns_) return velocity;
    return velocity_at(point - time * (velocity_of_point - velocity));
  }

 protected:
  bool is_turned_ = false;
  Vec3 shift_ = Vec3::Zero();
  Eigen::Matrix3d matrix_ = Eigen::Matrix3d::Identity();
  Vec3 angular_velocity_ = Vec3::Zero();
  bool turns_ = false;    // whether it is not 0
};

/// A RigidMotion about an axis that may change.
///
/// A point y of the shape is at x = displacement + Q y + c, with a rotation Q, 1 at first. A rotation
/// about an axis leaves that axis where it is in the space without the displacement, so that the
/// axis goes along with it.
class Placement : public RigidMotion {
 public:
  // kept in restart files, and the pivot
  Eigen::Quaterniond begun_at = Eigen::Quaterniond::Identity();    ///< Q when the rotation began
  Vec3 shift_begun_at = Vec3::Zero();                              ///< c at that time [length]
  Vec3 axis = Vec3(0.0, 0.0, 1.0);                                 ///< unit vector
  double angle = 0.0;                                              ///< since the rotation began

  /// Begins a rotation about an axis. What has been turned before stays turned.
  void begin_rotation(const Vec3 &point, const Vec3 &unit_axis)
  {
    const Eigen::Quaterniond so_far = rotation_;
    const Vec3 shift = shift_;
    begun_at = so_far;
    shift_begun_at = shift;
    pivot = point - displacement;
    axis = unit_axis;
    turn_to(0.0);
  }

  /// Turns the shape to an angle since the rotation began.
  void turn_to(double since_begin)
  {
    angle = since_begin;
    is_turned_ = angle != 0.0 || begun_at.vec() != Vec3::Zero();
    if (!is_turned_) {
      rotation_.setIdentity();
      shift_.setZero();
      matrix_.setIdentity();
      return;
    }
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, axis));
    rotation_ = (turn * begun_at).normalized();
    shift_ = pivot + turn * (shift_begun_at - pivot);
    matrix_ = rotation_.toRotationMatrix();
  }

  /// [1/time], about the axis
  void set_angular_velocity(double speed)
  {
    angular_velocity_ = speed * axis;
    turns_ = speed != 0.0;
  }

  /// Point of the axis of rotation and its direction in the shape's frame.
  Vec3 pivot_of_shape() const { return to_shape(pivot + displacement); }
  Vec3 axis_of_shape() const { return direction_to_shape(axis); }

 private:
  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
};

}    // namespace eepa

#endif
