// Of Arduino's core only what the sketch takes, with its types: for compiling, not for running.
#pragma once
#include <stddef.h>
#include <stdint.h>
struct SerialStub {
    void begin(unsigned long);
    size_t print(char);
    size_t print(double, int = 2);
    size_t println(const char *);
    size_t println(double, int = 2);
};
extern SerialStub Serial;
unsigned long micros();
void delay(unsigned long);
void setup();
void loop();
