/* Every call once, in an order that makes sense: each setpoint as its bits, for the test to compare
 * with the core's own. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "stillbeam.h"

static sb_arm arm, other;
static sb_planner planner;
static sb_path path;
static sb_drive drive;

static void need(const void *object, sb_status status)
{
    char text[200];
    if (!status) return;
    sb_error_text(object, status, text, sizeof text);
    fprintf(stderr, "%s\n", text);
    exit(1);
}

static uint32_t bits(float value)
{
    uint32_t word;
    memcpy(&word, &value, sizeof word);
    return word;
}

static void print(const sb_setpoint *at)
{
    printf("%" PRIu32 " %" PRId32 " %" PRId32 " %" PRId32, at->number, at->mode, at->cause,
           at->turns);
    printf(" %08" PRIx32 " %08" PRIx32 " %08" PRIx32 " %08" PRIx32 " %08" PRIx32 " %08" PRIx32 "\n",
           bits(at->part), bits(at->rate), bits(at->acceleration), bits(at->torque),
           bits(at->tip_x), bits(at->tip_y));
}

static void tick(int count)
{
    for (int i = 0; i < count; i++) {
        sb_setpoint at;
        need(&arm, sb_heard(&arm));
        need(&arm, sb_tick(&arm, &at));
        print(&at);
    }
}

static void move(int32_t kind, int32_t profile, double duration, double to, double rate)
{
    const sb_move_request request = {kind, profile, duration, to, rate};
    sb_accepted accepted;
    need(&arm, sb_move(&arm, &request, &accepted));
    printf("accepted %" PRIu32 " %" PRIu32 "\n", accepted.begins, accepted.ticks);
}

static void reach(int32_t kind, double to, double rate)
{
    const sb_reach_request request = {.kind = kind,
                                      .to = to,
                                      .rate = rate,
                                      .max_rate = 6.0,
                                      .max_acceleration = 40.0,
                                      .max_deceleration = 30.0,
                                      .max_jerk = 2000.0};
    sb_accepted accepted;
    need(&arm, sb_reach(&arm, &request, &accepted));
    printf("accepted %" PRIu32 " %" PRIu32 "\n", accepted.begins, accepted.ticks);
}

/* Rows of a path in two calls, and in more where the queue is full. */
static void waypoints(void)
{
    enum { ROWS = 24 };
    sb_waypoint rows[ROWS] = {{0}};
    for (int i = 0; i < ROWS; i++) {
        rows[i].time = 0.055 * (i + 1);
        rows[i].angle = 0.02 * (i + 1) + 0.004 * (i % 3);
    }
    rows[4].has_rate = 1;
    rows[4].rate = 0.5;
    need(&path, sb_path_init(&path, sizeof path, &arm, 0));
    sb_progress progress;
    for (uint32_t offered = 0;;) {
        const uint32_t until = offered < 10 ? 10 : ROWS;
        need(&arm, sb_waypoints(&arm, &path, rows + offered, until - offered, until == ROWS,
                                &progress));
        offered += progress.rows;
        if (progress.done) break;
        tick(1);
    }
    tick(60);
}

/* A setpoint as the bytes of every drive, behind a gear that turns the other way. */
static void drives(void)
{
    const sb_gear gear = {.abi = SB_ABI,
                          .motor_turns = 50,
                          .hub_turns = 3,
                          .efficiency = 0.9,
                          .rotor_inertia = 1e-5,
                          .coulomb = 0.01,
                          .viscous = 0.001,
                          .zero = 0.125,
                          .watchdog = 0.1,
                          .rated_torque = 0.5,
                          .increments = 16384,
                          .opposite = 1};
    sb_setpoint at;
    uint8_t odrive[8], moteus[24], cia402[10];
    double angle;
    need(&drive, sb_drive_init(&drive, sizeof drive, &gear));
    need(&arm, sb_tick(&arm, &at));
    print(&at);
    need(&drive, sb_odrive(&drive, &at, odrive));
    need(&drive, sb_moteus(&drive, &at, moteus));
    need(&drive, sb_cia402(&drive, &at, cia402));
    need(&drive, sb_hub_angle(&drive, 3.7, &angle));
    printf("drives ");
    for (size_t i = 0; i < sizeof odrive; i++) printf("%02x", odrive[i]);
    for (size_t i = 0; i < sizeof moteus; i++) printf("%02x", moteus[i]);
    for (size_t i = 0; i < sizeof cia402; i++) printf("%02x", cia402[i]);
    printf(" %.17g\n", angle);
}

/* A hub that another program turns: an even acceleration from rest, a state that stays away, a stop. */
static void follow(float part)
{
    const float h = 0.010f, acceleration = 8.0f;
    sb_setpoint at;
    for (int k = 0; k < 20; k++) {
        const float t = h * (float)k;
        const sb_hub hub = {0, part + 0.5f * acceleration * t * t / 6.2831855f, acceleration * t,
                            acceleration};
        need(&arm, sb_heard(&arm));
        need(&arm, sb_follow(&arm, &hub, &at));
        print(&at);
    }
    for (int k = 0; k < 60; k++) {
        need(&arm, sb_follow(&arm, NULL, &at));
        print(&at);
    }
}

int main(void)
{
    sb_scene scene = {.length = 0.4,
                      .mass = 0.0224,
                      .bending_stiffness = 0.46,
                      .hub_radius = 0.02,
                      .joint_stiffness = 40.0,
                      .payload_mass = 0.030,
                      .damping_alpha = 0.05,
                      .damping_beta = 1e-4,
                      .gravity = 9.81};
    const sb_setup setup = {.abi = SB_ABI,
                            .tick = 0.010,
                            .rate = 15.0,
                            .acceleration = 80.0,
                            .patience = 0.2,
                            .missed = 2};

    need(&arm, sb_init_scene(&arm, sizeof arm, &scene, &setup));
    need(&planner, sb_planner_init_scene(&planner, sizeof planner, &scene, &setup));
    scene.payload_mass = 0.060;
    need(&other, sb_init_scene(&other, sizeof other, &scene, &setup));

    tick(2);
    need(&arm, sb_enable(&arm, 0.25));
    move(SB_KIND_TO, SB_PROFILE_TRAPEZOID, 0.4, 1.0, 0.0);
    move(SB_KIND_DWELL, 0, 0.1, 0.0, 0.0);
    move(SB_KIND_SPIN_UP, 0, 0.2, 0.0, 2.0);
    tick(80);
    need(&arm, sb_retarget(&arm, 0.5, 0.1, 0.4));
    tick(50);
    need(&arm, sb_hold(&arm));
    tick(30);
    drives();
    sb_accepted accepted;
    need(&arm, sb_still(&arm, &planner, 0.0, 0.5, &accepted));
    printf("accepted %" PRIu32 " %" PRIu32 "\n", accepted.begins, accepted.ticks);
    tick(60);
    waypoints();
    move(SB_KIND_TO, SB_PROFILE_S_CURVE, 0.5, 0.0, 0.0);
    tick(55);
    need(&arm, sb_payload(&arm, &other));
    tick(5);
    follow(0.0f);
    need(&arm, sb_enable(&arm, 0.0));
    reach(SB_KIND_TO, 0.8, 0.5);
    tick(50);
    reach(SB_KIND_SPIN_UP, 0.0, 0.0);
    tick(10);
    move(SB_KIND_TO, SB_PROFILE_CYCLOID, 0.5, 1.5, 0.0);
    tick(10);
    need(&arm, sb_missed(&arm, 3));
    tick(40);
    need(&arm, sb_stop(&arm, 1));
    tick(2);
    return 0;
}
