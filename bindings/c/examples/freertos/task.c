/* An arm in two FreeRTOS tasks: a control task of high priority that ticks, and a planner of low
 * priority that takes requests from a queue. `task.h`, `queue.h` are FreeRTOS's own.
 */
#include "FreeRTOS.h"
#include "queue.h"
#include "task.h"

#include "../arm.h" /* stillbeam-sim export arm.toml --c arm.h */
#include "stillbeam.h"

/* The machine's own: the shaft's angle in turns as its drive reports it, and the drive's bus. */
double machine_shaft(void);
void machine_send(const uint8_t *payload, size_t length);
void machine_log(const char *text);

static sb_arm arm;
static sb_drive drive;
static QueueHandle_t requests;

/* Keeps the control task out: planning runs with it let in, but for some hundred instructions. */
static void lock(void *context)
{
    (void)context;
    taskENTER_CRITICAL();
}

static void unlock(void *context)
{
    (void)context;
    taskEXIT_CRITICAL();
}

static void log_refusal(const void *object, sb_status status)
{
    char text[200];
    sb_error_text(object, status, text, sizeof text);
    machine_log(text);
}

/* A tick every STILLBEAM_TICK seconds, in a fixed phase. */
static void control(void *argument)
{
    (void)argument;
    const TickType_t period = pdMS_TO_TICKS((TickType_t)(1000.0 * STILLBEAM_TICK + 0.5));
    TickType_t last = xTaskGetTickCount();
    for (;;) {
        sb_setpoint at;
        uint8_t payload[8];
        vTaskDelayUntil(&last, period);
        if (sb_tick(&arm, &at)) continue;
        /* A disabled axis has no setpoint to send. */
        if (at.mode == SB_MODE_DISABLED) continue;
        const sb_status sent = sb_odrive(&drive, &at, payload);
        if (sent == SB_STATUS_OK || sent == SB_STATUS_SATURATED) machine_send(payload, sizeof payload);
    }
}

/* Takes moves from whoever puts them into the queue. */
static void planner(void *argument)
{
    (void)argument;
    for (;;) {
        sb_move_request request;
        if (xQueueReceive(requests, &request, portMAX_DELAY) != pdPASS) continue;
        /* A message of the host: the axis stops by itself if they stay away. */
        sb_heard(&arm);
        const sb_status status = sb_move(&arm, &request, NULL);
        if (status) log_refusal(&arm, status);
    }
}

/* To be called once before the scheduler starts. 0 if the arm is ready. */
int arm_start(void)
{
    static const sb_setup setup = {.abi = SB_ABI,
                                   .tick = STILLBEAM_TICK,
                                   .rate = 15.0,
                                   .acceleration = 150.0,
                                   .patience = 0.5,
                                   .missed = 2,
                                   .lock = lock,
                                   .unlock = unlock};
    static const sb_gear gear = {.abi = SB_ABI, .motor_turns = 6};
    double measured;
    sb_status status;

    if ((status = sb_init(&arm, sizeof arm, stillbeam_arms[0], STILLBEAM_ARM_WORDS, &setup)))
        return log_refusal(&arm, status), 1;
    if ((status = sb_drive_init(&drive, sizeof drive, &gear)))
        return log_refusal(&drive, status), 1;
    if ((status = sb_hub_angle(&drive, machine_shaft(), &measured)))
        return log_refusal(&drive, status), 1;
    if ((status = sb_enable(&arm, measured))) return log_refusal(&arm, status), 1;
    requests = xQueueCreate(4, sizeof(sb_move_request));
    if (!requests) return 1;
    if (xTaskCreate(control, "control", 512, NULL, configMAX_PRIORITIES - 1, NULL) != pdPASS)
        return 1;
    return xTaskCreate(planner, "planner", 1024, NULL, 1, NULL) == pdPASS ? 0 : 1;
}

/* Asks for a move; 0 if it waits to be planned. */
int arm_move(const sb_move_request *request)
{
    return xQueueSend(requests, request, 0) == pdPASS ? 0 : 1;
}
