/* What a caller can get wrong returns its status and says so; nothing is written beyond the
 * storage. Compiled with the address and the undefined-behaviour sanitizer. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "arm.h"
#include "stillbeam.h"

static int failures;

/* Objects between bytes that no call may touch. */
#define GUARDED(type, name)                                                                        \
    static struct {                                                                                \
        _Alignas(8) unsigned char before[64];                                                      \
        type object;                                                                               \
        unsigned char after[64];                                                                   \
    } name##_guarded;                                                                              \
    static type *const name = &name##_guarded.object

GUARDED(sb_arm, arm);
GUARDED(sb_arm, other);
GUARDED(sb_planner, planner);
GUARDED(sb_path, path);
GUARDED(sb_drive, drive);

static void untouched(const char *what, const unsigned char *guard)
{
    for (int i = 0; i < 64; i++) {
        if (guard[i] == 0xa5) continue;
        fprintf(stderr, "%s: a byte beside it was written\n", what);
        failures++;
        return;
    }
}

static void expect(int line, const void *object, sb_status is, sb_status needed, const char *begin)
{
    char text[200];
    const size_t length = sb_error_text(object, is, text, sizeof text);
    if (is != needed) {
        fprintf(stderr, "line %d: status %d, must be %d: %s\n", line, (int)is, (int)needed, text);
        failures++;
    } else if (strncmp(text, begin, strlen(begin)) != 0 || strchr(text, '\n') || !length) {
        fprintf(stderr, "line %d: \"%s\" does not begin with \"%s\"\n", line, text, begin);
        failures++;
    }
}

#define EXPECT(object, call, status, begin) expect(__LINE__, object, call, SB_STATUS_##status, begin)
#define MUST(object, call) EXPECT(object, call, OK, "ok")

static const sb_setup SETUP = {.abi = SB_ABI,
                               .tick = STILLBEAM_TICK,
                               .rate = 15.0,
                               .acceleration = 150.0,
                               .missed = 2};
static const sb_scene SCENE = {.length = 0.4, .mass = 0.0224, .bending_stiffness = 0.46};
static const sb_move_request MOVE = {.profile = SB_PROFILE_QUINTIC, .duration = 0.4, .to = 1.0};
static const sb_reach_request REACH = {.to = 1.0, .max_rate = 5.0, .max_acceleration = 40.0};

static sb_status init(sb_arm *to, const sb_setup *setup)
{
    return sb_init(to, sizeof *to, stillbeam_arms[0], STILLBEAM_ARM_WORDS, setup);
}

/* Storage: NULL, misaligned, too small by any amount. */
static void storage(void)
{
    const uint32_t *words = stillbeam_arms[0];
    const size_t count = STILLBEAM_ARM_WORDS;
    EXPECT(NULL, sb_init(NULL, sizeof *arm, words, count, &SETUP), NULL, "pointer = NULL");
    sb_arm *odd = (sb_arm *)(void *)((unsigned char *)arm + 1);
    EXPECT(NULL, sb_init(odd, sizeof *arm - 8, words, count, &SETUP), ALIGNMENT, "pointer = mis");
    EXPECT(NULL, sb_init(arm, 0, words, count, &SETUP), SIZE, "bytes = too few");
    EXPECT(arm, sb_init(arm, 1000, words, count, &SETUP), SIZE, "arm.bytes = 1000: must be at");
    EXPECT(arm, sb_tick(arm, NULL), NOT_INITIALISED, "object = not initialised");
    EXPECT(path, sb_path_init(path, 100, arm, 0), SIZE, "path.bytes = 100: must be at least");
    EXPECT(planner, sb_planner_init(planner, 100, words, count, &SETUP), SIZE, "planner.bytes = 100");
    const sb_gear gear = {.abi = SB_ABI};
    EXPECT(drive, sb_drive_init(drive, 88, &gear), SIZE, "drive.bytes = 88");
    /* The least storage that will do, on the heap, where the sanitizer looks at both of its ends. */
    for (size_t bytes = 8;; bytes += 8) {
        sb_arm *least = malloc(bytes);
        const sb_status status = sb_init(least, bytes, words, count, &SETUP);
        if (status == SB_STATUS_OK) {
            sb_setpoint at;
            MUST(least, sb_enable(least, 0.0));
            MUST(least, sb_move(least, &MOVE, NULL));
            for (int k = 0; k < 50; k++) MUST(least, sb_tick(least, &at));
            free(least);
            break;
        }
        if (status != SB_STATUS_SIZE || bytes > sizeof *arm) {
            EXPECT(least, status, SIZE, "arm.bytes");
            free(least);
            break;
        }
        free(least);
    }
}

/* Objects that are not initialised, whatever lies in them. */
static void not_initialised(int pattern)
{
    const sb_hub hub = {0, 0.0f, 0.0f, 0.0f};
    sb_setpoint at = {0};
    double angle;
    uint8_t bytes[8];
    memset(arm, pattern, sizeof *arm);
    memset(planner, pattern, sizeof *planner);
    memset(path, pattern, sizeof *path);
    memset(drive, pattern, sizeof *drive);
    const char *text = "object = not initialised: call its init function first";
    EXPECT(arm, sb_enable(arm, 0.0), NOT_INITIALISED, text);
    EXPECT(arm, sb_move(arm, &MOVE, NULL), NOT_INITIALISED, text);
    EXPECT(arm, sb_reach(arm, &REACH, NULL), NOT_INITIALISED, text);
    EXPECT(arm, sb_still(arm, planner, 0.0, 0.0, NULL), NOT_INITIALISED, text);
    EXPECT(arm, sb_waypoints(arm, path, NULL, 0, 0, NULL), NOT_INITIALISED, text);
    EXPECT(arm, sb_retarget(arm, 0.0, 0.0, 1.0), NOT_INITIALISED, text);
    EXPECT(arm, sb_hold(arm), NOT_INITIALISED, text);
    EXPECT(arm, sb_stop(arm, 0), NOT_INITIALISED, text);
    EXPECT(arm, sb_heard(arm), NOT_INITIALISED, text);
    EXPECT(arm, sb_missed(arm, 1), NOT_INITIALISED, text);
    EXPECT(arm, sb_tick(arm, &at), NOT_INITIALISED, text);
    EXPECT(arm, sb_follow(arm, &hub, &at), NOT_INITIALISED, text);
    EXPECT(arm, sb_payload(arm, other), NOT_INITIALISED, text);
    EXPECT(drive, sb_hub_angle(drive, 0.0, &angle), NOT_INITIALISED, text);
    EXPECT(drive, sb_odrive(drive, &at, bytes), NOT_INITIALISED, text);
    EXPECT(path, sb_path_init(path, sizeof *path, arm, 0), NOT_INITIALISED, "arm = not initialised");
}

/* NULL in every place, for an arm that is there and for none. */
static void null(void)
{
    sb_setpoint at = {0};
    const sb_gear gear = {.abi = SB_ABI};
    EXPECT(NULL, sb_enable(NULL, 0.0), NULL, "pointer = NULL");
    EXPECT(NULL, sb_move(NULL, &MOVE, NULL), NULL, "pointer = NULL");
    EXPECT(NULL, sb_tick(NULL, &at), NULL, "pointer = NULL");
    EXPECT(NULL, sb_follow(NULL, NULL, &at), NULL, "pointer = NULL");
    EXPECT(NULL, sb_missed(NULL, 1), NULL, "pointer = NULL");
    EXPECT(NULL, sb_payload(NULL, NULL), NULL, "pointer = NULL");
    EXPECT(arm, init(arm, NULL), NULL, "setup = NULL");
    EXPECT(arm, sb_init(arm, sizeof *arm, NULL, 8, &SETUP), NULL, "words = NULL");
    EXPECT(arm, sb_init_scene(arm, sizeof *arm, NULL, &SETUP), NULL, "scene = NULL");
    EXPECT(drive, sb_drive_init(drive, sizeof *drive, NULL), NULL, "gear = NULL");
    MUST(arm, init(arm, &SETUP));
    MUST(arm, sb_enable(arm, 0.0));
    EXPECT(arm, sb_move(arm, NULL, NULL), NULL, "move = NULL");
    EXPECT(arm, sb_still(arm, NULL, 0.0, 0.0, NULL), NULL, "planner = NULL");
    EXPECT(arm, sb_waypoints(arm, NULL, NULL, 0, 0, NULL), NULL, "path = NULL");
    EXPECT(arm, sb_payload(arm, NULL), NULL, "arm = NULL");
    MUST(arm, sb_tick(arm, NULL));
    MUST(drive, sb_drive_init(drive, sizeof *drive, &gear));
    EXPECT(drive, sb_odrive(drive, NULL, NULL), NULL, "setpoint = NULL");
    MUST(arm, sb_tick(arm, &at));
    EXPECT(drive, sb_odrive(drive, &at, NULL), NULL, "payload = NULL");
}

/* Constants of another arm, version, tick; another header; a method that is not there. */
static void constants(void)
{
    uint32_t words[STILLBEAM_ARM_WORDS];
    const size_t count = STILLBEAM_ARM_WORDS;
    sb_setup setup = SETUP;
#define CHANGED(index, value)                                                                      \
    (memcpy(words, stillbeam_arms[0], sizeof words), words[index] = (value),                       \
     sb_init(arm, sizeof *arm, words, count, &SETUP))
    EXPECT(arm, CHANGED(0, 1), NOT_PREPARED, "arm.magic = 0x00000001: must be");
    EXPECT(arm, CHANGED(1, 99), NOT_PREPARED, "arm.format = 0x00000063: must be");
    EXPECT(arm, CHANGED(2, 0x61646f6d), NOT_BUILT, "method = 0x61646f6d: must be one in this");
    EXPECT(arm, CHANGED(20, 7), NOT_PREPARED, "arm.checksum = ");
    EXPECT(arm, sb_init(arm, sizeof *arm, words, count - 1, &SETUP), NOT_PREPARED, "arm.length = ");
    EXPECT(arm, sb_init(arm, sizeof *arm, words, 0, &SETUP), NOT_PREPARED, "arm.magic = ");
    setup.tick = 0.02;
    EXPECT(arm, init(arm, &setup), OUT_OF_RANGE, "arm.tick = 0.01: must be 0.02 s");
    setup = SETUP;
    setup.abi = SB_ABI + 1;
    EXPECT(arm, init(arm, &setup), ABI, "setup.abi = 2: must be 1");
    setup = SETUP;
    setup.acceleration = 0.0;
    EXPECT(arm, init(arm, &setup), OUT_OF_RANGE, "limits.acceleration = inf: must be");
    setup = SETUP;
    setup.patience = -1.0;
    EXPECT(arm, init(arm, &setup), OUT_OF_RANGE, "policy.patience = -1: must be");
    setup = SETUP;
    setup.method = SB_METHOD_RIGID;
    EXPECT(arm, sb_init_scene(arm, sizeof *arm, &SCENE, &setup), NOT_BUILT, "method = ");
    setup.method = -5;
    EXPECT(arm, sb_init_scene(arm, sizeof *arm, &SCENE, &setup), NOT_BUILT, "method = ");
    sb_scene scene = SCENE;
    scene.length = -0.4;
    EXPECT(arm, sb_init_scene(arm, sizeof *arm, &scene, &SETUP), OUT_OF_RANGE,
           "link.length = -0.4: must be 0.001 to 1000 m");
    EXPECT(planner,
           sb_planner_init(planner, sizeof *planner, stillbeam_arms[0], count, &SETUP), NOT_PREPARED,
           "arm.method = ");
    EXPECT(arm, sb_tick(arm, NULL), NOT_INITIALISED, "object = not initialised");
}

/* Calls out of order, and numbers out of range, on an arm that is there. */
static void requests(void)
{
    sb_setpoint at;
    sb_move_request move = MOVE;
    MUST(arm, init(arm, &SETUP));
    EXPECT(arm, sb_move(arm, &MOVE, NULL), MODE, "mode = Disabled: enable the axis first");
    EXPECT(arm, sb_hold(arm), MODE, "mode = Disabled: enable");
    EXPECT(arm, sb_retarget(arm, 0.0, 0.0, 1.0), MODE, "mode = Disabled: enable");
    EXPECT(path, sb_path_init(path, sizeof *path, arm, 0), MODE, "mode = Disabled: enable");
    EXPECT(arm, sb_enable(arm, (double)NAN), OUT_OF_RANGE, "measured = NaN: must be -1000000 to");
    MUST(arm, sb_enable(arm, 0.0));
    move.kind = 7;
    EXPECT(arm, sb_move(arm, &move, NULL), OUT_OF_RANGE, "move.kind = 7: must be 0 to 2");
    move = MOVE;
    move.profile = -1;
    EXPECT(arm, sb_move(arm, &move, NULL), OUT_OF_RANGE, "move.profile = -1: must be 0 to 4");
    move = MOVE;
    move.duration = (double)NAN;
    EXPECT(arm, sb_move(arm, &move, NULL), OUT_OF_RANGE, "move.duration = NaN: must be");
    move.duration = 0.05;
    EXPECT(arm, sb_move(arm, &move, NULL), LIMIT, "limits.rate: the move needs");
    sb_reach_request reach = REACH;
    EXPECT(arm, sb_reach(arm, NULL, NULL), NULL, "reach = NULL");
    reach.kind = 2;
    EXPECT(arm, sb_reach(arm, &reach, NULL), OUT_OF_RANGE, "reach.kind = 2: must be 0 to 1");
    reach = REACH;
    reach.max_rate = 0.0;
    EXPECT(arm, sb_reach(arm, &reach, NULL), OUT_OF_RANGE, "bounds.rate = 0: must be");
    reach = REACH;
    reach.rate = 2.0 * reach.max_rate;
    EXPECT(arm, sb_reach(arm, &reach, NULL), LIMIT, "limits.rate");
    EXPECT(arm, sb_retarget(arm, (double)INFINITY, 0.0, 1.0), OUT_OF_RANGE, "target.angle = inf");
    EXPECT(arm, sb_retarget(arm, 0.0, (double)NAN, 1.0), OUT_OF_RANGE, "target.rate = NaN");
    for (int i = 0; i < 8; i++) {
        move = MOVE;
        move.to = i % 2 ? 0.0 : 1.0;
        MUST(arm, sb_move(arm, &move, NULL));
    }
    EXPECT(arm, sb_move(arm, &MOVE, NULL), QUEUE_FULL, "moves: this one takes 1 segments");
    for (int k = 0; k < 10; k++) MUST(arm, sb_tick(arm, &at));
    MUST(other, init(other, &SETUP));
    EXPECT(arm, sb_payload(arm, other), MOVING, "hub = turning: must be at rest");
    MUST(arm, sb_stop(arm, 0));
    EXPECT(arm, sb_enable(arm, 0.0), MODE, "mode = Stopping: wait until it is at rest");
    EXPECT(arm, sb_move(arm, &MOVE, NULL), MODE, "mode = Stopping");
    for (int k = 0; k < 50; k++) MUST(arm, sb_tick(arm, &at));
    MUST(arm, sb_enable(arm, 0.0));
    MUST(path, sb_path_init(path, sizeof *path, arm, 0));
    MUST(arm, sb_move(arm, &MOVE, NULL));
    const sb_waypoint rows[] = {{.time = 0.2, .angle = 0.5}, {.time = 0.1, .angle = 0.6}};
    EXPECT(arm, sb_waypoints(arm, path, rows, 1, 1, NULL), STALE, "waypoints[0]: move = planned");
    MUST(path, sb_path_init(path, sizeof *path, arm, 0));
    EXPECT(arm, sb_waypoints(arm, path, rows, 2, 1, NULL), OUT_OF_RANGE,
           "waypoints[1]: waypoint.time = 0.1");
    /* An object of another type is none of this. */
    EXPECT(arm, sb_still(arm, (sb_planner *)(void *)path, 0.0, 0.0, NULL), NOT_INITIALISED,
           "planner = not initialised");
}

/* A drive: what is not sent, what does not fit, a buffer that is too small. */
static void drives(void)
{
    sb_gear gear = {.abi = SB_ABI, .motor_turns = 65535, .hub_turns = 1};
    sb_setpoint at;
    uint8_t bytes[24];
    MUST(arm, init(arm, &SETUP));
    MUST(arm, sb_tick(arm, &at));
    MUST(drive, sb_drive_init(drive, sizeof *drive, &gear));
    EXPECT(drive, sb_odrive(drive, &at, bytes), MODE, "mode = Disabled");
    MUST(arm, sb_enable(arm, 0.0));
    MUST(arm, sb_move(arm, &MOVE, NULL));
    for (int k = 0; k < 20; k++) MUST(arm, sb_tick(arm, &at));
    EXPECT(drive, sb_odrive(drive, &at, bytes), SATURATED, "drive.velocity = beyond");
    EXPECT(drive, sb_moteus(drive, &at, bytes), OUT_OF_RANGE, "drive.watchdog = 0: must be");
    EXPECT(drive, sb_cia402(drive, &at, bytes), OUT_OF_RANGE, "drive.increments = 0: must be");
    at.torque = NAN;
    EXPECT(drive, sb_odrive(drive, &at, bytes), NOT_FINITE, "setpoint = not finite");
    EXPECT(drive, sb_hub_angle(drive, (double)NAN, NULL), OUT_OF_RANGE, "shaft = NaN: must be");
    gear.motor_turns = 70000;
    EXPECT(drive, sb_drive_init(drive, sizeof *drive, &gear), OUT_OF_RANGE,
           "gear.motor_turns = 70000: must be 1 to 65535 turns");
    gear = (sb_gear){.abi = 9};
    EXPECT(drive, sb_drive_init(drive, sizeof *drive, &gear), ABI, "gear.abi = 9: must be 1");
}

/* Text: no buffer, one that is too small, a status of nobody. */
static void texts(void)
{
    char small[8], whole[200];
    sb_setup setup = SETUP;
    setup.tick = -1.0;
    const sb_status status = sb_init_scene(arm, sizeof *arm, &SCENE, &setup);
    const size_t length = sb_error_text(arm, status, whole, sizeof whole);
    if (length != strlen(whole) || sb_error_text(arm, status, small, sizeof small) != length ||
        strlen(small) != 7 || strncmp(small, whole, 7) != 0 ||
        sb_error_text(arm, status, NULL, 100) != length ||
        sb_error_text(arm, status, small, 0) != length) {
        fprintf(stderr, "a text is not cut as snprintf would: \"%s\" \"%s\"\n", small, whole);
        failures++;
    }
    sb_error_text(arm, (sb_status)-3, whole, sizeof whole);
    if (strncmp(whole, "status = unknown", 16) != 0) failures++;
}

int main(void)
{
    memset(&arm_guarded, 0xa5, sizeof arm_guarded);
    memset(&other_guarded, 0xa5, sizeof other_guarded);
    memset(&planner_guarded, 0xa5, sizeof planner_guarded);
    memset(&path_guarded, 0xa5, sizeof path_guarded);
    memset(&drive_guarded, 0xa5, sizeof drive_guarded);
    storage();
    not_initialised(0x00);
    not_initialised(0xff);
    null();
    constants();
    requests();
    drives();
    texts();
    untouched("arm", arm_guarded.before), untouched("arm", arm_guarded.after);
    untouched("other", other_guarded.before), untouched("other", other_guarded.after);
    untouched("planner", planner_guarded.before), untouched("planner", planner_guarded.after);
    untouched("path", path_guarded.before), untouched("path", path_guarded.after);
    untouched("drive", drive_guarded.before), untouched("drive", drive_guarded.after);
    return failures ? 1 : 0;
}
