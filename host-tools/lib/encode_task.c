#include "encode_task.h"

long yb_encode_trials(long usual, int effort)
{
    for (int i = effort; i < YB_ENCODE_DEFAULT_EFFORT; i++)
        usual /= 3;
    for (int i = effort; i > YB_ENCODE_DEFAULT_EFFORT; i--)
        usual *= 3;
    return usual;
}

bool yb_encode_has_room(const yb_encode_task_t *task, yb_error_t *error)
{
    size_t sections = yb_sections_size(task->sections);
    return task->most_bytes >= YB_ENCODE_LEAST_BYTES + sections ||
           yb_error_set(error, "%zu bytes are too few for a map%s: the least is %zu",
                        task->most_bytes,
                        sections > 0 ? " with the name, place or certificate asked for" : "",
                        YB_ENCODE_LEAST_BYTES + sections);
}
