// The same move as main.c, in C++: an arm as a class whose refusals are exceptions.
//
//     c++ -std=c++11 main.cpp -I ../../include -I .. ARCHIVE -o main && ./main
#include <cstdio>
#include <stdexcept>

#include "arm.h" // stillbeam-sim export arm.toml --c arm.h
#include "stillbeam.h"

// Throws why a call on an object was refused.
static void check(const void *object, sb_status status)
{
    if (status == SB_STATUS_OK) return;
    char text[200];
    sb_error_text(object, status, text, sizeof text);
    throw std::runtime_error(text);
}

class Arm {
public:
    explicit Arm(const sb_setup &setup)
    {
        check(&arm_, sb_init(&arm_, sizeof arm_, stillbeam_arms[0], STILLBEAM_ARM_WORDS, &setup));
    }

    void enable(double measured) { check(&arm_, sb_enable(&arm_, measured)); }

    sb_accepted move(const sb_move_request &request)
    {
        sb_accepted accepted;
        check(&arm_, sb_move(&arm_, &request, &accepted));
        return accepted;
    }

    sb_setpoint tick()
    {
        sb_setpoint at;
        check(&arm_, sb_tick(&arm_, &at));
        return at;
    }

private:
    sb_arm arm_;
};

static int run()
{
    sb_setup setup = {};
    setup.abi = SB_ABI;
    setup.tick = STILLBEAM_TICK;
    setup.rate = 15.0;
    setup.acceleration = 150.0;
    Arm arm(setup);

    sb_gear gear = {};
    gear.abi = SB_ABI;
    gear.motor_turns = 6;
    sb_drive drive;
    check(&drive, sb_drive_init(&drive, sizeof drive, &gear));

    sb_move_request to = {};
    to.profile = static_cast<int32_t>(SB_PROFILE_QUINTIC);
    to.duration = 0.4;
    to.to = 1.57;
    arm.enable(0.0);
    const sb_accepted accepted = arm.move(to);

    std::printf("number,turns,part,rate,acceleration,torque,tip_x,tip_y,odrive\n");
    for (uint32_t k = 0; k <= accepted.ticks + 20; k++) {
        const sb_setpoint at = arm.tick();
        uint8_t bytes[8];
        check(&drive, sb_odrive(&drive, &at, bytes));
        // Nine digits give back every bit of a float.
        std::printf("%lu,%ld,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,", static_cast<unsigned long>(at.number),
                    static_cast<long>(at.turns), at.part, at.rate, at.acceleration, at.torque,
                    at.tip_x, at.tip_y);
        for (uint8_t byte : bytes) std::printf("%02x", byte);
        std::printf("\n");
    }
    return 0;
}

int main()
{
    try {
        return run();
    } catch (const std::exception &refused) {
        std::fprintf(stderr, "%s\n", refused.what());
        return 1;
    }
}
