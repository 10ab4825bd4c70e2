/* stillbeam: feed-forward setpoints for a flexible robot link, in real time.
 *
 * Every call returns an sb_status; 0 is success. sb_error_text says in a line why a call was
 * refused. The caller owns all memory: an sb_arm, sb_planner, sb_path or sb_drive is storage for
 * its init function. Structures are in SI units, and a field that is 0 is not there. sb_tick is the
 * call for the control interrupt; the others run beside it.
 *
 * docs/c.md has a program that fits on a screen, and how to link.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */

#ifndef STILLBEAM_H
#define STILLBEAM_H

/* Made by cbindgen from bindings/c/src. Do not edit. */

#include <stddef.h>
#include <stdint.h>

/**
 * Version of the header. A structure that begins with it is refused if it was compiled against
 * another one.
 */
#define SB_ABI 1

/**
 * Words of 8 bytes in `sb_arm`.
 */
#define SB_ARM_WORDS 416

/**
 * Words of 8 bytes in `sb_planner`.
 */
#define SB_PLANNER_WORDS 320

/**
 * Words of 8 bytes in `sb_path`.
 */
#define SB_PATH_WORDS 128

/**
 * Words of 8 bytes in `sb_drive`.
 */
#define SB_DRIVE_WORDS 20

/**
 * Result of a call. 0 is success. A call that returns anything else has changed nothing, but that
 * a path keeps the rows before a refused one, and that `SB_STATUS_SATURATED` has written its
 * bytes. Values are never reused; later versions may add some.
 */
enum sb_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * The call was carried out.
     */
    SB_STATUS_OK = 0,
    /**
     * A pointer that must not be is NULL.
     */
    SB_STATUS_NULL = 1,
    /**
     * The storage is smaller than the object.
     */
    SB_STATUS_SIZE = 2,
    /**
     * A pointer is not a multiple of the alignment of what it must point to.
     */
    SB_STATUS_ALIGNMENT = 3,
    /**
     * The caller was compiled against another version of the header.
     */
    SB_STATUS_ABI = 4,
    /**
     * The object is not initialised, or its initialisation has failed.
     */
    SB_STATUS_NOT_INITIALISED = 5,
    /**
     * The method is not in this archive.
     */
    SB_STATUS_NOT_BUILT = 6,
    /**
     * A number is infinite, NaN or outside its range.
     */
    SB_STATUS_OUT_OF_RANGE = 7,
    /**
     * Exported constants are of another type, version or tick, or have changed.
     */
    SB_STATUS_NOT_PREPARED = 8,
    /**
     * The move exceeds a limit of the policy.
     */
    SB_STATUS_LIMIT = 9,
    /**
     * The move turns or bends the arm by more than the method was set up for.
     */
    SB_STATUS_TOO_FAST = 10,
    /**
     * No still move of that duration was found.
     */
    SB_STATUS_NOT_STILL = 11,
    /**
     * The axis takes no such request in its mode.
     */
    SB_STATUS_MODE = 12,
    /**
     * The hub turns, and the request is for one at rest.
     */
    SB_STATUS_MOVING = 13,
    /**
     * The queue has no room for the move.
     */
    SB_STATUS_QUEUE_FULL = 14,
    /**
     * The hub's motion has changed since the move was planned.
     */
    SB_STATUS_STALE = 15,
    /**
     * A row of a path came after the hub had begun to stop.
     */
    SB_STATUS_STARVED = 16,
    /**
     * A value did not fit the drive's format. The bytes are written, with the nearest that fits.
     */
    SB_STATUS_SATURATED = 17,
    /**
     * A setpoint is not finite, and was not encoded.
     */
    SB_STATUS_NOT_FINITE = 18,
    /**
     * A refusal of a kind that this version has no number for.
     */
    SB_STATUS_REFUSED = 19,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum sb_status sb_status;
#else
typedef int32_t sb_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Shape of a move from rest to rest.
 */
enum sb_profile
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Cubic polynomial; its acceleration jumps at both ends.
     */
    SB_PROFILE_CUBIC = 0,
    /**
     * Quintic polynomial.
     */
    SB_PROFILE_QUINTIC = 1,
    /**
     * Cycloid.
     */
    SB_PROFILE_CYCLOID = 2,
    /**
     * Constant acceleration, rate, deceleration; the acceleration jumps four times.
     */
    SB_PROFILE_TRAPEZOID = 3,
    /**
     * Seven stretches of constant jerk.
     */
    SB_PROFILE_S_CURVE = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum sb_profile sb_profile;
#else
typedef int32_t sb_profile;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Kind of a move.
 */
enum sb_kind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * From rest to rest at the angle `to`.
     */
    SB_KIND_TO = 0,
    /**
     * A smooth change of the rate to `rate`, which the hub then keeps.
     */
    SB_KIND_SPIN_UP = 1,
    /**
     * The hub keeps its rate.
     */
    SB_KIND_DWELL = 2,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum sb_kind sb_kind;
#else
typedef int32_t sb_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Method that advances an arm by one tick.
 */
enum sb_method
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Exact kinematics in two modes: the first choice for an arm that bends.
     */
    SB_METHOD_ELASTICA2 = 0,
    /**
     * One element and Newmark's rule, the paper's scheme: the cheapest that bends.
     */
    SB_METHOD_NEWMARK1 = 1,
    /**
     * An arm that does not bend.
     */
    SB_METHOD_RIGID = 2,
    /**
     * Small deflections in two modes.
     */
    SB_METHOD_MODAL2 = 3,
    /**
     * Exact kinematics in one mode.
     */
    SB_METHOD_ELASTICA1 = 4,
    /**
     * Exact kinematics in three modes.
     */
    SB_METHOD_ELASTICA3 = 5,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum sb_method sb_method;
#else
typedef int32_t sb_method;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Mode of an axis.
 */
enum sb_mode
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * The drive is off; setpoints stand still and are not to be sent.
     */
    SB_MODE_DISABLED = 0,
    /**
     * Follows moves, or holds.
     */
    SB_MODE_ENABLED = 1,
    /**
     * Brakes.
     */
    SB_MODE_STOPPING = 2,
    /**
     * Holds after a stop, until enabled again.
     */
    SB_MODE_STOPPED = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum sb_mode sb_mode;
#else
typedef int32_t sb_mode;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Reason why an axis stopped.
 */
enum sb_cause
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * It has not stopped since it was enabled.
     */
    SB_CAUSE_NONE = 0,
    /**
     * `sb_stop`.
     */
    SB_CAUSE_REQUESTED = 1,
    /**
     * `sb_heard` was not called for the patience.
     */
    SB_CAUSE_LINK_LOST = 2,
    /**
     * More ticks in a row were missed than are allowed.
     */
    SB_CAUSE_MISSED_TICKS = 3,
    /**
     * No state to follow for more ticks in a row than may be missed.
     */
    SB_CAUSE_FOLLOW_LOST = 4,
    /**
     * Another reason.
     */
    SB_CAUSE_OTHER = 5,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum sb_cause sb_cause;
#else
typedef int32_t sb_cause;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Storage of an arm under its policy. Its content is not for the caller. It may be static, on a
 * stack or in a heap, and need not be initialised to anything.
 */
typedef struct sb_arm {
    uint64_t words[SB_ARM_WORDS];
} sb_arm;

/**
 * Set-up of an arm. `abi`, `tick` and `acceleration` must be given; another field that is 0 is not
 * there.
 */
typedef struct sb_setup {
    /**
     * `SB_ABI`.
     */
    uint32_t abi;
    /**
     * Method that an arm is set up with from a scene, `SB_METHOD_...`. Constants name their own.
     */
    int32_t method;
    /**
     * Control period, s; 1e-6 to 1.
     */
    double tick;
    /**
     * Limit of the hub's rate, rad/s.
     */
    double rate;
    /**
     * Limit of its acceleration, rad/s^2. Must be given: a stop takes it.
     */
    double acceleration;
    /**
     * Limit of its deceleration, rad/s^2; 0: that of the acceleration.
     */
    double deceleration;
    /**
     * Limit of its jerk, rad/s^3. With it, moves whose acceleration jumps are refused.
     */
    double jerk;
    /**
     * Limit of the deceleration of a stop, rad/s^2, at least that of a move; 0: that of a move.
     */
    double stop_deceleration;
    /**
     * Limit of the jerk of a stop, rad/s^3; 0: that of a move.
     */
    double stop_jerk;
    /**
     * Limit of the hub's torque, N m. Of a planner of still moves only.
     */
    double torque;
    /**
     * Limit of the bending moment at the clamp, N m. Of a planner of still moves only.
     */
    double moment;
    /**
     * Share by which the arm's frequencies may be off, 0.01 to 0.3, in a planner set up from a
     * scene. 0: they are known.
     */
    double spread;
    /**
     * Greatest angle of the tip against the hub that elastica is fitted for from a scene, rad, to
     * 2. 0: what the limit of the acceleration makes it.
     */
    double bend;
    /**
     * Time without `sb_heard` after which the axis stops, s. 0 waits for ever.
     */
    double patience;
    /**
     * Ticks in a row that may be missed before the axis stops.
     */
    uint32_t missed;
    /**
     * 1: elastica from a scene takes two half-steps a tick, in place of one step.
     */
    uint32_t fine;
    /**
     * Function that keeps `sb_tick` out from here on, as by masking its interrupt. NULL: the
     * caller keeps other calls and `sb_tick` apart.
     */
    void (*lock)(void *context);
    /**
     * Function that lets `sb_tick` in again.
     */
    void (*unlock)(void *context);
    /**
     * Argument of both.
     */
    void *lock_context;
} sb_setup;

/**
 * An arm with a uniform link. A field that is 0 is not there: no payload, no damping, no gravity,
 * a clamp that does not give. A link that is not uniform is exported on the desktop.
 */
typedef struct sb_scene {
    /**
     * Length of the link from clamp to tip, m; 0.001 to 1000.
     */
    double length;
    /**
     * Mass of the link, kg; 1e-7 to 1e5.
     */
    double mass;
    /**
     * Bending stiffness EI of the link, N m^2; 1e-9 to 1e12.
     */
    double bending_stiffness;
    /**
     * Radius from the hub's axis to the clamp, m.
     */
    double hub_radius;
    /**
     * Inertia of the hub about its axis, kg m^2; of a carriage its mass, kg.
     */
    double hub_inertia;
    /**
     * Stiffness of the joint between hub and link, N m/rad; 0 is a rigid clamp.
     */
    double joint_stiffness;
    /**
     * Mass of the payload, kg.
     */
    double payload_mass;
    /**
     * Inertia of the payload about its own centre, kg m^2.
     */
    double payload_inertia;
    /**
     * Distance of the payload's centre beyond the tip, m.
     */
    double payload_offset;
    /**
     * Damping of absolute velocity, 1/s.
     */
    double damping_alpha;
    /**
     * Damping of the rate of deformation, s.
     */
    double damping_beta;
    /**
     * Damping of the joint alone, s.
     */
    double damping_joint;
    /**
     * Gravity, m/s^2; 0 is a horizontal plane of motion.
     */
    double gravity;
    /**
     * Lean of the plane of motion from the vertical, rad; 0 to pi/2.
     */
    double tilt;
    /**
     * Angle in the plane by which gravity is turned from global -Y, counter-clockwise, rad.
     */
    double gravity_direction;
    /**
     * 0: the hub turns. 1: it is a carriage on a linear axis; a metre then takes the place of a
     * radian everywhere, and a newton that of a newton metre.
     */
    uint32_t linear_axis;
    /**
     * Not used; 0.
     */
    uint32_t reserved;
} sb_scene;

/**
 * A move, from the end of the moves before it. Its duration is rounded to whole ticks.
 */
typedef struct sb_move_request {
    /**
     * `SB_KIND_...`.
     */
    int32_t kind;
    /**
     * Shape of a move to an angle, `SB_PROFILE_...`.
     */
    int32_t profile;
    /**
     * Duration, s.
     */
    double duration;
    /**
     * Hub angle at the end, rad; of a move to an angle.
     */
    double to;
    /**
     * Rate of the hub at the end, rad/s; of a spin-up.
     */
    double rate;
} sb_move_request;

/**
 * A move that was accepted.
 */
typedef struct sb_accepted {
    /**
     * Number of its first tick.
     */
    uint32_t begins;
    /**
     * Ticks that it takes.
     */
    uint32_t ticks;
} sb_accepted;

/**
 * A move in the shortest time, from the end of the moves before it, at rest or turning. Its bounds
 * lie within the limits of the arm's set-up.
 */
typedef struct sb_reach_request {
    /**
     * `SB_KIND_TO`: to the angle `to`. `SB_KIND_SPIN_UP`: to the rate, at any angle.
     */
    int32_t kind;
    /**
     * Hub angle at the end, rad; of a move to an angle.
     */
    double to;
    /**
     * Rate at the end, rad/s, which the hub then keeps. 0: it comes to rest.
     */
    double rate;
    /**
     * Bound of the rate, rad/s. Must be given.
     */
    double max_rate;
    /**
     * Bound of the acceleration, rad/s^2. 0: only the jerk is bound.
     */
    double max_acceleration;
    /**
     * Bound of the deceleration, rad/s^2; 0: that of the acceleration.
     */
    double max_deceleration;
    /**
     * Bound of the jerk, rad/s^3. 0: the acceleration may jump.
     */
    double max_jerk;
} sb_reach_request;

/**
 * Storage of a planner of still moves.
 */
typedef struct sb_planner {
    uint64_t words[SB_PLANNER_WORDS];
} sb_planner;

/**
 * Storage of a path.
 */
typedef struct sb_path {
    uint64_t words[SB_PATH_WORDS];
} sb_path;

/**
 * Row of a path. Where a rate is not given, the spline has the one that keeps the acceleration
 * continuous, and the last row is at rest.
 */
typedef struct sb_waypoint {
    /**
     * Time from the path's beginning, s; in whole ticks or not.
     */
    double time;
    /**
     * Hub angle, rad.
     */
    double angle;
    /**
     * Rate, rad/s, if `has_rate` is not 0.
     */
    double rate;
    /**
     * Acceleration, rad/s^2, if `has_acceleration` is not 0; of a quintic path only.
     */
    double acceleration;
    /**
     * 1 if the rate is given.
     */
    uint32_t has_rate;
    /**
     * 1 if the acceleration is given.
     */
    uint32_t has_acceleration;
} sb_waypoint;

/**
 * Progress of a path.
 */
typedef struct sb_progress {
    /**
     * Rows of this call that the path has taken. Offer the others again, when ticks have made
     * room.
     */
    uint32_t rows;
    /**
     * 1 if the axis has the whole path, up to its last row.
     */
    uint32_t done;
} sb_progress;

/**
 * Setpoint of the hub at one tick. Its angle is `turns + part` turns: the fraction is as fine
 * after a million turns as before the first. `sb_angle` gives radians.
 */
typedef struct sb_setpoint {
    /**
     * Number of the tick, from 0.
     */
    uint32_t number;
    /**
     * Mode of the axis at this tick, `SB_MODE_...`. The drive follows in every mode but disabled.
     */
    int32_t mode;
    /**
     * Reason of the latest stop, `SB_CAUSE_...`.
     */
    int32_t cause;
    /**
     * Whole turns of the hub angle.
     */
    int32_t turns;
    /**
     * The rest of the hub angle, turns, -1/2 to 1/2.
     */
    float part;
    /**
     * Rate, rad/s.
     */
    float rate;
    /**
     * Acceleration, rad/s^2; where it jumps, the value after the tick.
     */
    float acceleration;
    /**
     * Torque into the hub, N m.
     */
    float torque;
    /**
     * Tip in the hub frame along the link where it is clamped, m.
     */
    float tip_x;
    /**
     * Tip in the hub frame across the link, its deflection, m.
     */
    float tip_y;
} sb_setpoint;

/**
 * State of a hub that another program moves.
 */
typedef struct sb_hub {
    /**
     * Whole turns of the angle.
     */
    int32_t turns;
    /**
     * The rest of the angle, turns, -1/2 to 1/2.
     */
    float part;
    /**
     * Rate, rad/s.
     */
    float rate;
    /**
     * Acceleration, rad/s^2.
     */
    float acceleration;
} sb_hub;

/**
 * Storage of a drive.
 */
typedef struct sb_drive {
    uint64_t words[SB_DRIVE_WORDS];
} sb_drive;

/**
 * Gear and motor of an arm, and what its drive is told. `abi` must be given. A field that is 0 is
 * not there: a lossless direct drive without friction is all zeros.
 */
typedef struct sb_gear {
    /**
     * `SB_ABI`.
     */
    uint32_t abi;
    /**
     * Turns of the motor, to 65535 ...
     */
    uint32_t motor_turns;
    /**
     * ... in so many turns of the hub, to 65535; 0 in both is 1 : 1.
     */
    uint32_t hub_turns;
    /**
     * Efficiency of the gear, 0.01 to 1; 0 is lossless.
     */
    double efficiency;
    /**
     * Inertia of rotor and input shaft about the motor's axis, kg m^2.
     */
    double rotor_inertia;
    /**
     * Coulomb friction at the hub, N m.
     */
    double coulomb;
    /**
     * Viscous friction at the hub, N m s/rad.
     */
    double viscous;
    /**
     * Angle of the motor's shaft where the hub's is 0, turns.
     */
    double zero;
    /**
     * moteus: time without a setpoint after which the drive stops by itself, s; 0.001 to 10.
     */
    double watchdog;
    /**
     * CiA 402: rated torque of the motor, object 0x6076, N m.
     */
    double rated_torque;
    /**
     * CiA 402: increments of the encoder in a turn of the motor, 4 to 2^24.
     */
    uint32_t increments;
    /**
     * 1 if the motor turns against the hub.
     */
    uint32_t opposite;
    /**
     * Not used; 0.
     */
    uint32_t reserved;
} sb_gear;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Initialises an arm from constants that `stillbeam-sim export --c` has written. It is disabled
 * then, at hub angle 0.
 *
 * `bytes` is the size of the storage, `sizeof(sb_arm)`; less will do for some methods.
 * `setup.tick` must be the tick of the export, to the bit.
 *
 * # Safety
 * `arm` is NULL or points to `bytes` bytes, `words` is NULL or points to `count` words, `setup` is
 * NULL or points to a structure of the version that its first field names. Nothing else uses the
 * storage during the call.
 */
sb_status sb_init(struct sb_arm *arm,
                  size_t bytes,
                  const uint32_t *words,
                  size_t count,
                  const struct sb_setup *setup);

/**
 * Initialises an arm from its description, by `setup.method`. The same numbers come out as on the
 * desktop, after 10^5 to 10^8 instructions on a processor without double precision.
 *
 * # Safety
 * As of `sb_init`; `scene` is NULL or points to a scene.
 */
sb_status sb_init_scene(struct sb_arm *arm,
                        size_t bytes,
                        const struct sb_scene *scene,
                        const struct sb_setup *setup);

/**
 * Takes up another payload: the arm goes on as `other`, which was initialised for it, in the mode
 * and at the angle in which it is. Only while the hub rests and no move waits. `other` may be used
 * again or given up.
 *
 * # Safety
 * `arm` and `other` are NULL or point to storage of arms; no other call on them but `sb_tick` of
 * `arm` runs at the same time.
 */
sb_status sb_payload(struct sb_arm *arm, struct sb_arm *other);

/**
 * Switches on. A disabled axis begins at the measured hub angle, rad, without a step; a stopped
 * one goes on where it holds.
 *
 * # Safety
 * `arm` is NULL or points to storage of an arm; no other call on it but `sb_tick` runs at the same
 * time.
 */
sb_status sb_enable(struct sb_arm *arm, double measured);

/**
 * Plans a move behind the others; with none waiting it begins at the next tick. `sb_tick` is kept
 * out for some hundred instructions, not while the move is planned.
 *
 * # Safety
 * As of `sb_enable`; `motion` is NULL or points to a move, `accepted` is NULL or can be written.
 */
sb_status sb_move(struct sb_arm *arm,
                  const struct sb_move_request *motion,
                  struct sb_accepted *accepted);

/**
 * Meets a target from whatever the hub does now, by a quintic, `duration` s from the latest
 * setpoint: `angle`, rad, is where the target is at that setpoint, and it turns at `rate`, rad/s.
 * All moves are dropped. `sb_tick` is kept out for some thousand instructions.
 *
 * # Safety
 * As of `sb_enable`.
 */
sb_status sb_retarget(struct sb_arm *arm, double angle, double rate, double duration);

/**
 * Brakes along the path and holds; the axis stays enabled and takes moves. All moves are dropped.
 *
 * # Safety
 * As of `sb_enable`.
 */
sb_status sb_hold(struct sb_arm *arm);

/**
 * Brakes along the path and holds until enabled again; moves are refused. With `then_off` not 0
 * the axis is disabled as soon as it is at rest.
 *
 * # Safety
 * As of `sb_enable`.
 */
sb_status sb_stop(struct sb_arm *arm, uint32_t then_off);

/**
 * Notes a valid message from whoever commands the arm: see `sb_setup.patience`.
 *
 * # Safety
 * As of `sb_enable`.
 */
sb_status sb_heard(struct sb_arm *arm);

/**
 * Plans a move in the shortest time behind the others, as `sb_move` does a move of given duration.
 *
 * # Safety
 * As of `sb_enable`; `motion` is NULL or points to a move, `accepted` is NULL or can be written.
 */
sb_status sb_reach(struct sb_arm *arm,
                   const struct sb_reach_request *motion,
                   struct sb_accepted *accepted);

/**
 * Initialises a planner of still moves from the constants of `stillbeam-sim export --c --still`.
 * `setup` is that of the arm.
 *
 * # Safety
 * As of `sb_init`.
 */
sb_status sb_planner_init(struct sb_planner *planner,
                          size_t bytes,
                          const uint32_t *words,
                          size_t count,
                          const struct sb_setup *setup);

/**
 * Initialises a planner of still moves from the description of an arm.
 *
 * # Safety
 * As of `sb_init_scene`.
 */
sb_status sb_planner_init_scene(struct sb_planner *planner,
                                size_t bytes,
                                const struct sb_scene *scene,
                                const struct sb_setup *setup);

/**
 * Plans a move to the hub angle `to`, rad, after which the arm is at rest, in `duration` s, or
 * with 0 in the shortest time within the limits; then puts it behind the others. Takes 10^5 to
 * 10^8 instructions, all but some hundred of them with `sb_tick` let in.
 *
 * # Safety
 * As of `sb_move`; `planner` is NULL or points to storage of a planner that no other call uses.
 */
sb_status sb_still(struct sb_arm *arm,
                   struct sb_planner *planner,
                   double to,
                   double duration,
                   struct sb_accepted *accepted);

/**
 * Initialises a path from the end of the arm's moves on. With `cubic` not 0 its pieces are cubics,
 * whose ticks are the cheapest, else quintics, whose acceleration does not jump.
 *
 * # Safety
 * `path` is NULL or points to `bytes` bytes that nothing else uses during the call. `arm` as of
 * `sb_enable`.
 */
sb_status sb_path_init(struct sb_path *path, size_t bytes, struct sb_arm *arm, uint32_t cubic);

/**
 * Offers rows to a path, as many as it has room for, and hands those that are ready to the axis.
 * With `last` not 0 the path ends with the last of these rows. Call it again with the rows that
 * are left, or with none, while the arm moves. Behind the last row that the axis has there is
 * always a stop along the path, so that rows which come too late end in a stop.
 *
 * A row that is refused is named in the error text; rows before it are kept.
 *
 * # Safety
 * As of `sb_move`; `path` is NULL or points to storage of a path, `rows` is NULL or points to
 * `count` rows, `progress` is NULL or can be written.
 */
sb_status sb_waypoints(struct sb_arm *arm,
                       struct sb_path *path,
                       const struct sb_waypoint *rows,
                       size_t count,
                       uint32_t last,
                       struct sb_progress *progress);

/**
 * Writes the next setpoint. The call of the control interrupt: its work does not depend on what
 * waits, nor its speed on the flags that the caller is compiled with.
 *
 * # Safety
 * `arm` is NULL or points to storage of an arm. Nothing else uses the arm during the call: see
 * `sb_setup.lock`. `setpoint` is NULL or can be written.
 */
sb_status sb_tick(struct sb_arm *arm, struct sb_setpoint *setpoint);

/**
 * Writes the next setpoint of a hub that another program moves, in place of `sb_tick`. `hub` is
 * its state at this tick, NULL if none has come: the hub then keeps its acceleration, for as many
 * ticks in a row as may be missed, and stops after that. A state that no motion within the limits
 * leads to counts as none.
 *
 * # Safety
 * As of `sb_tick`; `hub` is NULL or points to a state.
 */
sb_status sb_follow(struct sb_arm *arm, const struct sb_hub *hub, struct sb_setpoint *setpoint);

/**
 * Notes that `ticks` ticks did not take place before the coming one; the path waits for them. More
 * than `sb_setup.missed` of them stop the axis. In the interrupt, before `sb_tick`.
 *
 * # Safety
 * As of `sb_tick`.
 */
sb_status sb_missed(struct sb_arm *arm, uint32_t ticks);

/**
 * Initialises a drive.
 *
 * # Safety
 * `drive` is NULL or points to `bytes` bytes that nothing else uses during the call. `gear` is
 * NULL or points to a structure of the version that its first field names.
 */
sb_status sb_drive_init(struct sb_drive *drive, size_t bytes, const struct sb_gear *gear);

/**
 * Writes the hub angle, rad, at which the motor's shaft is at `shaft` turns, as its encoder counts
 * them: what `sb_enable` is to be given.
 *
 * # Safety
 * `drive` is NULL or points to storage of a drive that no other call uses; `angle` is NULL or can
 * be written.
 */
sb_status sb_hub_angle(struct sb_drive *drive, double shaft, double *angle);

/**
 * Writes a setpoint as the 8 bytes of ODrive's Set_Input_Pos, whose CAN identifier is
 * `node << 5 | 0x0c`. A setpoint of a disabled axis is refused, as it is not to be sent. May be
 * called in the interrupt.
 *
 * # Safety
 * As of `sb_hub_angle`; `setpoint` is NULL or points to a setpoint, `payload` is NULL or 8 bytes
 * can be written.
 */
sb_status sb_odrive(struct sb_drive *drive, const struct sb_setpoint *setpoint, uint8_t *payload);

/**
 * Writes a setpoint as the 24 bytes of a moteus frame, CAN FD, to the servo's own identifier. The
 * drive stops by itself after `sb_gear.watchdog`, which must be given. Else as `sb_odrive`.
 *
 * # Safety
 * As of `sb_odrive`, with 24 bytes.
 */
sb_status sb_moteus(struct sb_drive *drive, const struct sb_setpoint *setpoint, uint8_t *payload);

/**
 * Writes a setpoint as the 10 bytes of CiA 402's cyclic synchronous position: objects 0x607A,
 * 0x60B1, 0x60B2. `sb_gear.increments` and `sb_gear.rated_torque` must be given. Else as
 * `sb_odrive`.
 *
 * # Safety
 * As of `sb_odrive`, with 10 bytes.
 */
sb_status sb_cia402(struct sb_drive *drive, const struct sb_setpoint *setpoint, uint8_t *payload);

/**
 * Writes why the latest refused call on `object` was refused, in one line: the field, its value,
 * what it must be, what would do. `object` is the first argument of that call: an arm, a planner,
 * a path or a drive, also one whose initialisation has failed. `status` is what it returned; where
 * the object keeps no reason of it, or is NULL, the text is that of the status alone.
 *
 * Returns the length of the whole text without its end, as `snprintf`; more than `size - 1` of it
 * is cut. 200 bytes hold most.
 *
 * # Safety
 * `object` is NULL or points to storage of an object on which no other call but `sb_tick` runs.
 * `buffer` is NULL or `size` bytes of it can be written.
 */
size_t sb_error_text(const void *object, int32_t status, char *buffer, size_t size);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* STILLBEAM_H */

/* Angle of a setpoint, rad. In double precision, so not for the interrupt of a small processor. */
static inline double sb_angle(const sb_setpoint *setpoint)
{
    return 6.283185307179586 * ((double)setpoint->turns + (double)setpoint->part);
}
