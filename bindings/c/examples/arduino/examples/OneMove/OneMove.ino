// One move of a prepared arm: setpoints to the serial line, every 10 ms.
#include <Arduino.h>

#include "arm.h" // stillbeam-sim export arm.toml --c arm.h
#include "stillbeam.h"

static sb_arm arm;
static uint32_t due;

// Says why a call was refused, and stops.
static void check(sb_status status)
{
    if (status == SB_STATUS_OK) return;
    char text[200];
    sb_error_text(&arm, status, text, sizeof text);
    Serial.println(text);
    for (;;) delay(1000);
}

void setup()
{
    Serial.begin(115200);
    sb_setup policy = {};
    policy.abi = SB_ABI;
    policy.tick = STILLBEAM_TICK;
    policy.rate = 15.0;
    policy.acceleration = 150.0;
    check(sb_init(&arm, sizeof arm, stillbeam_arms[0], STILLBEAM_ARM_WORDS, &policy));
    check(sb_enable(&arm, 0.0)); // in a machine, the angle that the encoder measures

    sb_move_request to = {};
    to.profile = static_cast<int32_t>(SB_PROFILE_QUINTIC);
    to.duration = 0.4;
    to.to = 1.57;
    check(sb_move(&arm, &to, nullptr));
    due = micros();
}

void loop()
{
    // The same phase for every tick, however long the one before took.
    if (static_cast<int32_t>(micros() - due) < 0) return;
    due += static_cast<uint32_t>(1e6 * STILLBEAM_TICK + 0.5);
    sb_setpoint at;
    check(sb_tick(&arm, &at));
    Serial.print(sb_angle(&at), 6);
    Serial.print(' ');
    Serial.println(at.torque, 6);
}
