/* From a processor that has a stack to main: .data and .bss as C expects them. */
#include <string.h>

#include "board.h"
#include "start.h"

extern uint32_t yb_data_source[];
extern uint32_t yb_data_start[];
extern uint32_t yb_data_end[];
extern uint32_t yb_bss_start[];
extern uint32_t yb_bss_end[];

int main(void);

void yb_stop(void)
{
    for (;;) {
    }
}

void yb_start(void)
{
    memcpy(yb_data_start, yb_data_source, (size_t)(yb_data_end - yb_data_start) * 4);
    memset(yb_bss_start, 0, (size_t)(yb_bss_end - yb_bss_start) * 4);
    (void)main();
    yb_stop();
}
