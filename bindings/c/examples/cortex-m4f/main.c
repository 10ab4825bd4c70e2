/* One move of a prepared arm on a bare Cortex-M4F, without a C library.
 *
 * `board_send` stands for the bus of a machine: here it hands the setpoint and the bytes for the
 * drive to the emulator. In a machine `control` is the handler of a timer's interrupt, and `lock`
 * masks that interrupt.
 */
#include "../arm.h" /* stillbeam-sim export arm.toml --c arm.h */
#include "board.h"
#include "stillbeam.h"

static sb_arm arm;
static sb_drive drive;

/* What goes out at a tick. */
struct record {
    sb_setpoint at;
    uint8_t odrive[8];
};

static void lock(void *context)
{
    (void)context;
    __asm volatile("cpsid i" ::: "memory");
}

static void unlock(void *context)
{
    (void)context;
    __asm volatile("cpsie i" ::: "memory");
}

/* The tick: the next setpoint, as bytes for the drive. */
static int control(void)
{
    struct record record;
    if (sb_tick(&arm, &record.at)) return 1;
    if (sb_odrive(&drive, &record.at, record.odrive)) return 1;
    board_send(&record, sizeof record);
    return 0;
}

int main(void)
{
    static const sb_setup setup = {.abi = SB_ABI,
                                   .tick = STILLBEAM_TICK,
                                   .rate = 15.0,
                                   .acceleration = 150.0,
                                   .patience = 10.0,
                                   .missed = 2,
                                   .lock = lock,
                                   .unlock = unlock};
    static const sb_gear gear = {.abi = SB_ABI, .motor_turns = 6};
    static const sb_move_request to = {
        .profile = SB_PROFILE_QUINTIC, .duration = 0.4, .to = 1.57};
    sb_accepted accepted;

    if (sb_init(&arm, sizeof arm, stillbeam_arms[0], STILLBEAM_ARM_WORDS, &setup)) return 1;
    if (sb_drive_init(&drive, sizeof drive, &gear)) return 2;
    if (sb_enable(&arm, 0.0)) return 3;
    if (sb_move(&arm, &to, &accepted)) return 4;
    for (uint32_t k = 0; k <= accepted.ticks + 20; k++) {
        if (control()) return 5;
    }
    return 0;
}
