/* One move of a prepared arm, on the desktop: setpoints as CSV, with the bytes for an ODrive.
 *
 *     cc main.c -I ../../include -I .. ARCHIVE -o main && ./main
 */
#include <inttypes.h>
#include <stdio.h>

#include "arm.h" /* stillbeam-sim export arm.toml --c arm.h */
#include "stillbeam.h"

static sb_arm arm;
static sb_drive drive;

/* Says why a call on an object was refused. */
static int refused(const void *object, sb_status status)
{
    char text[200];
    sb_error_text(object, status, text, sizeof text);
    fprintf(stderr, "%s\n", text);
    return 1;
}

int main(void)
{
    const sb_setup setup = {
        .abi = SB_ABI, .tick = STILLBEAM_TICK, .rate = 15.0, .acceleration = 150.0};
    const sb_gear gear = {.abi = SB_ABI, .motor_turns = 6};
    const sb_move_request to = {.profile = SB_PROFILE_QUINTIC, .duration = 0.4, .to = 1.57};
    sb_accepted accepted;
    sb_status status;

    if ((status = sb_init(&arm, sizeof arm, stillbeam_arms[0], STILLBEAM_ARM_WORDS, &setup)))
        return refused(&arm, status);
    if ((status = sb_drive_init(&drive, sizeof drive, &gear))) return refused(&drive, status);
    /* In a machine, the angle that the encoder measures: sb_hub_angle. */
    if ((status = sb_enable(&arm, 0.0))) return refused(&arm, status);
    if ((status = sb_move(&arm, &to, &accepted))) return refused(&arm, status);

    printf("number,turns,part,rate,acceleration,torque,tip_x,tip_y,odrive\n");
    for (uint32_t k = 0; k <= accepted.ticks + 20; k++) {
        sb_setpoint at;
        uint8_t bytes[8];
        if ((status = sb_tick(&arm, &at))) return refused(&arm, status);
        if ((status = sb_odrive(&drive, &at, bytes))) return refused(&drive, status);
        /* Nine digits give back every bit of a float. */
        printf("%" PRIu32 ",%" PRId32 ",%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,", at.number, at.turns,
               at.part, at.rate, at.acceleration, at.torque, at.tip_x, at.tip_y);
        for (int i = 0; i < 8; i++) printf("%02x", bytes[i]);
        printf("\n");
    }
    return 0;
}
