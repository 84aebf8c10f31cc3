/* Options that say which part of a file to read, the same for every verb that has them; and maps
 * read so: a code or, in full detail, contour lines.
 */
#ifndef YB_CLI_PART_H
#define YB_CLI_PART_H

#include "grid.h"
#include "map_file.h"

enum {
    CLI_PART_WINDOW = 0x2000,
    CLI_PART_CENTER,
    CLI_PART_KM,
    CLI_PART_CELL,
    CLI_PART_FIELD,
    CLI_PART_END
};

/* clang-format off */
#define CLI_PART_LONG_OPTIONS                                           \
    {"window", required_argument, NULL, CLI_PART_WINDOW},               \
    {"center", required_argument, NULL, CLI_PART_CENTER},               \
    {"km", required_argument, NULL, CLI_PART_KM},                       \
    {"field", required_argument, NULL, CLI_PART_FIELD}
/* Where the file may be a raster, too. */
#define CLI_PART_CELL_OPTION {"cell", required_argument, NULL, CLI_PART_CELL}
/* clang-format on */

/* Starts as {0}. */
typedef struct {
    const char *field;
    yb_window_t window;
    double km;
    bool boxed, centered;
    bool shared; /* the options are for another file, too: a map may be a code */
} cli_part_t;

/* For --help: of a map, without --cell. */
extern const char cli_part_help[];

bool cli_part_owns(int answer);

/* One option, after getopt_long answered it; and all of them together. CLI_OK or CLI_USAGE, said.
 */
int cli_part_take(cli_part_t *part, int answer, int argc, char **argv);
int cli_part_check(cli_part_t *part);

/* For verbs with these options after their own: what `default` does with any other answer; and, in
 * the end, cli_part_check and the one map that they are given. CLI_OK or CLI_USAGE, said.
 */
int cli_part_take_rest(cli_part_t *part, int answer, int argc, char **argv);
int cli_part_one_map(cli_part_t *part, int argc, char **argv, const char **path);

/* A map from a code or contour lines. What of the lines cannot be kept is said on the standard
 * error. NULL: it has been said why not.
 */
yb_code_file_t *cli_part_read_map(const cli_part_t *part, const char *path);

#endif
