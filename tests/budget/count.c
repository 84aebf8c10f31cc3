/* A QEMU plugin that counts a guest's instructions between two markers.
 *
 *     -plugin libyb_count.so,begin=0xADDRESS,end=0xADDRESS,out=FILE[,profile=FILE,region=N]
 *
 * begin and end are the addresses of two functions. Each time the guest reaches `end` after
 * `begin`, a line with the number of instructions executed in between is added to FILE. The count
 * depends on the program alone: two runs agree to the instruction. With `profile`, the Nth region
 * (from 0) is told in detail: a line per address below 256 KB, with how often it was executed.
 *
 * Debian's QEMU ships no plugin header, so the part of plugin API version 1 that is used here is
 * declared by hand; QEMU answers for its shape as long as it accepts version 1.
 */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- Plugin API, version 1 -------------------------------------------------------------------- */

typedef uint64_t plugin_id_t;
typedef struct qemu_plugin_tb block_t;
typedef struct qemu_plugin_insn instruction_t;
typedef struct qemu_info_t qemu_info_t;

enum {
    NO_REGISTERS = 0,
    ADD_U64 = 0
};

void qemu_plugin_register_vcpu_tb_trans_cb(plugin_id_t id, void (*fn)(plugin_id_t, block_t *));
size_t qemu_plugin_tb_n_insns(const block_t *block);
instruction_t *qemu_plugin_tb_get_insn(const block_t *block, size_t index);
uint64_t qemu_plugin_insn_vaddr(const instruction_t *instruction);
void qemu_plugin_register_vcpu_insn_exec_cb(instruction_t *instruction,
                                            void (*fn)(unsigned cpu, void *context), int flags,
                                            void *context);
void qemu_plugin_register_vcpu_insn_exec_inline(instruction_t *instruction, int operation,
                                                void *counter, uint64_t amount);

#define EXPORTED __attribute__((visibility("default")))
extern EXPORTED int qemu_plugin_version;
EXPORTED int qemu_plugin_install(plugin_id_t id, const qemu_info_t *info, int argc, char **argv);

int qemu_plugin_version = 1;

/* --- Counting --------------------------------------------------------------------------------- */

/* Flash that is profiled: an entry per halfword, because Thumb instructions start on one. */
enum {
    PROFILED_BYTES = 256 * 1024,
    PROFILED = PROFILED_BYTES / 2
};

/* A plugin is loaded once a process and is called back without a context. */
static struct {
    uint64_t begin, end; /* addresses */
    uint64_t executed;   /* since the guest started */
    uint64_t started_at; /* `executed` at the last `begin` */
    bool counting;
    FILE *out;
    const char *profile; /* NULL: not asked for */
    uint64_t region;     /* which one to profile */
    uint64_t regions;    /* that have ended */
    uint64_t at[PROFILED];
} count;

static void write_profile(void)
{
    FILE *file = fopen(count.profile, "w");
    if (!file)
        return;
    for (size_t i = 0; i < PROFILED; i++) {
        if (count.at[i] > 0)
            (void)fprintf(file, "%#zx %" PRIu64 "\n", 2 * i, count.at[i]);
    }
    (void)fclose(file);
}

static void on_begin(unsigned cpu, void *context)
{
    (void)cpu;
    (void)context;
    count.started_at = count.executed;
    count.counting = true;
    if (count.profile && count.regions == count.region)
        memset(count.at, 0, sizeof count.at);
}

static void on_end(unsigned cpu, void *context)
{
    (void)cpu;
    (void)context;
    if (!count.counting)
        return;
    count.counting = false;
    (void)fprintf(count.out, "%" PRIu64 "\n", count.executed - count.started_at);
    (void)fflush(count.out);
    if (count.profile && count.regions == count.region)
        write_profile();
    count.regions++;
}

static void on_translate(plugin_id_t id, block_t *block)
{
    (void)id;
    size_t instructions = qemu_plugin_tb_n_insns(block);
    for (size_t i = 0; i < instructions; i++) {
        instruction_t *instruction = qemu_plugin_tb_get_insn(block, i);
        uint64_t address = qemu_plugin_insn_vaddr(instruction);
        if (address == count.begin)
            qemu_plugin_register_vcpu_insn_exec_cb(instruction, on_begin, NO_REGISTERS, NULL);
        if (address == count.end)
            qemu_plugin_register_vcpu_insn_exec_cb(instruction, on_end, NO_REGISTERS, NULL);
        qemu_plugin_register_vcpu_insn_exec_inline(instruction, ADD_U64, &count.executed, 1);
        if (count.profile && address < PROFILED_BYTES)
            qemu_plugin_register_vcpu_insn_exec_inline(instruction, ADD_U64, &count.at[address / 2],
                                                       1);
    }
}

static const char *value_of(const char *argument, const char *key)
{
    size_t length = strlen(key);
    if (strncmp(argument, key, length) != 0 || argument[length] != '=')
        return NULL;
    return argument + length + 1;
}

int qemu_plugin_install(plugin_id_t id, const qemu_info_t *info, int argc, char **argv)
{
    (void)info;
    const char *out = NULL;
    for (int i = 0; i < argc; i++) {
        const char *value;
        if ((value = value_of(argv[i], "begin")))
            count.begin = strtoull(value, NULL, 0);
        else if ((value = value_of(argv[i], "end")))
            count.end = strtoull(value, NULL, 0);
        else if ((value = value_of(argv[i], "out")))
            out = value;
        else if ((value = value_of(argv[i], "profile")))
            count.profile = strdup(value);
        else if ((value = value_of(argv[i], "region")))
            count.region = strtoull(value, NULL, 0);
    }
    if (!out || !(count.out = fopen(out, "w"))) {
        (void)fprintf(stderr, "count: out=FILE is missing or cannot be written\n");
        return -1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, on_translate);
    return 0;
}
