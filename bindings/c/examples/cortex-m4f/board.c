/* Start-up and semihosting of a Cortex-M4F in QEMU: no C library, no vendor's files. */
#include <stdint.h>

#include "board.h"

int main(void);

extern uint32_t __data_start, __data_end, __data_load, __bss_start, __bss_end, __stack_top;

/* Semihosting operations, "Semihosting for AArch32 and AArch64", Arm 100863. */
enum { SYS_OPEN = 0x01, SYS_WRITE = 0x05, SYS_EXIT_EXTENDED = 0x20 };
enum { MODE_WRITE = 4, APPLICATION_EXIT = 0x20026 };

static uint32_t semihosting(uint32_t operation, const void *arguments)
{
    register uint32_t r0 __asm("r0") = operation;
    register const void *r1 __asm("r1") = arguments;
    __asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

void board_send(const void *bytes, unsigned length)
{
    static uint32_t output;
    if (!output) {
        static const char standard[] = ":tt";
        const uint32_t open[] = {(uint32_t)standard, MODE_WRITE, sizeof standard - 1};
        output = semihosting(SYS_OPEN, open);
    }
    const uint32_t write[] = {output, (uint32_t)bytes, length};
    if (semihosting(SYS_WRITE, write)) board_exit(100);
}

_Noreturn void board_exit(int code)
{
    const uint32_t exit[] = {APPLICATION_EXIT, (uint32_t)code};
    for (;;) semihosting(SYS_EXIT_EXTENDED, exit);
}

/* A fault of the processor ends the run. */
static void fault(void)
{
    board_exit(102);
}

static _Noreturn void reset(void)
{
    /* Coprocessor access control: the FPU on, before the first float. */
    *(volatile uint32_t *)0xe000ed88 |= 0xfu << 20;
    __asm volatile("dsb\n\tisb" ::: "memory");
    for (uint32_t *to = &__data_start, *from = &__data_load; to < &__data_end;) *to++ = *from++;
    for (uint32_t *to = &__bss_start; to < &__bss_end;) *to++ = 0;
    board_exit(main());
}

/* The processor's own exceptions: stack, reset, NMI, faults. */
__attribute__((section(".vectors"), used)) static const void *const vectors[] = {
    &__stack_top, (void *)reset, (void *)fault, (void *)fault,
    (void *)fault, (void *)fault, (void *)fault,
};
