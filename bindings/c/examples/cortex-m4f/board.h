/* The board: here QEMU's mps2-an386, which writes what it is sent to the standard output. */
#ifndef BOARD_H
#define BOARD_H

/* Sends bytes. */
void board_send(const void *bytes, unsigned length);

/* Ends the program with an exit code. */
_Noreturn void board_exit(int code);

#endif
