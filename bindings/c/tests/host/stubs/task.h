#ifndef TASK_H
#define TASK_H
typedef void (*TaskFunction_t)(void *);
typedef struct task *TaskHandle_t;
void vTaskEnterCritical(void);
void vTaskExitCritical(void);
#define taskENTER_CRITICAL() vTaskEnterCritical()
#define taskEXIT_CRITICAL() vTaskExitCritical()
TickType_t xTaskGetTickCount(void);
void vTaskDelayUntil(TickType_t *previous, TickType_t increment);
BaseType_t xTaskCreate(TaskFunction_t code, const char *name, uint16_t depth, void *argument,
                       UBaseType_t priority, TaskHandle_t *handle);
#endif
